#include "lightproof/precompute/partial_levels.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include "lightproof/core/atomic_file.h"
#include "lightproof/core/error.h"
#include "lightproof/core/serialise.h"

namespace lightproof {
namespace fs = std::filesystem;
namespace {

/// The format of the files, which programs of another one do not read.
constexpr std::string_view kFormat = "lightproof partial levels 1";

/// Fowler, Noll and Vo's hash of 64 bits (FNV-1a) over the bits of all values.
std::uint64_t hash_of(const Grid<Rgb>& radiance) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const Rgb& texel : radiance.values()) {
    for (const float value : {texel.r, texel.g, texel.b}) {
      hash = (hash ^ std::bit_cast<std::uint32_t>(value)) * 0x100000001b3ULL;
    }
  }
  return hash;
}

void add(ValueWriter& writer, const MapLevel& level) {
  writer.add(level.roughness);
  writer.add(level.faces.size());
  for (const Grid<Rgb>& face : level.faces) {
    writer.add(face.extent().width);
    writer.add(face.extent().height);
    for (const Rgb& texel : face.values()) {
      writer.add(std::uint64_t{std::bit_cast<std::uint32_t>(texel.r)} << 32U |
                 std::bit_cast<std::uint32_t>(texel.g));
      writer.add(std::uint64_t{std::bit_cast<std::uint32_t>(texel.b)});
    }
  }
}

Grid<Rgb> read_face(ValueReader& reader) {
  const auto width = reader.number();
  const auto height = reader.number();
  if (width > static_cast<std::uint64_t>(kLargestPicture.width) ||
      height > static_cast<std::uint64_t>(kLargestPicture.height)) {
    throw std::out_of_range("face");
  }
  Grid<Rgb> face({static_cast<int>(width), static_cast<int>(height)});
  for (Rgb& texel : face.values()) {
    const std::uint64_t red_green = reader.number();
    texel.r = std::bit_cast<float>(static_cast<std::uint32_t>(red_green >> 32U));
    texel.g = std::bit_cast<float>(static_cast<std::uint32_t>(red_green));
    texel.b = std::bit_cast<float>(static_cast<std::uint32_t>(reader.number()));
  }
  return face;
}

MapLevel read_level(ValueReader& reader) {
  MapLevel level{reader.value<std::optional<double>>(), {}};
  for (std::uint64_t left = reader.number(); left > 0; --left) {
    level.faces.push_back(read_face(reader));
  }
  return level;
}

}  // namespace

std::string fingerprint_of(const EnvironmentMap& map, const PrecomputeRequest& request) {
  const Extent extent = map.radiance.extent();
  std::string text = fmt::format(
      "{}; map {}x{} {:016x}; projection {}; method {}, {} samples, degree {}", kFormat,
      extent.width, extent.height, hash_of(map.radiance), info(request.projection).name,
      static_cast<int>(request.method.method), request.method.samples, request.method.degree);
  for (const ProductRequest& product : request.products) {
    if (product.product == Product::brdf_map) continue;
    const std::vector<LevelPlan> plans = plan_levels(product, request.projection);
    text += fmt::format("; {} {}x{}, {} levels", name_of(product.product),
                        plans.front().extent.width, plans.front().extent.height, plans.size());
  }
  return text;
}

fs::path partial_folder_of(const fs::path& folder) {
  fs::path path = folder.lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  return path += ".partial";
}

PartialLevels::PartialLevels(fs::path folder, std::string fingerprint)
    : folder_(std::move(folder)), fingerprint_(std::move(fingerprint)) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) {
    throw InputError(fmt::format("{}: cannot make the folder that keeps interrupted work: {}",
                                 folder_.string(), error.message()));
  }
}

fs::path PartialLevels::file_of(const std::string& name) const {
  return folder_ / (name + ".levels");
}

std::optional<std::vector<MapLevel>> PartialLevels::find(const std::string& name) const {
  std::ifstream file(file_of(name), std::ios::binary);
  if (!file) return std::nullopt;
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  try {
    ValueReader reader(bytes);
    if (reader.text() != fingerprint_) return std::nullopt;
    std::vector<MapLevel> levels;
    for (std::uint64_t left = reader.number(); left > 0; --left) {
      levels.push_back(read_level(reader));
    }
    return reader.is_at_end() ? std::optional(std::move(levels)) : std::nullopt;
  } catch (const std::out_of_range&) {
    return std::nullopt;
  }
}

void PartialLevels::keep(const std::string& name, const std::vector<MapLevel>& levels) const {
  ValueWriter writer;
  writer.add(std::string_view(fingerprint_));
  writer.add(levels.size());
  for (const MapLevel& level : levels) add(writer, level);
  write_file(file_of(name), writer.take());
}

void PartialLevels::remove() const {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

}  // namespace lightproof
