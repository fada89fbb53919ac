// JPEG pictures. libjpeg reports errors by a call that must not return: it throws.
#include <cstddef>
#include <cstdio>
// Kept apart: it needs the two before it.
#include <jpeglib.h>
// Kept apart: it needs the one before it.
#include <jerror.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

#include "lightproof/decoder/embedded_profile.h"
#include "lightproof/decoder/exif.h"
#include "lightproof/decoder/picture_decoder.h"
#include "lightproof/decoder/refusal.h"

namespace lightproof {
namespace {

constexpr int kExifMarker = JPEG_APP0 + 1;
constexpr int kProfileMarker = JPEG_APP0 + 2;
constexpr unsigned kLongestMarker = 0xffff;
constexpr std::size_t kBlock = std::size_t{1} << 16U;
constexpr std::string_view kExifName{"Exif\0\0", 6};
/// Followed by the number of the piece and how many there are.
constexpr std::string_view kProfileName{"ICC_PROFILE\0", 12};
/// A progressive picture is kept as coefficients of 16 bits, some of its blocks several times.
constexpr std::uint64_t kBytesOfCoefficient = 4;

/// Messages after which pixels are not those of the picture.
constexpr std::array kLosses = {JWRN_HIT_MARKER,    JWRN_HUFF_BAD_CODE,    JWRN_JPEG_EOF,
                                JWRN_MUST_RESYNC,   JWRN_NOT_SEQUENTIAL,   JWRN_ARITH_BAD_CODE,
                                JWRN_TOO_MUCH_DATA, JWRN_BOGUS_PROGRESSION};

std::string message_of(j_common_ptr jpeg) {
  std::array<char, JMSG_LENGTH_MAX> text{};
  jpeg->err->format_message(jpeg, text.data());
  return text.data();
}

[[noreturn]] void fail(j_common_ptr jpeg) { throw std::runtime_error(message_of(jpeg)); }

void warn(j_common_ptr jpeg, int level) {
  if (level >= 0 || std::ranges::count(kLosses, jpeg->err->msg_code) == 0) return;
  throw std::runtime_error(message_of(jpeg));
}

void ignore(j_common_ptr /*jpeg*/) {}

std::span<const std::uint8_t> after(const jpeg_marker_struct& marker, std::string_view name) {
  const std::span<const std::uint8_t> data(marker.data, marker.data_length);
  if (data.size() < name.size() || !std::equal(name.begin(), name.end(), data.begin())) return {};
  return data.subspan(name.size());
}

/// Bytes of the file for libjpeg, a block at a time.
struct Source {
  jpeg_source_mgr manager{};  // first: libjpeg knows this part
  ByteReader* bytes = nullptr;
  std::vector<std::uint8_t> block;

  static boolean fill(j_decompress_ptr jpeg) {
    auto& source = *reinterpret_cast<Source*>(jpeg->src);
    const std::uint64_t left = source.bytes->size() - source.bytes->position();
    if (left == 0) throw std::runtime_error("the file ends early");
    source.block.resize(std::min<std::uint64_t>(left, kBlock));
    if (!source.bytes->read(source.block)) throw std::runtime_error("the file ends early");
    source.manager.next_input_byte = source.block.data();
    source.manager.bytes_in_buffer = source.block.size();
    return TRUE;
  }
  static void skip(j_decompress_ptr jpeg, long count) {
    auto left = static_cast<std::size_t>(std::max(count, 0L));
    while (left > jpeg->src->bytes_in_buffer) {
      left -= jpeg->src->bytes_in_buffer;
      fill(jpeg);
    }
    jpeg->src->next_input_byte += left;
    jpeg->src->bytes_in_buffer -= left;
  }
  static void nothing(j_decompress_ptr /*jpeg*/) {}
};

/// Whether the end marker follows the start of the compressed data, inside which it cannot occur.
/// libjpeg fills the missing part of a cut-off file with grey and calls that a warning.
bool has_end(ByteReader& bytes) {
  bytes.seek(2);
  for (;;) {
    const auto first = bytes.next();
    auto type = bytes.next();
    while (first == 0xff && type == 0xff) type = bytes.next();  // padding
    if (!type) return false;
    if (first != 0xff || *type == 0xda) break;
    std::array<std::uint8_t, 2> length{};
    if (!bytes.read(length)) return false;
    const unsigned count = 256U * length[0] + length[1];
    bytes.seek(bytes.position() + std::max(count, 2U) - 2);
  }
  std::uint8_t before = 0;
  while (const auto byte = bytes.next()) {
    if (before == 0xff && *byte == 0xd9) return true;
    before = *byte;
  }
  return false;
}

class JpegDecoder : public PictureDecoder {
 public:
  explicit JpegDecoder(ByteReader& bytes) {
    if (!has_end(bytes)) {
      refuse("cannot be read as JPEG: the file is cut off before its end marker");
    }
    bytes.seek(0);
    jpeg_.err = jpeg_std_error(&errors_);
    errors_.error_exit = fail;
    errors_.emit_message = warn;
    errors_.output_message = ignore;
    jpeg_create_decompress(&jpeg_);
    source_.bytes = &bytes;
    source_.manager.init_source = Source::nothing;
    source_.manager.fill_input_buffer = Source::fill;
    source_.manager.skip_input_data = Source::skip;
    source_.manager.resync_to_restart = jpeg_resync_to_restart;
    source_.manager.term_source = Source::nothing;
    jpeg_.src = &source_.manager;
    try {
      jpeg_save_markers(&jpeg_, kExifMarker, kLongestMarker);
      jpeg_save_markers(&jpeg_, kProfileMarker, kLongestMarker);
      jpeg_read_header(&jpeg_, TRUE);
      describe();
    } catch (...) {
      jpeg_destroy_decompress(&jpeg_);
      throw;
    }
  }
  ~JpegDecoder() override { jpeg_destroy_decompress(&jpeg_); }
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  const StoredPicture& picture() const override { return stored_; }

