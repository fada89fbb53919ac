#include "lightproof/image/channels.h"

#include <fmt/format.h>

#include <algorithm>

#include "lightproof/image/file_format.h"

namespace lightproof {
namespace {

bool has_all(const PictureHeader& header, const std::vector<std::string>& names) {
  return std::ranges::all_of(names, [&](const std::string& name) {
    return std::ranges::count(header.channels, name) > 0;
  });
}

/// What would help someone who gave no selection; empty if nothing would.
std::string advice(const PictureHeader& header, const ChannelSelection& selection) {
  if (!selection.channels.empty()) return "";
  if (holds_luminance_chroma(header, selection)) {
    return ": --to-rgb converts luminance and chroma to RGB, --channels Y reads luminance as grey";
  }
  if (header.channels.size() == 1) {
    return fmt::format(": --channels {} reads it as grey", header.channels.front());
  }
  for (const std::string& layer : header.layers) {
    if (has_all(header, ChannelSelection{.layer = layer}.names()))
      return fmt::format(": --layer {} reads such channels of that layer", layer);
  }
  return ": --channels NAME reads one as grey, --channels NAME,NAME,NAME three";
}

}  // namespace

int chosen_part(const std::filesystem::path& file, std::size_t parts,
                const ChannelSelection& selection) {
  const int part = selection.part.value_or(0);
  if (part >= 0 && static_cast<std::size_t>(part) < parts) return part;
  refuse(file, parts == 1 ? fmt::format("has no part {}: it has one part, 0", part)
                          : fmt::format("has no part {}: its parts are 0 to {}", part, parts - 1));
}

bool holds_luminance_chroma(const PictureHeader& header, const ChannelSelection& selection) {
  return selection.channels.empty() && selection.layer.empty() &&
         has_all(header, kLuminanceChroma) && !has_all(header, selection.names());
}

std::vector<std::string> chosen_channels(const std::filesystem::path& file,
                                         const PictureHeader& header,
                                         const ChannelSelection& selection) {
  std::vector<std::string> names = selection.names();
  if (has_all(header, names)) return names;
  const std::string needed =
      names.size() == 1 ? fmt::format("channel {}", names[0])
                        : fmt::format("channels {}, {} and {}", names[0], names[1], names[2]);
  refuse(file, fmt::format(
                   "{} needed, found {}{}{}", needed, listed(header.channels),
                   header.parts.size() > 1
                       ? fmt::format(" in part {} of 0 to {}", header.part, header.parts.size() - 1)
                       : "",
                   advice(header, selection)));
}

}  // namespace lightproof
