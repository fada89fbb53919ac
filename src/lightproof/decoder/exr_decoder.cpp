// OpenEXR pictures, by the library's classic interface: the newer one of OpenEXR 3.1 aborts on
// damaged files and cannot decode DWAA and DWAB.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfRgbaYca.h>
#include <ImfStandardAttributes.h>
#include <ImfThreading.h>
#include <ImfTileDescription.h>
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "lightproof/decoder/confinement.h"
#include "lightproof/decoder/exr_chunks.h"
#include "lightproof/decoder/picture_decoder.h"
#include "lightproof/decoder/refusal.h"
#include "lightproof/image/picture_header.h"

namespace lightproof {
namespace {

constexpr int kMostParts = 1024;
/// Sides of a tile and of a picture in either direction; what else is refused is judged elsewhere.
constexpr int kLargestTileSide = 65536;
/// Pictures with fewer samples are decoded before threads have started.
constexpr std::uint64_t kFewSamples = std::uint64_t{1} << 18U;
/// No picture that is accepted takes more.
constexpr std::uint64_t kMostBytes = std::uint64_t{8} << 30U;
constexpr std::uint64_t kBytesOfSample = 4;
/// What fresh memory is filled with where it matters.
constexpr int kUnwritten = 0xfe;
/// Larger chunks than these get memory that the system has cleared: filling it would take as much
/// of it as a file claims to need.
constexpr std::uint64_t kMostFilled = std::uint64_t{16} << 20U;
constexpr int kAlwaysCleared = 1 << 20;
/// Copies of a chunk that are in memory: as it is stored, as it is decompressed, and in between.
constexpr std::uint64_t kCopies = 3;

class Stream : public Imf::IStream {
 public:
  explicit Stream(ByteReader& bytes) : IStream("the file"), bytes_(bytes) {}

  /// From now on only chunks are read.
  void expect_chunks() { expects_chunks_ = true; }

  bool read(char c[], int n) override {
    // OpenEXR takes a chunk without a byte, and shows what was in its memory before.
    if (n == 0 && expects_chunks_) throw std::runtime_error("a chunk has no bytes");
    if (n < 0 || !bytes_.read({reinterpret_cast<std::uint8_t*>(c), static_cast<std::size_t>(n)})) {
      throw std::runtime_error(fmt::format("the file ends early, at byte {}", bytes_.size()));
    }
    return bytes_.position() < bytes_.size();
  }
  std::uint64_t tellg() override { return bytes_.position(); }
  void seekg(std::uint64_t position) override { bytes_.seek(position); }