  DecodingCost cost() const override {
    const std::uint64_t samples = std::uint64_t{jpeg_.image_width} * jpeg_.image_height *
                                  static_cast<std::uint64_t>(jpeg_.num_components);
    return {.bytes = samples * kBytesOfCoefficient, .samples = samples};
  }

  void read(const ReadRequest& request, const TakeRows& take) override {
    jpeg_start_decompress(&jpeg_);
    std::vector<std::size_t> channels;
    for (const std::string& name : request.channels) {
      channels.push_back(
          static_cast<std::size_t>(std::ranges::find(stored_.channels, name, &StoredChannel::name) -
                                   stored_.channels.begin()));
    }
    const std::size_t width = jpeg_.output_width;
    std::vector<JSAMPLE> row(width * static_cast<std::size_t>(jpeg_.output_components));
    std::vector<float> rows;
    while (jpeg_.output_scanline < jpeg_.output_height) {
      JSAMPROW at = row.data();
      jpeg_read_scanlines(&jpeg_, &at, 1);
      if (is_cmyk_) cmyk_to_rgb(row, width);
      const std::size_t of_pixel = is_cmyk_ ? 4 : stored_.channels.size();
      for (std::size_t x = 0; x < width; ++x) {
        for (const std::size_t channel : channels) rows.push_back(row[x * of_pixel + channel]);
      }
      const bool is_last = jpeg_.output_scanline == jpeg_.output_height;
      if (!is_last && rows.size() * sizeof(float) < kBytesAtOnce / 2) continue;
      take(rows);
      rows.clear();
    }
  }

 private:
  void describe() {
    stored_.data = {.width = jpeg_.image_width, .height = jpeg_.image_height};
    stored_.display = stored_.data;
    is_cmyk_ = jpeg_.jpeg_color_space == JCS_CMYK || jpeg_.jpeg_color_space == JCS_YCCK;
    if (is_cmyk_) jpeg_.out_color_space = JCS_CMYK;
    if (jpeg_.num_components == 1) {
      stored_.channels = {{.name = "Y", .type = SampleType::uint8}};
    } else if (is_cmyk_ || jpeg_.num_components == 3) {
      if (!is_cmyk_) jpeg_.out_color_space = JCS_RGB;
      for (const char* name : {"R", "G", "B"}) {
        stored_.channels.push_back({.name = name, .type = SampleType::uint8});
      }
    } else {
      refuse("cannot be read as JPEG: one, three or four channels needed");
    }
    read_markers();
  }

  void read_markers() {
    std::vector<std::uint8_t> profile;
    for (auto* marker = jpeg_.marker_list; marker != nullptr; marker = marker->next) {
      if (marker->marker == kExifMarker) {
        const auto exif = after(*marker, kExifName);
        if (!exif.empty()) stored_.exif_orientation = exif_orientation(exif);
      } else {
        const auto piece = after(*marker, kProfileName);
        if (piece.size() > 2) profile.insert(profile.end(), piece.begin() + 2, piece.end());
      }
    }
    if (!profile.empty()) stored_.profile = profile_name(profile);
  }

  /// Adobe's programs store 255 minus each ink, and those are all that write such files.
  static void cmyk_to_rgb(std::vector<JSAMPLE>& row, std::size_t width) {
    for (std::size_t x = 0; x < width; ++x) {
      const unsigned key = row[4 * x + 3];
      for (std::size_t i = 0; i < 3; ++i) {
        row[4 * x + i] = static_cast<JSAMPLE>((row[4 * x + i] * key + 127) / 255);
      }
    }
  }

  jpeg_decompress_struct jpeg_{};
  jpeg_error_mgr errors_{};
  Source source_;
  StoredPicture stored_;
  bool is_cmyk_ = false;
};

}  // namespace

std::unique_ptr<PictureDecoder> open_jpeg(ByteReader& bytes) {
  return std::make_unique<JpegDecoder>(bytes);
}

}  // namespace lightproof
