#include "tests/image/picture_files.h"

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfFrameBuffer.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfTileDescription.h>
#include <ImfTiledOutputFile.h>
#include <OpenImageIO/imageio.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace lightproof::test {
namespace fs = std::filesystem;
namespace {

/// A slot whose address (0, 0) lies at `values`, for a data window that starts elsewhere.
Imf::Slice slice(Imf::PixelType type, const void* values, std::size_t column, std::size_t row,
                 Imath::Box2i window) {
  return Imf::Slice::Make(type, values, window, column, row);
}

Imf::Header header_of(Extent extent, const ExrOptions& options) {
  const Imath::V2i low(options.origin_x, options.origin_y);
  const Imath::Box2i data(low, low + Imath::V2i(extent.width - 1, extent.height - 1));
  Imath::Box2i display = data;
  display.max.x += options.missing_columns;
  Imf::Header header(display, data);
  header.lineOrder() = options.bottom_row_first ? Imf::DECREASING_Y : Imf::INCREASING_Y;
  if (options.envmap) {
    Imf::addEnvmap(header,
                   *options.envmap == Envmap::cube ? Imf::ENVMAP_CUBE : Imf::ENVMAP_LATLONG);
  }
  if (options.xyz) {
    Imf::addChromaticities(header, {{1.0F, 0.0F}, {0.0F, 1.0F}, {0.0F, 0.0F}, {0.333F, 0.333F}});
  }
  header.pixelAspectRatio() = options.pixel_aspect;
  if (options.chromaticities) {
    const auto& v = *options.chromaticities;
    Imf::addChromaticities(header, {{v[0], v[1]}, {v[2], v[3]}, {v[4], v[5]}, {v[6], v[7]}});
  }
  if (options.tiles_of_lines) {
    header.setTileDescription({*options.tiles_of_lines, *options.tiles_of_lines});
  }
  for (const std::string& name : options.channels) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  }
  return header;
}

Imf::FrameBuffer buffer_of(const Grid<Rgb>& picture, const std::vector<float>& zeros,
                           const ExrOptions& options, Imath::Box2i window) {
  Imf::FrameBuffer buffer;
  const auto width = static_cast<std::size_t>(picture.extent().width);
  for (std::size_t i = 0; i < options.channels.size(); ++i) {
    const bool coloured = i < 3;
    const void* values = coloured ? &picture.values()[0][static_cast<int>(i)] : zeros.data();
    const std::size_t step = coloured ? sizeof(Rgb) : sizeof(float);
    buffer.insert(options.channels[i], slice(Imf::FLOAT, values, step, step * width, window));
  }
  return buffer;
}

}  // namespace

void write_exr_file(const fs::path& file, const Grid<Rgb>& picture, const ExrOptions& options) {
  const Imf::Header header = header_of(picture.extent(), options);
  const std::vector<float> zeros(picture.values().size());
  {
    Imf::OutputFile out(file.c_str(), header);
    out.setFrameBuffer(buffer_of(picture, zeros, options, header.dataWindow()));
    // DECREASING_Y takes the lines from the last one up, whatever the frame buffer.
    out.writePixels(picture.extent().height);
  }
  if (!options.tiles_of_lines) return;
  // OpenEXR takes the file for one of tiles then, and sets the second byte of the version's flags.
  std::fstream flags(file, std::ios::in | std::ios::out | std::ios::binary);
  flags.seekp(5);
  flags.put('\0');
}

void write_compressed_exr(const fs::path& file, const Grid<Rgb>& picture, std::size_t compression,
                          bool is_half, unsigned tile) {
  const Extent extent = picture.extent();
  Imf::Header header(extent.width, extent.height);
  header.compression() = static_cast<Imf::Compression>(compression);
  const Imf::PixelType type = is_half ? Imf::HALF : Imf::FLOAT;
  std::vector<Imf::Rgba> halves;
  for (const Rgb rgb : picture.values()) halves.emplace_back(rgb.r, rgb.g, rgb.b);
  Imf::FrameBuffer buffer;
  const auto width = static_cast<std::size_t>(extent.width);
  for (int i = 0; i < 3; ++i) {
    const std::string name(1, "RGB"[i]);
    header.channels().insert(name, Imf::Channel(type));
    const std::size_t step = is_half ? sizeof(Imf::Rgba) : sizeof(Rgb);
    const void* values = is_half ? static_cast<const void*>(&halves[0].r + i)
                                 : static_cast<const void*>(&picture.values()[0][i]);
    buffer.insert(name, slice(type, values, step, step * width, header.dataWindow()));
  }
  if (tile > 0) {
    header.setTileDescription({tile, tile, Imf::ONE_LEVEL});
    Imf::TiledOutputFile out(file.c_str(), header);
    out.setFrameBuffer(buffer);
    out.writeTiles(0, out.numXTiles() - 1, 0, out.numYTiles() - 1);
    return;
  }
  Imf::OutputFile out(file.c_str(), header);
  out.setFrameBuffer(buffer);
  out.writePixels(extent.height);
}

void write_uint_exr(const fs::path& file, Extent extent) {
  Imf::Header header(extent.width, extent.height);
  const std::vector<unsigned> ones(extent.count(), 1);
  Imf::FrameBuffer buffer;
  for (const char* name : {"R", "G", "B"}) {
    header.channels().insert(name, Imf::Channel(Imf::UINT));
    buffer.insert(name, slice(Imf::UINT, ones.data(), sizeof(unsigned),
                              sizeof(unsigned) * static_cast<std::size_t>(extent.width),
                              header.dataWindow()));
  }
  Imf::OutputFile out(file.c_str(), header);
  out.setFrameBuffer(buffer);
  out.writePixels(extent.height);
}