 private:
  ByteReader& bytes_;
  bool expects_chunks_ = false;
};

PixelWindow window_of(const Imath::Box2i& box) {
  return {.x = box.min.x,
          .y = box.min.y,
          .width = std::int64_t{box.max.x} - box.min.x + 1,
          .height = std::int64_t{box.max.y} - box.min.y + 1};
}

struct CompressionInfo {
  Imf::Compression compression;
  std::string_view name;
  std::int64_t rows;  ///< that are compressed together
};

constexpr CompressionInfo kCompressions[] = {
    {Imf::NO_COMPRESSION, "none", 1},    {Imf::RLE_COMPRESSION, "rle", 1},
    {Imf::ZIPS_COMPRESSION, "zips", 1},  {Imf::ZIP_COMPRESSION, "zip", 16},
    {Imf::PIZ_COMPRESSION, "piz", 32},   {Imf::PXR24_COMPRESSION, "pxr24", 16},
    {Imf::B44_COMPRESSION, "b44", 32},   {Imf::B44A_COMPRESSION, "b44a", 32},
    {Imf::DWAA_COMPRESSION, "dwaa", 32}, {Imf::DWAB_COMPRESSION, "dwab", 256},
};

const CompressionInfo& info(Imf::Compression compression) {
  const auto* found = std::ranges::find(kCompressions, compression, &CompressionInfo::compression);
  if (found == std::end(kCompressions)) {
    refuse(fmt::format("cannot be read as OpenEXR: compression {} is not known here",
                       static_cast<int>(compression)));
  }
  return *found;
}

SampleType type_of(Imf::PixelType type) {
  if (type == Imf::HALF) return SampleType::half_float;
  return type == Imf::UINT ? SampleType::uint32 : SampleType::single_float;
}

/// Layers by name, in each red, green, blue and alpha first.
std::vector<StoredChannel> channels_of(const Imf::ChannelList& list) {
  constexpr std::array<std::string_view, 5> kFirst = {"R", "G", "B", "A", "Z"};
  struct Placed {
    std::string layer;
    std::size_t rank;
    StoredChannel channel;
  };
  std::vector<Placed> placed;
  for (auto at = list.begin(); at != list.end(); ++at) {
    const std::string name = at.name();
    const std::size_t point = name.rfind('.');
    const std::string layer = point == std::string::npos ? "" : name.substr(0, point);
    const std::string_view last = std::string_view(name).substr(layer.empty() ? 0 : point + 1);
    placed.push_back({layer,
                      static_cast<std::size_t>(std::ranges::find(kFirst, last) - kFirst.begin()),
                      {name, type_of(at.channel().type),
                       at.channel().xSampling != 1 || at.channel().ySampling != 1}});
  }
  std::ranges::stable_sort(placed, {}, [](const Placed& p) { return std::tie(p.layer, p.rank); });
  std::vector<StoredChannel> channels;
  for (Placed& p : placed) channels.push_back(std::move(p.channel));
  return channels;
}

std::optional<Chromaticities> chromaticities_of(const Imf::Header& header) {
  if (!Imf::hasChromaticities(header)) return std::nullopt;
  const Imf::Chromaticities& c = Imf::chromaticities(header);
  const auto xy = [](const Imath::V2f& v) { return std::array<double, 2>{v.x, v.y}; };
  return Chromaticities{xy(c.red), xy(c.green), xy(c.blue), xy(c.white)};
}

/// A file of CIE XYZ values declares (1, 0) and (0, 1) as the chromaticities of its "R" and "G".
bool says_xyz(const std::optional<Chromaticities>& c) {
  return c && c->red == std::array{1.0, 0.0} && c->green == std::array{0.0, 1.0};
}

StoredPicture stored_picture(const Imf::MultiPartInputFile& file, int part) {
  StoredPicture stored;
  stored.parts.clear();
  const int parts = std::clamp(file.parts(), 1, kMostParts);
  for (int i = 0; i < parts; ++i) {
    stored.parts.push_back(file.header(i).hasName() ? file.header(i).name() : "");
  }
  const Imf::Header& header = file.header(std::clamp(part, 0, parts - 1));
  stored.data = window_of(header.dataWindow());
  stored.display = window_of(header.displayWindow());
  if (const auto tiles = tiles_of(header)) {
    stored.tile_width = tiles->xSize;
    stored.tile_height = tiles->ySize;
  }
  stored.channels = channels_of(header.channels());
  stored.compression = info(header.compression()).name;
  stored.is_deep = header.hasType() && Imf::isDeepData(header.type());
  if (Imf::hasEnvmap(header)) {
    stored.is_cube = Imf::envmap(header) == Imf::ENVMAP_CUBE;
    stored.is_lat_long = Imf::envmap(header) == Imf::ENVMAP_LATLONG;
  }
  stored.chromaticities = chromaticities_of(header);
  stored.holds_xyz = says_xyz(stored.chromaticities);
  stored.pixel_aspect = header.pixelAspectRatio();
  return stored;
}

class ExrDecoder : public PictureDecoder {
 public:
  ExrDecoder(ByteReader& bytes, int part) : stream_(bytes), part_(part) {
    Imf::Header::setMaxImageSize(kLargestPicture.width, kLargestPicture.width);
    Imf::Header::setMaxTileSize(kLargestTileSide, kLargestTileSide);
    file_ = std::make_unique<Imf::MultiPartInputFile>(stream_, threads_to_use());
    stored_ = stored_picture(*file_, part);
  }

  const StoredPicture& picture() const override { return stored_; }

  DecodingCost cost() const override {
    const auto width = static_cast<std::uint64_t>(stored_.data.width);
    const auto height = static_cast<std::uint64_t>(stored_.data.height);
    const std::uint64_t of_pixel = kBytesOfSample * stored_.channels.size();
    const std::uint64_t tile_row = width * static_cast<std::uint64_t>(stored_.tile_height);
    const std::uint64_t chunk = pixels_of_chunk();
    // The library keeps two chunks a thread.
    const std::uint64_t chunks = kCopies * (2 * static_cast<std::uint64_t>(threads_to_use()) + 2);
    return {.bytes = std::min(kMostBytes, of_pixel * (chunks * chunk + tile_row)),
            .samples = width * height * stored_.channels.size()};
  }

  void read(const ReadRequest& request, const TakeRows& take) override {
    if (stored_.compression.starts_with("dwa")) fill_fresh_memory();
    if (cost().samples > kFewSamples) Imf::setGlobalThreadCount(threads_to_use());
    if (request.from_luminance_chroma) {
      read_luminance_chroma(take);
    } else {
      read_channels(request.channels, take);
    }
  }

