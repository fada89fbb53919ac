#include "lightproof/image/image_file.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/image/image_file_checks.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

constexpr double kDecodeExponent = 2.2;
constexpr std::size_t kLongestReason = 300;

/// The first line of what a library reported, for a message of one line.
std::string first_line(std::string text) {
  text.resize(std::min(text.find_first_of("\r\n"), std::min(text.size(), kLongestReason)));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return text.empty() ? "no reason given" : text;
}

/// Runs `work` and turns whatever a decoder throws into an InputError.
template <class Work>
auto guarded(const fs::path& file, const Work& work) {
  try {
    return work();
  } catch (const InputError&) {
    throw;
  } catch (const Interrupted&) {
    throw;
  } catch (const std::bad_alloc&) {
    refuse(file, "cannot be read: not enough memory for what the header asks");
  } catch (const std::exception& error) {
    refuse(file, "cannot be read: " + first_line(error.what()));
  } catch (...) {
    refuse(file, "cannot be read: unknown error");
  }
}

/// Undoes the flips of an Exif orientation from 2 to 4.
Grid<Rgb> oriented(const Grid<Rgb>& stored, int orientation) {
  const bool mirrored = orientation == 2 || orientation == 3;
  const bool upside_down = orientation == 3 || orientation == 4;
  Grid<Rgb> shown(stored.extent());
  for (int y = 0; y < stored.extent().height; ++y) {
    const auto to = shown.row(upside_down ? stored.extent().height - 1 - y : y);
    std::ranges::copy(stored.row(y), to.begin());
    if (mirrored) std::ranges::reverse(to);
  }
  return shown;
}

/// Replaces the fractions i / levels by (i / levels)^2.2.
void decode_gamma(Grid<Rgb>& picture, int levels) {
  std::vector<float> decoded;
  for (int i = 0; i <= levels; ++i) {
    decoded.push_back(static_cast<float>(std::pow(double{1.0} * i / levels, kDecodeExponent)));
  }
  const auto decode = [&](float v) {
    return decoded[static_cast<std::size_t>(std::lround(v * static_cast<float>(levels)))];
  };
  parallel_for(static_cast<std::size_t>(picture.extent().height), [&](std::size_t y) {
    for (Rgb& rgb : picture.row(static_cast<int>(y))) {
      rgb = {decode(rgb.r), decode(rgb.g), decode(rgb.b)};
    }
  });
}

/// Greatest value of an integer format; 0 for a floating-point one, which is linear already.
int integer_levels(const OIIO::ImageSpec& spec) {
  if (spec.format == OIIO::TypeDesc::UINT8) return 255;
  if (spec.format == OIIO::TypeDesc::UINT16) return 65535;
  return 0;
}

}  // namespace

struct ImageFile::State {
  fs::path path;
  std::string_view format;
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;
  std::array<int, 3> rgb;
  int orientation = 1;
  std::vector<std::string> notes;

  [[noreturn]] void refuse_decoding() const {
    const std::string error = input ? input->geterror() : OIIO::geterror();
    refuse(path, fmt::format("cannot be read as {}: {}", format, first_line(error)));
  }

  void open(const FileFormat& found) {
    format = found.name;
    // The newer reader aborts on damaged files and cannot decode DWAA and DWAB.
    OIIO::attribute("openexr:core", 0);
    input = OIIO::ImageInput::create(found.plugin);
    if (!input) refuse_decoding();
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);
    if (!input->open(path.string(), spec, hints)) refuse_decoding();
  }

  void inspect() {
    check_header(path, spec);
    rgb = rgb_channels(path, spec);
    orientation = spec.get_int_attribute("Orientation", 1);
    notes = header_notes(spec, rgb);
    if (const int levels = integer_levels(spec); levels != 0) {
      notes.push_back(fmt::format("The {}-bit values were decoded by ^{}.", levels == 255 ? 8 : 16,
                                  kDecodeExponent));
    }
    if (orientation > 1) {
      notes.push_back(fmt::format("The orientation {} of the header was applied.", orientation));
    }
  }

  /// Channels [first, last) into consecutive floats of each texel, from its `slot` on.
  void read_channels(Grid<Rgb>& picture, int first, int last, int slot) {
    float* const to = &picture.values().front()[slot];
    if (!input->read_image(0, 0, first, last, OIIO::TypeDesc::FLOAT, to, sizeof(Rgb))) {
      refuse_decoding();
    }
  }

  Grid<Rgb> read_stored() {
    Grid<Rgb> picture({spec.width, spec.height});
    if (rgb[1] == rgb[0] + 1 && rgb[2] == rgb[0] + 2) {
      read_channels(picture, rgb[0], rgb[0] + 3, 0);
    } else {
      for (int i = 0; i < 3; ++i) read_channels(picture, rgb[i], rgb[i] + 1, i);
    }
    return picture;
  }
};

void refuse(const fs::path& file, std::string_view reason) {
  throw InputError(fmt::format("{}: {}", file.string(), reason));
}

ImageFile::ImageFile(const fs::path& path) : state_(std::make_unique<State>()) {
  state_->path = path;
  guarded(path, [&] {
    state_->open(recognise_file(path));
    state_->inspect();
  });
}

ImageFile::~ImageFile() = default;

Extent ImageFile::extent() const { return {state_->spec.width, state_->spec.height}; }

bool ImageFile::says_lat_long() const {
  return state_->spec.get_string_attribute("textureformat") == "LatLong Environment";
}

const std::vector<std::string>& ImageFile::notes() const { return state_->notes; }

Grid<Rgb> ImageFile::read_pixels() {
  return guarded(state_->path, [&] {
    Grid<Rgb> picture = state_->read_stored();
    if (const int levels = integer_levels(state_->spec); levels != 0) decode_gamma(picture, levels);
    return state_->orientation <= 1 ? std::move(picture) : oriented(picture, state_->orientation);
  });
}

}  // namespace lightproof
