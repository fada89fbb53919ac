#include <png.h>

#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "lightproof/decoder/picture_encoder.h"

namespace lightproof {
namespace {

[[noreturn]] void fail(png_structp /*png*/, png_const_charp message) {
  throw std::runtime_error(message);
}

void ignore(png_structp /*png*/, png_const_charp /*message*/) {}

void append(png_structp png, png_bytep from, std::size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<char*>(from), count);
}

void flush(png_structp /*png*/) {}

class Writer {
 public:
  Writer() : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore)) {
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) throw std::bad_alloc();
    png_set_write_fn(png_, &bytes_, append, flush);
  }
  ~Writer() { png_destroy_write_struct(&png_, &info_); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  void write_head(LevelSize size, const Attributes& attributes) {
    png_set_IHDR(png_, info_, static_cast<unsigned>(size.width), static_cast<unsigned>(size.height),
                 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
    for (const Attribute& attribute : attributes) add_text(attribute);
    png_write_info(png_, info_);
  }
  void write_row(const std::vector<std::uint8_t>& row) { png_write_row(png_, row.data()); }
  std::string finish() {
    png_write_end(png_, info_);
    return std::move(bytes_);
  }

 private:
  void add_text(const Attribute& attribute) {
    std::string name = file_name_of(attribute);
    std::string value = line_of(attribute);
    std::string none;
    png_text text = {};
    text.compression = PNG_ITXT_COMPRESSION_NONE;
    text.key = name.data();
    text.text = value.data();
    text.itxt_length = value.size();
    text.lang = none.data();
    text.lang_key = none.data();
    png_set_text(png_, info_, &text, 1);  // which copies it
  }

  std::string bytes_;
  png_structp png_;
  png_infop info_ = nullptr;
};

}  // namespace

std::string png_file(const EncodeRequest& request, const NextSamples& next) {
  const LevelSize size = request.levels.at(0);
  Writer writer;
  writer.write_head(size, request.attributes);
  std::vector<std::uint8_t> row(3 * static_cast<std::size_t>(size.width));
  for (int y = 0; y < size.height; ++y) {
    next(std::as_writable_bytes(std::span(row)));
    writer.write_row(row);
  }
  return writer.finish();
}

}  // namespace lightproof
