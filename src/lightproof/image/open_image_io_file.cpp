#include "lightproof/image/open_image_io_file.h"

#include <algorithm>
#include <cmath>

#include "lightproof/core/parallel.h"
#include "lightproof/image/channels.h"
#include "lightproof/image/open_image_io_checks.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

constexpr double kDecodeExponent = 2.2;
constexpr std::size_t kLongestReason = 300;
constexpr int kMostParts = 1024;

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

/// Replaces the fractions i / levels by (i / levels)^exponent.
void decode_gamma(Grid<Rgb>& picture, int levels, double exponent) {
  std::vector<float> decoded;
  for (int i = 0; i <= levels; ++i) {
    decoded.push_back(static_cast<float>(std::pow(double{1.0} * i / levels, exponent)));
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

/// What the values of an integer format are raised to: 2.2 unless the file names another gamma.
double decode_exponent(const OIIO::ImageSpec& spec) {
  if (spec.get_string_attribute("oiio:ColorSpace") == "Linear") return 1.0;
  // A float that OpenImageIO rounded to hundredths: 2.2F is not 2.2.
  const double gamma =
      std::round(100.0 * static_cast<double>(spec.get_float_attribute("oiio:Gamma"))) / 100.0;
  return std::isfinite(gamma) && gamma > 0.0 ? gamma : kDecodeExponent;
}

std::string part_note(const PictureHeader& header, const ChannelSelection& selection) {
  const std::size_t parts = header.parts.size();
  if (!selection.part) {
    return fmt::format("The first of {} parts was read: --part 1 reads the second.", parts);
  }
  return fmt::format("Part {} of 0 to {} was read{}.", header.part, parts - 1,
                     header.parts[static_cast<std::size_t>(header.part)].empty()
                         ? ""
                         : " (" + header.parts[static_cast<std::size_t>(header.part)] + ")");
}

/// Colour profiles are taken for that of sRGB, of which most are.
bool has_other_profile(const OIIO::ImageSpec& spec) {
  if (spec.find_attribute("ICCProfile") == nullptr) return false;
  const std::string name = spec.get_string_attribute("ICCProfile:profile_description");
  return name.find("sRGB") == std::string::npos;
}

std::vector<std::string> notes_of(const PictureHeader& header, const ChannelSelection& selection,
                                  const OIIO::ImageSpec& spec) {
  std::vector<std::string> notes;
  if (header.parts.size() > 1) notes.push_back(part_note(header, selection));
  if (const auto others = header.left_out(); !others.empty()) {
    notes.push_back(fmt::format("Channels left out: {}.", listed(others)));
  }
  if (header.read.size() == 1) {
    notes.push_back(fmt::format("Channel {} was read as grey.", header.read[0]));
  }
  if (const int levels = integer_levels(spec); levels != 0) {
    notes.push_back(fmt::format("The {}-bit values were decoded by ^{}.", levels == 255 ? 8 : 16,
                                decode_exponent(spec)));
  } else if (spec.get_float_attribute("oiio:Gamma", 1.0F) != 1.0F) {
    notes.emplace_back("The gamma in the header was not undone: the values are taken as linear.");
  }
  if (has_other_profile(spec)) {
    notes.push_back(fmt::format(
        "The colour profile in the header ({}) was ignored.",
        first_line(spec.get_string_attribute("ICCProfile:profile_description", "without a name"))));
  }
  const float aspect = spec.get_float_attribute("PixelAspectRatio", 1.0F);
  if (spec.format.is_floating_point() && aspect != 1.0F) {
    notes.push_back(
        fmt::format("pixelAspectRatio={:.6g} in the header was ignored: the shape of "
                    "pixels follows from the mapping of the whole sphere.",
                    aspect));
  }
  if (!header.orientation.empty()) {
    notes.push_back(
        fmt::format("The orientation {} of the header was applied.", header.orientation));
  }
  return notes;
}

}  // namespace

struct OpenImageIoFile::State {
  fs::path path;
  std::string_view format;
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;
  std::vector<int> channels;
  int orientation = 1;
  PictureHeader header;

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

  /// Leaves the input at the chosen part.
  void choose_part(const ChannelSelection& selection) {
    const int parts = std::clamp(spec.get_int_attribute("oiio:subimages", 1), 1, kMostParts);
    header.part = chosen_part(path, static_cast<std::size_t>(parts), selection);
    header.parts.resize(static_cast<std::size_t>(parts));
    if (parts == 1) return;
    for (int part = 0; part < parts; ++part) {
      if (!input->seek_subimage(part, 0)) refuse_decoding();
      header.parts[static_cast<std::size_t>(part)] =
          input->spec().get_string_attribute("oiio:subimagename");
    }
    if (!input->seek_subimage(header.part, 0)) refuse_decoding();
    spec = input->spec();
  }

  void inspect(const ChannelSelection& selection) {
    check_header(path, spec);
    header.format = format;
    header.extent = {spec.width, spec.height};
    header.channels = spec.channelnames;
    header.layers = layers_of(header.channels);
    header.read = chosen_channels(path, header, selection);
    channels = channel_indices(path, spec, header.read);
    check_file_length(path, spec);
    orientation = spec.get_int_attribute("Orientation", 1);
    if (orientation > 1) header.orientation = std::to_string(orientation);
    header.says_lat_long = spec.get_string_attribute("textureformat") == "LatLong Environment";
    header.chromaticities = chromaticities_of(spec);
    header.notes = notes_of(header, selection, spec);
  }

  /// Channels [first, last) into consecutive floats of each texel, from its `slot` on.
  void read_channels(Grid<Rgb>& picture, int first, int last, int slot) {
    float* const to = &picture.values().front()[slot];
    if (!input->read_image(header.part, 0, first, last, OIIO::TypeDesc::FLOAT, to, sizeof(Rgb))) {
      refuse_decoding();
    }
  }

  Grid<Rgb> read_stored() {
    // Not touched before it is decoded: a damaged header costs address space, no memory.
    Grid<Rgb> picture = Grid<Rgb>::without_values({spec.width, spec.height});
    const bool is_grey = channels.size() == 1;
    if (!is_grey && channels[1] == channels[0] + 1 && channels[2] == channels[0] + 2) {
      read_channels(picture, channels[0], channels[0] + 3, 0);
      return picture;
    }
    for (int i = 0; i < static_cast<int>(channels.size()); ++i) {
      const int channel = channels[static_cast<std::size_t>(i)];
      read_channels(picture, channel, channel + 1, i);
    }
    if (is_grey) {
      for (Rgb& rgb : picture.values()) rgb = Rgb(rgb.r);
    }
    return picture;
  }
};

std::string first_line(std::string text) {
  text.resize(std::min(text.find_first_of("\r\n"), std::min(text.size(), kLongestReason)));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return text.empty() ? "no reason given" : text;
}

OpenImageIoFile::OpenImageIoFile(const fs::path& file, const FileFormat& format,
                                 const ChannelSelection& selection)
    : state_(std::make_unique<State>()) {
  state_->path = file;
  state_->open(format);
  state_->choose_part(selection);
  state_->inspect(selection);
}

OpenImageIoFile::~OpenImageIoFile() = default;

const PictureHeader& OpenImageIoFile::header() const { return state_->header; }

Grid<Rgb> OpenImageIoFile::read_pixels() {
  Grid<Rgb> picture = state_->read_stored();
  if (const int levels = integer_levels(state_->spec); levels != 0) {
    const double exponent = decode_exponent(state_->spec);
    if (exponent != 1.0) decode_gamma(picture, levels, exponent);
  }
  return state_->orientation <= 1 ? std::move(picture) : oriented(picture, state_->orientation);
}

}  // namespace lightproof
