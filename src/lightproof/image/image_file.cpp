#include "lightproof/image/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <span>

#include "lightproof/core/out_of_memory.h"
#include "lightproof/image/channels.h"
#include "lightproof/image/decoder.h"
#include "lightproof/image/file_format.h"
#include "lightproof/image/stored_picture_checks.h"
#include "lightproof/image/stored_pixels.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

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
bool has_other_profile(const StoredPicture& stored) {
  return !stored.profile.empty() && stored.profile.find("sRGB") == std::string::npos;
}

std::string window_note(const StoredPicture& stored) {
  return fmt::format(
      "The data window ({} x {}) was brought to the display window ({} x {}): what "
      "it has not is black, what it has beyond was left out.",
      stored.data.width, stored.data.height, stored.display.width, stored.display.height);
}

void add_notes_on_values(std::vector<std::string>& notes, const StoredPicture& stored,
                         bool from_luminance_chroma) {
  if (from_luminance_chroma) {
    notes.emplace_back("Luminance and chroma were converted to RGB.");
  }
  if (stored.holds_xyz) {
    notes.emplace_back("CIE XYZ values were converted to linear RGB of Rec. 709.");
  }
  if (const int levels = integer_levels(stored); levels != 0) {
    notes.push_back(fmt::format("The {}-bit values were decoded by ^{}.", levels == 255 ? 8 : 16,
                                decode_exponent(stored)));
  }
  if (has_other_profile(stored)) {
    notes.push_back(fmt::format("The colour profile in the header ({}) was ignored.",
                                first_line(stored.profile)));
  }
}

std::vector<std::string> notes_of(const PictureHeader& header, const ChannelSelection& selection,
                                  const StoredPicture& stored, bool from_luminance_chroma) {
  std::vector<std::string> notes;
  if (header.parts.size() > 1) notes.push_back(part_note(header, selection));
  if (const auto others = header.left_out(); !others.empty()) {
    notes.push_back(fmt::format("Channels left out: {}.", listed(others)));
  }
  if (header.read.size() == 1) {
    notes.push_back(fmt::format("Channel {} was read as grey.", header.read[0]));
  }
  if (!(stored.data == stored.display)) notes.push_back(window_note(stored));
  add_notes_on_values(notes, stored, from_luminance_chroma);
  if (integer_levels(stored) == 0 && stored.pixel_aspect != 1.0) {
    notes.push_back(
        fmt::format("pixelAspectRatio={:.6g} in the header was ignored: the shape of "
                    "pixels follows from the mapping of the whole sphere.",
                    stored.pixel_aspect));
  }
  for (const std::string& note : stored.notes) notes.push_back(first_line(note));
  if (!header.orientation.empty()) {
    notes.push_back(
        fmt::format("The orientation {} of the header was applied.", header.orientation));
  }
  return notes;
}

/// The lack of memory for a picture whose header has been checked is the machine's.
template <class Work>
auto with_memory_for_picture(const fs::path& file, const Work& work) {
  return with_memory_for([&] { return "the picture " + file.string(); }, work);
}

}  // namespace

struct ImageFile::State {
  State(const fs::path& file, const ChannelSelection& chosen, const Allowances& allowed)
      : path(file),
        open(file),
        format(recognise_file(file, open)),
        decoder(file.string(), fmt::format("cannot be read as {}", format.name),
                open.descriptor()) {
    decoder.now_at("in the header");
    decoder.send(MessageKind::open, OpenRequest{.version = LIGHTPROOF_VERSION,
                                                .format = format.format,
                                                .part = chosen.part.value_or(0)});
    stored = decoder.value_of<StoredPicture>(decoder.next(), MessageKind::picture);
    if (!is_possible(stored)) decoder.fail_nonsense();
    inspect(chosen, allowed);
  }

  void inspect(const ChannelSelection& selection, const Allowances& allow) {
    check_header(path, stored, allow);
    header.format = format.name;
    header.extent = {static_cast<int>(stored.display.width),
                     static_cast<int>(stored.display.height)};
    header.parts = stored.parts;
    header.part = chosen_part(path, stored.parts.size(), selection);
    for (const StoredChannel& channel : stored.channels) header.channels.push_back(channel.name);
    header.layers = layers_of(header.channels);
    choose_channels(selection, allow);
    check_file_length(path, open.size(), stored);
    header.orientation = stored.order_text;
    if (stored.exif_orientation > 1) header.orientation = std::to_string(stored.exif_orientation);
    header.says_lat_long = stored.is_lat_long;
    header.chromaticities = chromaticities();
    header.exposure = stored.exposure;
    header.notes = notes_of(header, selection, stored, request.from_luminance_chroma);
  }

  void choose_channels(const ChannelSelection& selection, const Allowances& allow) {
    if (allow.to_rgb && holds_luminance_chroma(header, selection)) {
      request.from_luminance_chroma = true;
      header.read = kLuminanceChroma;
      return;
    }
    header.read = chosen_channels(path, header, selection);
    request.channels = header.read;
    check_channels(path, stored, header.read);
  }

  std::optional<Chromaticities> chromaticities() const {
    if (stored.holds_xyz) return kRec709Space;
    if (!stored.chromaticities || !is_colour_space(*stored.chromaticities)) return std::nullopt;
    return stored.chromaticities;
  }

  Grid<Rgb> read_pixels() {
    decoder.now_at("before the first row");
    decoder.send(MessageKind::read, request);
    const int channels = request.channels.size() == 1 ? 1 : 3;
    Grid<Rgb> picture = receive_pixels(decoder, stored, channels);
    const auto notes =
        decoder.value_of<std::vector<std::string>>(decoder.next(), MessageKind::done);
    for (const std::string& note : notes) header.notes.push_back(first_line(note));
    return picture;
  }

  fs::path path;
  OpenFile open;
  const FileFormat& format;
  Decoder decoder;
  StoredPicture stored = {};
  PictureHeader header = {};
  ReadRequest request = {};
};

ImageFile::ImageFile(const fs::path& path, const ChannelSelection& selection,
                     const Allowances& allow)
    : state_(with_memory_for_picture(
          path, [&] { return std::make_unique<State>(path, selection, allow); })) {}

ImageFile::~ImageFile() = default;

const PictureHeader& ImageFile::header() const { return state_->header; }

Grid<Rgb> ImageFile::read_pixels() {
  return with_memory_for_picture(state_->path, [&] { return state_->read_pixels(); });
}

}  // namespace lightproof
