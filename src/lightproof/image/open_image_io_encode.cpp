#include "lightproof/image/open_image_io_encode.h"

#include <memory>
#include <vector>

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

class Encoder {
 public:
  explicit Encoder(std::string format)
      : format_(std::move(format)), memory_(bytes_), out_(OIIO::ImageOutput::create(format_)) {
    if (!out_) throw InputError(fmt::format("cannot write {}: {}", format_, OIIO::geterror()));
    check(out_->set_ioproxy(&memory_));
  }

  void add(const OIIO::ImageSpec& spec, const void* pixels, bool is_first) {
    using Mode = OIIO::ImageOutput::OpenMode;
    check(out_->open("." + format_, spec, is_first ? Mode::Create : Mode::AppendMIPLevel));
    check(out_->write_image(spec.format, pixels));
  }

  std::string finish() {
    check(out_->close());
    out_.reset();  // only here are the places of the tiles of a pyramid written
    return {bytes_.begin(), bytes_.end()};
  }

 private:
  void check(bool done) const {
    if (!done) throw InputError(fmt::format("cannot write {}: {}", format_, out_->geterror()));
  }

  std::string format_;
  std::vector<unsigned char> bytes_;
  OIIO::Filesystem::IOVecOutput memory_;
  std::unique_ptr<OIIO::ImageOutput> out_;
};

}  // namespace

std::string encode(const std::string& format, const OIIO::ImageSpec& spec, const void* pixels) {
  Encoder encoder(format);
  encoder.add(spec, pixels, true);
  return encoder.finish();
}

std::string encode_exr_levels(int levels, const std::function<EncodedLevel(int)>& level_of) {
  Encoder encoder("openexr");
  for (int i = 0; i < levels; ++i) {
    const EncodedLevel level = level_of(i);
    encoder.add(level.spec, level.pixels, i == 0);
  }
  return encoder.finish();
}

}  // namespace lightproof
