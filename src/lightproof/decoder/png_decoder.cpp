// PNG pictures. libpng reports errors by a call that must not return: it throws.
#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>

#include "lightproof/decoder/embedded_profile.h"
#include "lightproof/decoder/exif.h"
#include "lightproof/decoder/picture_decoder.h"
#include "lightproof/decoder/refusal.h"
#include "lightproof/image/picture_header.h"

namespace lightproof {
namespace {

/// Chunks beside the pixels that are larger are passed over.
constexpr std::size_t kLargestChunk = std::size_t{8} << 20U;
constexpr std::uint64_t kSignature = 8;

[[noreturn]] void fail(png_structp /*png*/, png_const_charp message) {
  throw std::runtime_error(message);
}

void ignore(png_structp /*png*/, png_const_charp /*message*/) {}

void read_bytes(png_structp png, png_bytep to, std::size_t count) {
  auto& bytes = *static_cast<ByteReader*>(png_get_io_ptr(png));
  if (!bytes.read({to, count})) throw std::runtime_error("the file ends early");
}

std::uint32_t number_of(std::span<const std::uint8_t> bytes) {
  std::uint32_t number = 0;
  for (const std::uint8_t byte : bytes) number = number << 8U | byte;
  return number;
}

/// Whether the chunks go on to IEND.
bool has_end(ByteReader& bytes) {
  bytes.seek(kSignature);
  std::array<std::uint8_t, 8> head{};  // length and type
  while (bytes.read(head)) {
    const auto type = std::span(head).subspan(4);
    if (std::ranges::equal(type, std::string_view("IEND"))) {
      return bytes.position() + 4 <= bytes.size();
    }
    bytes.seek(bytes.position() + number_of(std::span(head).first(4)) + 4);
  }
  return false;
}

/// What libpng keeps of a picture.
struct PngStructs {
  PngStructs() = default;
  ~PngStructs() { png_destroy_read_struct(&png, &info, nullptr); }
  PngStructs(const PngStructs&) = delete;
  PngStructs& operator=(const PngStructs&) = delete;

  png_structp png = nullptr;
  png_infop info = nullptr;
};

class PngDecoder : public PictureDecoder {
 public:
  explicit PngDecoder(ByteReader& bytes) {
    if (!has_end(bytes)) {
      refuse("cannot be read as PNG: the file is cut off before its end marker");
    }
    bytes.seek(0);
    structs_.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore);
    if (structs_.png != nullptr) structs_.info = png_create_info_struct(structs_.png);
    if (structs_.info == nullptr) throw std::bad_alloc();
    png_set_read_fn(structs_.png, &bytes, read_bytes);
    png_set_user_limits(structs_.png, static_cast<unsigned>(kLargestPicture.width),
                        static_cast<unsigned>(kLargestPicture.width));
    png_set_chunk_malloc_max(structs_.png, kLargestChunk);
    png_read_info(structs_.png, structs_.info);
    note_colours();
    choose_form();
  }

  const StoredPicture& picture() const override { return stored_; }

  DecodingCost cost() const override {
    const std::uint64_t all = height() * row_bytes();
    return {.bytes = is_interlaced_ ? all : 2 * row_bytes(), .samples = height() * row_bytes()};
  }

  void read(const ReadRequest& request, const TakeRows& take) override {
    channels_.clear();
    for (const std::string& name : request.channels) {
      channels_.push_back(
          static_cast<std::size_t>(std::ranges::find(stored_.channels, name, &StoredChannel::name) -
                                   stored_.channels.begin()));
    }
    if (is_interlaced_) {
      read_interlaced(take);
    } else {
      std::vector<std::uint8_t> row(row_bytes());
      read_rows(take, [&](std::uint64_t /*y*/) {
        png_read_row(structs_.png, row.data(), nullptr);
        return std::span<const std::uint8_t>(row);
      });
    }
  }

 private:
  std::uint64_t height() const { return static_cast<std::uint64_t>(stored_.data.height); }
  std::size_t row_bytes() const { return png_get_rowbytes(structs_.png, structs_.info); }

