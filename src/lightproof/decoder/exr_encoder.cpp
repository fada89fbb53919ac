#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <ImfTileDescription.h>
#include <ImfTiledOutputFile.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "lightproof/decoder/confinement.h"
#include "lightproof/decoder/picture_decoder.h"
#include "lightproof/decoder/picture_encoder.h"
#include "lightproof/decoder/refusal.h"

namespace lightproof {
namespace {

class Stream : public Imf::OStream {
 public:
  Stream() : OStream("the file") {}

  void write(const char c[], int n) override {
    const auto count = static_cast<std::size_t>(n);
    if (bytes_.size() < at_ + count) bytes_.resize(at_ + count);
    std::copy_n(c, count, bytes_.begin() + static_cast<std::ptrdiff_t>(at_));
    at_ += count;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }

  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

Imf::Header header_of(const EncodeRequest& request) {
  const LevelSize size = request.levels.at(0);
  Imf::Header header(size.width, size.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const std::string& name : request.channels) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  }
  for (const Attribute& attribute : request.attributes) {
    header.insert(file_name_of(attribute), Imf::StringAttribute(line_of(attribute)));
  }
  if (request.chromaticities) {
    const auto xy = [](const std::array<double, 2>& c) {
      return Imath::V2f(static_cast<float>(c[0]), static_cast<float>(c[1]));
    };
    const Chromaticities& c = *request.chromaticities;
    Imf::addChromaticities(header, {xy(c.red), xy(c.green), xy(c.blue), xy(c.white)});
  }
  if (request.tile > 0) {
    const auto side = static_cast<unsigned>(request.tile);
    header.setTileDescription({side, side, Imf::MIPMAP_LEVELS, Imf::ROUND_DOWN});
    Imf::addWrapmodes(header, "periodic,clamp");
  }
  return header;
}

/// Rows of a level, and the slots in them of its channels.
class Rows {
 public:
  Rows(const EncodeRequest& request, LevelSize size)
      : channels_(request.channels), width_(static_cast<std::size_t>(size.width)) {}

  /// The number of rows that are kept at once, in whole tiles.
  int at_once(int height, int tile) const {
    const std::size_t of_row = sizeof(float) * channels_.size() * width_;
    const int unit = std::max(tile, 1);
    const auto units = static_cast<int>(
        std::max<std::uint64_t>(1, kBytesAtOnce / of_row / static_cast<unsigned>(unit)));
    return std::min(height, units * unit);
  }

  /// Takes the rows from `first` on.
  Imf::FrameBuffer fill(const NextSamples& next, int first, int rows) {
    values_.resize(channels_.size() * width_ * static_cast<std::size_t>(rows));
    next(std::as_writable_bytes(std::span(values_)));
    Imf::FrameBuffer buffer;
    const std::size_t step = sizeof(float) * channels_.size();
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      buffer.insert(channels_[i],
                    Imf::Slice::Make(Imf::FLOAT, &values_[i], Imath::V2i(0, first),
                                     static_cast<std::int64_t>(width_), rows, step, step * width_));
    }
    return buffer;
  }

 private:
  const std::vector<std::string>& channels_;
  std::size_t width_;
  std::vector<float> values_;
};

void write_lines(Stream& stream, const EncodeRequest& request, const NextSamples& next) {
  Imf::OutputFile out(stream, header_of(request));
  const LevelSize size = request.levels.at(0);
  Rows rows(request, size);
  const int at_once = rows.at_once(size.height, 0);
  for (int y = 0; y < size.height; y += at_once) {
    const int count = std::min(at_once, size.height - y);
    out.setFrameBuffer(rows.fill(next, y, count));
    out.writePixels(count);
  }
}

void write_tiles(Stream& stream, const EncodeRequest& request, const NextSamples& next) {
  // The places of the tiles are written at the end of its life.
  Imf::TiledOutputFile out(stream, header_of(request));
  for (int level = 0; level < static_cast<int>(request.levels.size()); ++level) {
    const LevelSize size = request.levels[static_cast<std::size_t>(level)];
    Rows rows(request, size);
    const int at_once = rows.at_once(size.height, request.tile);
    for (int y = 0; y < size.height; y += at_once) {
      const int count = std::min(at_once, size.height - y);
      out.setFrameBuffer(rows.fill(next, y, count));
      out.writeTiles(0, out.numXTiles(level) - 1, y / request.tile, (y + count - 1) / request.tile,
                     level);
    }
  }
}

}  // namespace

std::string exr_file(const EncodeRequest& request, const NextSamples& next) {
  Imf::setGlobalThreadCount(threads_to_use());
  Stream stream;
  if (request.tile > 0) {
    write_tiles(stream, request, next);
  } else {
    write_lines(stream, request, next);
  }
  return stream.take();
}

}  // namespace lightproof
