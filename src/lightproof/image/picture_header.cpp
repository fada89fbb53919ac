#include "lightproof/image/picture_header.h"

#include <fmt/format.h>

#include <algorithm>

namespace lightproof {
namespace {

constexpr std::size_t kListedNames = 32;

}  // namespace

std::vector<std::string> ChannelSelection::names() const {
  std::vector<std::string> names = channels;
  if (names.empty()) names = {"R", "G", "B"};
  if (layer.empty()) return names;
  for (std::string& name : names) name.insert(0, layer + ".");
  return names;
}

std::vector<std::string> PictureHeader::left_out() const {
  std::vector<std::string> others;
  for (const std::string& channel : channels) {
    if (std::ranges::count(read, channel) == 0) others.push_back(channel);
  }
  return others;
}

std::string size_fault(std::int64_t width, std::int64_t height) {
  const auto [shorter, longer] = std::minmax(width, height);
  if (shorter >= 1 && longer <= kLargestPicture.width && shorter <= kLargestPicture.height) {
    return "";
  }
  return fmt::format("the header says {} x {} pixels: 1 x 1 to {} x {} are read", width, height,
                     kLargestPicture.width, kLargestPicture.height);
}

std::vector<std::string> layers_of(const std::vector<std::string>& channels) {
  std::vector<std::string> layers;
  for (const std::string& channel : channels) {
    const std::size_t point = channel.rfind('.');
    if (point == std::string::npos) continue;
    const std::string layer = channel.substr(0, point);
    if (std::ranges::count(layers, layer) == 0) layers.push_back(layer);
  }
  return layers;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i == kListedNames) return text + ", …";
    text += (i == 0 ? "" : ", ") + names[i];
  }
  return text;
}

}  // namespace lightproof