  void note_colours() {
    double gamma = 0.0;
    // sRGB says how the values are encoded, and gAMA beside it the nearest power.
    const bool is_srgb = png_get_valid(structs_.png, structs_.info, PNG_INFO_sRGB) != 0;
    if (!is_srgb && png_get_gAMA(structs_.png, structs_.info, &gamma) != 0 && gamma > 0.0) {
      stored_.gamma = 1.0 / gamma;
    }
    png_charp name = nullptr;
    int compression = 0;
    png_bytep profile = nullptr;
    png_uint_32 length = 0;
    if (png_get_iCCP(structs_.png, structs_.info, &name, &compression, &profile, &length) != 0) {
      stored_.profile = profile_name({profile, length});
    }
    png_bytep exif = nullptr;
    png_uint_32 exif_bytes = 0;
    if (png_get_eXIf_1(structs_.png, structs_.info, &exif_bytes, &exif) != 0) {
      stored_.exif_orientation = exif_orientation({exif, exif_bytes});
    }
  }

  /// Palettes become colours, fewer bits 8; 16 bits in the order of this machine.
  void choose_form() {
    png_set_expand(structs_.png);
    if constexpr (std::endian::native == std::endian::little) png_set_swap(structs_.png);
    is_interlaced_ = png_set_interlace_handling(structs_.png) > 1;
    png_read_update_info(structs_.png, structs_.info);
    stored_.data = {.width = png_get_image_width(structs_.png, structs_.info),
                    .height = png_get_image_height(structs_.png, structs_.info)};
    stored_.display = stored_.data;
    is_wide_ = png_get_bit_depth(structs_.png, structs_.info) == 16;
    const auto count = static_cast<std::size_t>(png_get_channels(structs_.png, structs_.info));
    const std::vector<std::string> names = count < 3 ? std::vector<std::string>{"Y", "A"}
                                                     : std::vector<std::string>{"R", "G", "B", "A"};
    for (std::size_t i = 0; i < std::min(count, names.size()); ++i) {
      stored_.channels.push_back(
          {.name = names[i], .type = is_wide_ ? SampleType::uint16 : SampleType::uint8});
    }
  }

  void read_interlaced(const TakeRows& take) {
    std::vector<std::uint8_t> whole(height() * row_bytes());
    std::vector<png_bytep> rows(height());
    for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = &whole[y * row_bytes()];
    png_read_image(structs_.png, rows.data());
    read_rows(take,
              [&](std::uint64_t y) { return std::span<const std::uint8_t>(rows[y], row_bytes()); });
  }

  template <class RowAt>
  void read_rows(const TakeRows& take, const RowAt& row_at) {
    const auto width = static_cast<std::size_t>(stored_.data.width);
    const std::size_t of_line = width * channels_.size();
    std::vector<float> rows;
    for (std::uint64_t y = 0; y < height(); ++y) {
      append(rows, row_at(y));
      if (rows.size() * sizeof(float) < kBytesAtOnce - of_line && y + 1 < height()) continue;
      take(rows);
      rows.clear();
    }
  }

  void append(std::vector<float>& rows, std::span<const std::uint8_t> row) const {
    const std::size_t of_pixel = stored_.channels.size();
    for (std::size_t x = 0; x < static_cast<std::size_t>(stored_.data.width); ++x) {
      for (const std::size_t channel : channels_) {
        const std::size_t at = x * of_pixel + channel;
        std::uint16_t value = 0;
        if (is_wide_) {
          std::copy_n(&row[2 * at], 2, reinterpret_cast<std::uint8_t*>(&value));
        } else {
          value = row[at];
        }
        rows.push_back(value);
      }
    }
  }

  PngStructs structs_;
  StoredPicture stored_;
  std::vector<std::size_t> channels_;
  bool is_interlaced_ = false;
  bool is_wide_ = false;
};

}  // namespace

std::unique_ptr<PictureDecoder> open_png(ByteReader& bytes) {
  return std::make_unique<PngDecoder>(bytes);
}

}  // namespace lightproof
