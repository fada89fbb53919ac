#include "tests/image/damaged_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "lightproof/core/random.h"
#include "lightproof/image/radiance_writer.h"
#include "tests/image/picture_files.h"

namespace lightproof::test {
namespace {

namespace fs = std::filesystem;

constexpr Extent kSize = {64, 32};

/// Choices that a name and a number make.
class Choices {
 public:
  Choices(const std::string& name, std::uint64_t seed) : stream_(name, seed) {}

  /// 0 to count - 1.
  std::size_t below(std::size_t count) {
    const auto choice =
        static_cast<std::size_t>(stream_.point(next_++).s * static_cast<double>(count));
    return std::min(choice, count - 1);
  }

 private:
  RandomStream stream_;
  std::uint64_t next_ = 0;
};

/// A place, mostly in the header, where sizes and tables stand.
std::size_t place(Choices& choices, const std::string& bytes) {
  const std::size_t reach = choices.below(3) == 0 ? bytes.size() : 600;
  return choices.below(std::min(reach, bytes.size()));
}

void damage(Choices& choices, std::string& bytes) {
  if (bytes.size() < 16) return;
  const std::size_t at = place(choices, bytes);
  const std::size_t length = 1 + choices.below(std::min<std::size_t>(64, bytes.size() - at));
  switch (choices.below(7)) {
    case 0:
      bytes[at] = static_cast<char>(choices.below(256));
      break;
    case 1:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << choices.below(8)));
      break;
    case 2: {  // a number of four bytes
      constexpr std::uint32_t kNumbers[] = {0,          1,      0x7fffffff, 0xffffffff,
                                            0x80000000, 0xffff, 0x4000};
      const std::uint32_t number = kNumbers[choices.below(std::size(kNumbers))];
      for (std::size_t i = 0; i < 4 && at + i < bytes.size(); ++i) {
        bytes[at + i] = static_cast<char>(number >> (8 * i) & 0xffU);
      }
      break;
    }
    case 3:
      bytes.erase(at, length);
      break;
    case 4:
      bytes.insert(at, bytes.substr(at, length));
      break;
    case 5: {
      const std::string piece = bytes.substr(place(choices, bytes), length);
      bytes.replace(at, std::min(piece.size(), bytes.size() - at), piece);
      break;
    }
    default:
      if (choices.below(4) == 0) bytes.resize(at + 1);
  }
}

std::string bytes_of_hdr(bool as_planes, Choices& choices) {
  Grid<Rgb> picture(as_planes ? kSize : Extent{7, 32});
  for (Rgb& rgb : picture.values()) rgb = Rgb(static_cast<float>(1 + choices.below(4)));
  return radiance_bytes(picture);
}

/// Whole files, each with a name.
std::vector<DamagedFile> whole_files(const fs::path& folder) {
  std::vector<DamagedFile> files;
  const Grid<Rgb> picture = numbered_picture(kSize);
  const fs::path file = folder / "whole";
  for (std::size_t i = 0; i < kExrCompressions.size(); ++i) {
    for (const unsigned tile : {0U, 16U}) {
      const bool is_half = i % 2 == 0;
      write_compressed_exr(file, picture, i, is_half, tile);
      files.push_back(
          {fmt::format("{}{}", kExrCompressions[i], tile > 0 ? "-tiles" : ""), bytes_of(file)});
    }
  }
  write_two_part_exr(file, picture, picture);
  files.push_back({"parts", bytes_of(file)});
  write_luminance_chroma_exr(file, kSize);
  files.push_back({"yc", bytes_of(file)});
  Choices choices("pixels", 1);
  files.push_back({"planes", bytes_of_hdr(true, choices)});
  files.push_back({"plain", bytes_of_hdr(false, choices)});
  std::vector<unsigned> values;
  for (std::size_t i = 0; i < 3 * kSize.count(); ++i) {
    values.push_back(static_cast<unsigned>(choices.below(256)));
  }
  for (const char* name : {"a.png", "a.jpg"}) {
    write_integer_picture(folder / name, kSize, 3, values, 8);
    files.push_back({std::string(name).substr(2), bytes_of(folder / name)});
    fs::remove(folder / name);
  }
  fs::remove(file);
  return files;
}

}  // namespace

std::vector<DamagedFile> damaged_files(const fs::path& folder, std::uint64_t each,
                                       std::uint64_t seed) {
  std::vector<DamagedFile> files;
  for (const DamagedFile& whole : whole_files(folder)) {
    for (std::uint64_t i = 0; i < each; ++i) {
      Choices choices(whole.name, seed + i);
      std::string bytes = whole.bytes;
      for (std::size_t left = 1 + choices.below(8); left > 0; --left) damage(choices, bytes);
      files.push_back({fmt::format("{}-{}", whole.name, seed + i), bytes});
    }
  }
  return files;
}

}  // namespace lightproof::test