void write_two_part_exr(const fs::path& file, const Grid<Rgb>& first, const Grid<Rgb>& second) {
  std::vector<Imf::Header> headers = {header_of(first.extent(), {}),
                                      header_of(second.extent(), {})};
  headers[0].setName("first");
  headers[1].setName("second");
  for (Imf::Header& header : headers) header.setType(Imf::SCANLINEIMAGE);
  Imf::MultiPartOutputFile out(file.c_str(), headers.data(), 2);
  for (int i = 0; i < 2; ++i) {
    const Grid<Rgb>& picture = i == 0 ? first : second;
    Imf::OutputPart part(out, i);
    part.setFrameBuffer(
        buffer_of(picture, {}, {}, headers[static_cast<std::size_t>(i)].dataWindow()));
    part.writePixels(picture.extent().height);
  }
}

void write_deep_exr(const fs::path& file, Extent extent) {
  Imf::Header header(extent.width, extent.height);
  header.setType(Imf::DEEPSCANLINE);
  header.compression() = Imf::ZIPS_COMPRESSION;
  const std::vector<unsigned> counts(extent.count(), 1);
  float one = 1.0F;
  const std::vector<float*> samples(extent.count(), &one);
  const auto width = static_cast<std::size_t>(extent.width);
  Imf::DeepFrameBuffer buffer;
  buffer.insertSampleCountSlice(slice(Imf::UINT, counts.data(), sizeof(unsigned),
                                      sizeof(unsigned) * width, header.dataWindow()));
  for (const char* name : {"R", "G", "B"}) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    buffer.insert(name, Imf::DeepSlice(Imf::FLOAT,
                                       reinterpret_cast<char*>(const_cast<float**>(samples.data())),
                                       sizeof(float*), sizeof(float*) * width, sizeof(float)));
  }
  Imf::DeepScanLineOutputFile out(file.c_str(), header);
  out.setFrameBuffer(buffer);
  out.writePixels(extent.height);
}

void write_luminance_chroma_exr(const fs::path& file, Extent extent) {
  const std::vector<Imf::Rgba> pixels(extent.count(), Imf::Rgba(0.5F, 0.25F, 1.0F));
  Imf::RgbaOutputFile out(file.c_str(), extent.width, extent.height, Imf::WRITE_YC);
  out.setFrameBuffer(pixels.data(), 1, static_cast<std::size_t>(extent.width));
  out.writePixels(extent.height);
}

void write_hdr_file(const fs::path& file, const std::string& resolution,
                    const std::vector<Rgbe>& pixels, const std::string& header_lines) {
  std::string bytes =
      "#?RADIANCE\n" + header_lines + "FORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n";
  for (const Rgbe pixel : pixels) {
    for (const unsigned char byte : {pixel.r, pixel.g, pixel.b, pixel.exponent}) {
      bytes.push_back(static_cast<char>(byte));
    }
  }
  write_bytes(file, bytes);
}

void write_integer_picture(const fs::path& file, Extent extent, int channels,
                           const std::vector<unsigned>& values, int bits, int orientation) {
  OIIO::ImageSpec spec(extent.width, extent.height, channels,
                       bits == 8 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::UINT16);
  spec.attribute("Orientation", orientation);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("CompressionQuality", 100);
  const std::vector<unsigned char> narrow(values.begin(), values.end());
  const std::vector<unsigned short> wide(values.begin(), values.end());
  const void* pixels = bits == 8 ? static_cast<const void*>(narrow.data()) : wide.data();
  const auto out = OIIO::ImageOutput::create(file.string());
  if (!out || !out->open(file.string(), spec) || !out->write_image(spec.format, pixels) ||
      !out->close()) {
    throw std::runtime_error("test picture not written: " + file.string());
  }
}

void write_png_with_gamma(const fs::path& file, Extent extent, const std::vector<unsigned>& values,
                          double gamma) {
  write_integer_picture(file, extent, 3, values, 8);
  std::string png = bytes_of(file);
  const auto big_endian = [](std::uint32_t number) {
    std::string bytes;
    for (const int shift : {24, 16, 8, 0}) bytes.push_back(static_cast<char>(number >> shift));
    return bytes;
  };
  // Chunks that say the same thing in other words are taken out.
  for (std::size_t at = 8; at + 12 <= png.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i)
      length = 256 * length + static_cast<unsigned char>(png[at + i]);
    const std::string type = png.substr(at + 4, 4);
    if (type == "sRGB" || type == "gAMA" || type == "iCCP") {
      png.erase(at, 12 + length);
    } else {
      at += 12 + length;
    }
  }
  const std::string chunk =
      "gAMA" + big_endian(static_cast<std::uint32_t>(std::lround(gamma * 1e5)));
  std::uint32_t crc = 0xffffffffU;  // CRC-32 of PNG, annex D
  for (const char c : chunk) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
  }
  constexpr std::size_t kAfterHeader = 8 + 25;
  png.insert(kAfterHeader, big_endian(4) + chunk + big_endian(~crc));
  write_bytes(file, png);
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const fs::path& file, std::string_view bytes) {
  std::ofstream out(file, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

Grid<Rgb> numbered_picture(Extent extent) {
  Grid<Rgb> picture(extent);
  float next = 1.0F;
  for (Rgb& rgb : picture.values()) {
    rgb = {next, next + 0.25F, next + 0.5F};
    next += 1.0F;
  }
  return picture;
}

}  // namespace lightproof::test
