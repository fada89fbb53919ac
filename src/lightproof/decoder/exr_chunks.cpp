#include "lightproof/decoder/exr_chunks.h"

#include <ImfChannelList.h>
#include <ImfPartType.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "lightproof/decoder/refusal.h"

namespace lightproof {
namespace {

constexpr int kRowsOfZip = 16;

/// Bytes that a ZIP chunk may hold, in order; empty where no ZIP file is read.
std::vector<std::uint64_t> expected_sizes;

std::uint64_t bytes_of(Imf::PixelType type) { return type == Imf::HALF ? 2 : 4; }

/// Samples in [first, last] of a channel that has one where the coordinate is a multiple of `step`.
std::uint64_t samples_in(int first, int last, int step) {
  const auto floor = [&](std::int64_t at) {
    return at >= 0 ? at / step : -((-at + step - 1) / step);
  };
  return static_cast<std::uint64_t>(floor(last) - floor(std::int64_t{first} - 1));
}

/// Bytes of the samples of all channels in a rectangle of pixels.
std::uint64_t bytes_of(const Imf::Header& header, const Imath::Box2i& box) {
  std::uint64_t bytes = 0;
  const Imf::ChannelList& channels = header.channels();
  for (auto at = channels.begin(); at != channels.end(); ++at) {
    const Imf::Channel& channel = at.channel();
    bytes += bytes_of(channel.type) * samples_in(box.min.x, box.max.x, channel.xSampling) *
             samples_in(box.min.y, box.max.y, channel.ySampling);
  }
  return bytes;
}

/// Rectangles of this many columns and rows, cut at the edges of the data window.
template <class Visit>
void for_each_chunk(const Imath::Box2i& window, int columns, int rows, const Visit& visit) {
  if (columns < 1 || rows < 1) refuse("cannot be read as OpenEXR: tiles without a size");
  for (std::int64_t y = window.min.y; y <= window.max.y; y += rows) {
    for (std::int64_t x = window.min.x; x <= window.max.x; x += columns) {
      visit(Imath::Box2i({static_cast<int>(x), static_cast<int>(y)},
                         {static_cast<int>(std::min<std::int64_t>(x + columns - 1, window.max.x)),
                          static_cast<int>(std::min<std::int64_t>(y + rows - 1, window.max.y))}));
    }
  }
}

/// How many bytes a chunk by RLE decompresses to; 0 if its last run is cut off.
std::uint64_t decompressed_size_of_rle(const char* bytes, std::size_t count) {
  std::uint64_t size = 0;
  for (std::size_t i = 0; i < count;) {
    // 256 less the number of bytes that follow, or one less than how often the next one is
    // repeated.
    const std::size_t code = static_cast<unsigned char>(bytes[i]);
    const bool is_run = code < 128;
    size += is_run ? code + 1 : 256 - code;
    i += is_run ? 2 : 1 + 256 - code;
    if (i > count) return 0;
  }
  return size;
}

void check_chunk(const Imf::Header& header, const Imath::Box2i& box, const char* bytes, int count) {
  const std::uint64_t needed = bytes_of(header, box);
  std::uint64_t held = static_cast<std::uint64_t>(std::max(count, 0));
  if (header.compression() == Imf::RLE_COMPRESSION && held < needed) {
    held = decompressed_size_of_rle(bytes, held);
  }
  if (held >= needed) return;
  refuse(fmt::format(
      "cannot be read as OpenEXR: the pixels from column {}, row {} on take {} bytes, and "
      "the file holds {} of them: it is damaged",
      box.min.x - header.dataWindow().min.x, box.min.y - header.dataWindow().min.y, needed, held));
}

void check_tiles(Imf::InputPart& part) {
  const Imf::Header& header = part.header();
  const Imf::TileDescription& tile = header.tileDescription();
  const Imath::Box2i& window = header.dataWindow();
  for_each_chunk(window, static_cast<int>(tile.xSize), static_cast<int>(tile.ySize),
                 [&](const Imath::Box2i& box) {
                   int column = (box.min.x - window.min.x) / static_cast<int>(tile.xSize);
                   int row = (box.min.y - window.min.y) / static_cast<int>(tile.ySize);
                   int level_x = 0;
                   int level_y = 0;
                   const char* bytes = nullptr;
                   int count = 0;
                   part.rawTileData(column, row, level_x, level_y, bytes, count);
                   check_chunk(header, box, bytes, count);
                 });
}

}  // namespace

std::optional<Imf::TileDescription> tiles_of(const Imf::Header& header) {
  const bool is_tiled = header.hasType() && Imf::isTiled(header.type());
  if (!is_tiled || !header.hasTileDescription()) return std::nullopt;
  return header.tileDescription();
}

void expect_chunks_of(const Imf::Header& header) {
  expected_sizes.clear();
  const bool is_zip = header.compression() == Imf::ZIP_COMPRESSION;
  if (!is_zip && header.compression() != Imf::ZIPS_COMPRESSION) return;
  const Imath::Box2i& window = header.dataWindow();
  int columns = window.max.x - window.min.x + 1;
  int rows = is_zip ? kRowsOfZip : 1;
  if (const auto tiles = tiles_of(header)) {
    columns = static_cast<int>(tiles->xSize);
    rows = static_cast<int>(tiles->ySize);
  }
  for_each_chunk(window, columns, rows, [&](const Imath::Box2i& box) {
    const std::uint64_t bytes = bytes_of(header, box);
    const auto at = std::ranges::lower_bound(expected_sizes, bytes);
    if (at == expected_sizes.end() || *at != bytes) expected_sizes.insert(at, bytes);
  });
}

void check_chunks(Imf::InputPart& part, int first, int last) {
  const Imf::Header& header = part.header();
  if (header.compression() != Imf::NO_COMPRESSION && header.compression() != Imf::RLE_COMPRESSION) {
    return;
  }
  const Imath::Box2i& window = header.dataWindow();
  if (tiles_of(header)) {
    if (first == window.min.y) check_tiles(part);
    return;
  }
  for (int y = first; y < last; ++y) {
    const char* bytes = nullptr;
    int count = 0;
    part.rawPixelData(y, bytes, count);
    check_chunk(header, {{window.min.x, y}, {window.max.x, y}}, bytes, count);
  }
}

}  // namespace lightproof

/// zlib's function in the place of its own, which OpenEXR calls for every ZIP chunk, and which
/// knows the largest size alone.
extern "C" int uncompress(Bytef* to, uLongf* size, const Bytef* from, uLong count) {
  const int result = uncompress2(to, size, from, &count);
  const auto& expected = lightproof::expected_sizes;
  if (result != Z_OK || expected.empty()) return result;
  return std::ranges::binary_search(expected, *size) ? Z_OK : Z_DATA_ERROR;
}
