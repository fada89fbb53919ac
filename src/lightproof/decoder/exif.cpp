#include "lightproof/decoder/exif.h"

#include <cstddef>

namespace lightproof {
namespace {

constexpr unsigned kOrientationTag = 274;
constexpr std::size_t kEntryBytes = 12;

/// Numbers of the byte order that the data declare; 0 behind their end.
class Numbers {
 public:
  Numbers(std::span<const std::uint8_t> bytes, bool is_big_endian)
      : bytes_(bytes), is_big_endian_(is_big_endian) {}

  unsigned at(std::size_t offset, std::size_t count) const {
    if (offset > bytes_.size() || count > bytes_.size() - offset) return 0;
    unsigned number = 0;
    for (std::size_t i = 0; i < count; ++i) {
      number = number << 8U | bytes_[offset + (is_big_endian_ ? i : count - 1 - i)];
    }
    return number;
  }

 private:
  std::span<const std::uint8_t> bytes_;
  bool is_big_endian_;
};

}  // namespace

int exif_orientation(std::span<const std::uint8_t> tiff) {
  if (tiff.size() < 8 || tiff[0] != tiff[1] || (tiff[0] != 'I' && tiff[0] != 'M')) return 1;
  const Numbers numbers(tiff, tiff[0] == 'M');
  const std::size_t directory = numbers.at(4, 4);
  const std::size_t entries = numbers.at(directory, 2);
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + i * kEntryBytes;
    if (numbers.at(entry, 2) == kOrientationTag) {
      const unsigned value = numbers.at(entry + 8, 2);
      return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
    }
  }
  return 1;
}

}  // namespace lightproof
