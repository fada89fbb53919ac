#include "lightproof/image/image_file.h"

#include <new>
#include <optional>

#include "lightproof/core/error.h"
#include "lightproof/core/out_of_memory.h"
#include "lightproof/image/file_format.h"
#include "lightproof/image/open_image_io_file.h"
#include "lightproof/image/radiance_file.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

/// Runs `work` and turns whatever a decoder throws into an InputError. Headers that ask for more
/// than their files can hold are refused before, so that lack of memory is the machine's.
template <class Work>
auto guarded(const fs::path& file, const Work& work) {
  try {
    return work();
  } catch (const InputError&) {
    throw;
  } catch (const Interrupted&) {
    throw;
  } catch (const std::bad_alloc& error) {
    throw out_of_memory("the picture " + file.string(), error);
  } catch (const std::exception& error) {
    refuse(file, "cannot be read: " + first_line(error.what()));
  } catch (...) {
    refuse(file, "cannot be read: unknown error");
  }
}

}  // namespace

/// One of the two.
struct ImageFile::State {
  fs::path path;
  std::optional<RadianceFile> radiance = {};
  std::optional<OpenImageIoFile> other = {};
};

ImageFile::ImageFile(const fs::path& path, const ChannelSelection& selection)
    : state_(std::make_unique<State>()) {
  state_->path = path;
  guarded(path, [&] {
    const FileFormat& format = recognise_file(path);
    if (format.name == kRadianceFormat) {
      state_->radiance.emplace(path, selection);
    } else {
      state_->other.emplace(path, format, selection);
    }
  });
}

ImageFile::~ImageFile() = default;

const PictureHeader& ImageFile::header() const {
  return state_->radiance ? state_->radiance->header() : state_->other->header();
}

Grid<Rgb> ImageFile::read_pixels() {
  return guarded(state_->path, [&] {
    return state_->radiance ? state_->radiance->read_pixels() : state_->other->read_pixels();
  });
}

}  // namespace lightproof