 private:
  std::uint64_t pixels_of_chunk() const {
    if (stored_.tile_width > 0) {
      return static_cast<std::uint64_t>(stored_.tile_width * stored_.tile_height);
    }
    const auto* const compression =
        std::ranges::find(kCompressions, stored_.compression, &CompressionInfo::name);
    return static_cast<std::uint64_t>(stored_.data.width) *
           static_cast<std::uint64_t>(compression->rows);
  }

  /// A damaged chunk by DWAA or DWAB may show memory that nobody wrote to, and OpenEXR does not
  /// notice. Filled with these bytes it holds no number as a 16-bit float, and a negative one as a
  /// 32-bit float: what looks at the values refuses either.
  void fill_fresh_memory() const {
    const std::uint64_t bytes = kBytesOfSample * stored_.channels.size() * pixels_of_chunk();
    if (bytes <= kMostFilled) {
      ::mallopt(M_PERTURB, ~kUnwritten & 0xff);
    } else {
      ::mallopt(M_MMAP_THRESHOLD, kAlwaysCleared);
    }
  }

  /// Lines [first, last) of the picture, in the order from the top, a few at a time. What no sample
  /// was written to is NaN, which a later look at the values finds.
  template <class ReadLines>
  void in_pieces(std::size_t channels, const TakeRows& take, const ReadLines& read_lines) const {
    const auto of_line = static_cast<std::size_t>(stored_.data.width) * channels;
    const auto at_once =
        static_cast<std::int64_t>(std::max<std::uint64_t>(1, kBytesAtOnce / (4 * of_line)));
    std::vector<float> rows;
    for (std::int64_t first = 0; first < stored_.data.height; first += at_once) {
      const std::int64_t last = std::min(first + at_once, stored_.data.height);
      rows.assign(static_cast<std::size_t>(last - first) * of_line,
                  std::numeric_limits<float>::quiet_NaN());
      read_lines(static_cast<int>(stored_.data.y + first), static_cast<int>(stored_.data.y + last),
                 rows);
      take(rows);
    }
  }

  void read_channels(const std::vector<std::string>& names, const TakeRows& take) {
    Imf::InputPart part(*file_, part_);
    expect_chunks_of(part.header());
    stream_.expect_chunks();
    in_pieces(names.size(), take, [&](int first, int last, std::vector<float>& rows) {
      const std::size_t step = sizeof(float) * names.size();
      const Imath::Box2i& window = part.header().dataWindow();
      Imf::FrameBuffer buffer;
      for (std::size_t i = 0; i < names.size(); ++i) {
        buffer.insert(names[i],
                      Imf::Slice::Make(Imf::FLOAT, &rows[i], Imath::V2i(window.min.x, first),
                                       stored_.data.width, last - first, step,
                                       step * static_cast<std::size_t>(stored_.data.width)));
      }
      part.setFrameBuffer(buffer);
      check_chunks(part, first, last);
      part.readPixels(first, last - 1);
    });
  }

  /// Throws what Imf::RgbaInputFile throws for primaries that make no colours, which forgets to
  /// close the file then.
  static void expect_primaries(const Imf::Header& header) {
    if (Imf::hasChromaticities(header)) Imf::RgbaYca::computeYw(Imf::chromaticities(header));
  }

  void read_luminance_chroma(const TakeRows& take) {
    if (part_ != 0) {
      refuse(
          "cannot be read as OpenEXR: luminance and chroma are converted in the first part only");
    }
    expect_chunks_of(file_->header(0));
    expect_primaries(file_->header(0));
    file_.reset();
    stream_.seekg(0);
    Imf::RgbaInputFile file(stream_, threads_to_use());
    stream_.expect_chunks();
    const int left = file.dataWindow().min.x;
    const auto width = static_cast<std::size_t>(stored_.data.width);
    std::vector<Imf::Rgba> pixels;
    in_pieces(3, take, [&](int first, int last, std::vector<float>& rows) {
      pixels.assign(rows.size() / 3, Imf::Rgba(NAN, NAN, NAN, NAN));
      // Where the pixel (0, 0) would lie.
      const std::ptrdiff_t origin =
          -left - static_cast<std::ptrdiff_t>(width) * static_cast<std::ptrdiff_t>(first);
      file.setFrameBuffer(pixels.data() + origin, 1, width);
      file.readPixels(first, last - 1);
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        rows[3 * i] = pixels[i].r;
        rows[3 * i + 1] = pixels[i].g;
        rows[3 * i + 2] = pixels[i].b;
      }
    });
  }

  Stream stream_;
  int part_;
  std::unique_ptr<Imf::MultiPartInputFile> file_;
  StoredPicture stored_;
};

}  // namespace

std::unique_ptr<PictureDecoder> open_exr(ByteReader& bytes, int part) {
  return std::make_unique<ExrDecoder>(bytes, part);
}

}  // namespace lightproof
