#include "lightproof/image/ktx2_writer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "lightproof/core/parallel.h"
#include "lightproof/image/stored_value.h"

namespace lightproof {
namespace {

constexpr std::string_view kIdentifier("\xabKTX 20\xbb\r\n\x1a\n", 12);
constexpr std::uint32_t kRg16 = 83;    // VK_FORMAT_R16G16_SFLOAT
constexpr std::uint32_t kRgba16 = 97;  // VK_FORMAT_R16G16B16A16_SFLOAT
constexpr std::size_t kHalf = sizeof(std::uint16_t);
constexpr std::size_t kHeaderAndIndex = 80;
constexpr std::size_t kLevelIndexEntry = 24;
constexpr std::uint8_t kUnspecified = 0;  // KHR_DF_PRIMARIES_UNSPECIFIED
constexpr std::uint8_t kBt709 = 1;        // KHR_DF_PRIMARIES_BT709

/// What is the same for all texels.
struct Texture {
  std::uint32_t format;
  std::size_t channels;
  Extent extent;
  int faces;
  int levels;
  std::uint8_t primaries;
  Attributes attributes;

  std::size_t texel_bytes() const { return channels * kHalf; }
  std::size_t level_bytes(int level) const {
    return level_extent(extent, level).count() * static_cast<std::size_t>(faces) * texel_bytes();
  }
};

class LittleEndian {
 public:
  template <class Number>
  LittleEndian& add(Number value) {
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
      bytes_ += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xffU);
    }
    return *this;
  }
  LittleEndian& add_text(std::string_view text) {
    bytes_ += text;
    return *this;
  }
  LittleEndian& pad_to(std::size_t multiple) {
    while (bytes_.size() % multiple != 0) bytes_ += '\0';
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// KHR_DF_PRIMARIES_…, of the spaces that have one.
std::uint8_t primaries_of(const std::optional<Chromaticities>& chromaticities) {
  if (!chromaticities) return kBt709;
  constexpr std::array<std::pair<std::string_view, std::uint8_t>, 7> kNumbers = {
      {{kRec709Name, kBt709},
       {"Rec. 709 adapted to D50", kBt709},
       {"Rec. 2020", 4},
       {"ACES 2065-1 (AP0)", 6},
       {"ACEScg", 7},
       {"Display P3", 10},
       {"Adobe RGB (1998)", 11}}};
  const auto found = std::ranges::find(kNumbers, name_of(*chromaticities),
                                       [](const auto& row) { return row.first; });
  return found == kNumbers.end() ? kUnspecified : found->second;
}

/// One basic descriptor block, a sample a channel: signed floats in RGB space, linear.
std::string data_format_descriptor(const Texture& texture) {
  constexpr std::array<std::uint8_t, 4> kChannels = {0, 1, 2, 15};  // red, green, blue, alpha
  constexpr std::uint8_t kSignedFloat = 0xc0;
  constexpr std::uint32_t kMinusOne = 0xbf800000;
  constexpr std::uint32_t kOne = 0x3f800000;
  const auto block_bytes = static_cast<std::uint16_t>(24 + 16 * texture.channels);
  LittleEndian block;
  block.add(std::uint32_t{block_bytes} + 4U);
  block.add(std::uint32_t{0});  // vendor and type: Khronos, basic
  block.add(std::uint16_t{2}).add(block_bytes);
  block.add(std::uint8_t{1}).add(texture.primaries);  // KHR_DF_MODEL_RGBSDA
  block.add(std::uint8_t{1}).add(std::uint8_t{0});    // KHR_DF_TRANSFER_LINEAR, straight alpha
  block.add(std::uint32_t{0});                        // blocks of 1 x 1 x 1 x 1 texels
  block.add(std::uint64_t{texture.texel_bytes()});    // in plane 0
  for (std::size_t i = 0; i < texture.channels; ++i) {
    block.add(static_cast<std::uint16_t>(16 * i)).add(std::uint8_t{15});
    block.add(static_cast<std::uint8_t>(kSignedFloat | kChannels[i]));
    block.add(std::uint32_t{0}).add(kMinusOne).add(kOne);
  }
  return block.bytes();
}

/// In the order of their code points, which is that of the bytes of UTF-8.
std::string key_value_data(const Attributes& attributes) {
  std::map<std::string, std::string> values = {{"KTXorientation", "rd"}};
  for (const Attribute& attribute : attributes) {
    if (attribute.name == "software") values["KTXwriter"] = line_of(attribute);
    values[file_name_of(attribute)] = line_of(attribute);
  }
  LittleEndian data;
  for (const auto& [key, value] : values) {
    data.add(static_cast<std::uint32_t>(key.size() + value.size() + 2));
    data.add_text(key).add(std::uint8_t{0}).add_text(value).add(std::uint8_t{0}).pad_to(4);
  }
  return data.bytes();
}

/// Where the data of each level begins: the smallest level comes first.
std::vector<std::size_t> level_offsets(const Texture& texture, std::size_t begin) {
  const std::size_t alignment = std::lcm(texture.texel_bytes(), std::size_t{4});
  std::vector<std::size_t> offsets(static_cast<std::size_t>(texture.levels));
  for (int level = texture.levels - 1; level >= 0; --level) {
    begin = (begin + alignment - 1) / alignment * alignment;
    offsets[static_cast<std::size_t>(level)] = begin;
    begin += texture.level_bytes(level);
  }
  return offsets;
}

/// The file up to the texels, which are 0 still, and where each level begins.
struct Container {
  std::string bytes;
  std::vector<std::size_t> offsets;
};

Container container_of(const Texture& texture) {
  const std::string descriptor = data_format_descriptor(texture);
  const std::string pairs = key_value_data(texture.attributes);
  const std::size_t descriptor_at =
      kHeaderAndIndex + kLevelIndexEntry * static_cast<std::size_t>(texture.levels);
  const std::size_t pairs_at = descriptor_at + descriptor.size();
  const auto number = [](auto value) { return static_cast<std::uint32_t>(value); };
  LittleEndian head;
  head.add_text(kIdentifier).add(texture.format).add(number(kHalf));
  head.add(number(texture.extent.width)).add(number(texture.extent.height)).add(number(0));
  head.add(number(0)).add(number(texture.faces)).add(number(texture.levels)).add(number(0));
  head.add(number(descriptor_at)).add(number(descriptor.size()));
  head.add(number(pairs_at)).add(number(pairs.size()));
  head.add(std::uint64_t{0}).add(std::uint64_t{0});  // no data of a compression
  const std::vector<std::size_t> offsets = level_offsets(texture, pairs_at + pairs.size());
  for (int level = 0; level < texture.levels; ++level) {
    const std::uint64_t length = texture.level_bytes(level);
    head.add(std::uint64_t{offsets[static_cast<std::size_t>(level)]}).add(length).add(length);
  }
  head.add_text(descriptor).add_text(pairs);
  Container container = {head.bytes(), offsets};
  container.bytes.resize(offsets.front() + texture.level_bytes(0));
  return container;
}

void put(char*& at, float value) {
  const std::uint16_t bits = half_bits(value);
  *at++ = static_cast<char>(bits & 0xffU);
  *at++ = static_cast<char>(bits >> 8U);
}

void put_row(char* at, std::span<const Rgb> row) {
  for (const Rgb rgb : row) {
    for (const float value : {rgb.r, rgb.g, rgb.b, 1.0F}) put(at, value);
  }
}

void put_row(char* at, std::span<const glm::vec2> row) {
  for (const glm::vec2 pair : row) {
    put(at, pair.x);
    put(at, pair.y);
  }
}

template <class Texel>
void put_face(char* at, const Grid<Texel>& face, std::size_t texel_bytes) {
  const std::size_t row_bytes = static_cast<std::size_t>(face.extent().width) * texel_bytes;
  parallel_for(static_cast<std::size_t>(face.extent().height),
               [&](std::size_t y) { put_row(at + y * row_bytes, face.row(static_cast<int>(y))); });
}

}  // namespace

std::string ktx2_bytes(const MapLevels& map) {
  assert(is_pyramid(map));
  const Texture texture = {.format = kRgba16,
                           .channels = 4,
                           .extent = map.extent(),
                           .faces = info(map.projection).faces,
                           .levels = static_cast<int>(map.levels.size()),
                           .primaries = primaries_of(map.chromaticities),
                           .attributes = attributes_of(map)};
  Container container = container_of(texture);
  for (std::size_t level = 0; level < map.levels.size(); ++level) {
    char* at = container.bytes.data() + container.offsets[level];
    for (const Grid<Rgb>& face : map.levels[level].faces) {
      put_face(at, face, texture.texel_bytes());
      at += face.extent().count() * texture.texel_bytes();
    }
  }
  return std::move(container.bytes);
}

std::string ktx2_bytes(const BrdfMap& map) {
  const Texture texture = {.format = kRg16,
                           .channels = 2,
                           .extent = map.values.extent(),
                           .faces = 1,
                           .levels = 1,
                           .primaries = kUnspecified,
                           .attributes = attributes_of(map)};
  Container container = container_of(texture);
  put_face(container.bytes.data() + container.offsets.front(), map.values, texture.texel_bytes());
  return std::move(container.bytes);
}

}  // namespace lightproof
