#include "lightproof/image/stored_pixels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <span>
#include <string>
#include <vector>

#include "lightproof/core/parallel.h"
#include "lightproof/image/stored_picture_checks.h"

namespace lightproof {
namespace {

/// Samples of a few lines, which are received together where they need to be rearranged.
constexpr std::size_t kBlockFloats = std::size_t{1} << 18U;

/// Takes lines of samples in the order in which they are stored.
class Lines {
 public:
  Lines(const StoredPicture& stored, int channels)
      : data_(stored.data),
        display_(stored.display),
        order_(order_of(stored)),
        channels_(static_cast<std::size_t>(channels)),
        count_(order_.columns ? data_.width : data_.height),
        // Not touched before it is decoded: a damaged header costs address space, no memory.
        picture_(Grid<Rgb>::without_values(extent())) {}

  std::int64_t count() const { return count_; }
  std::size_t floats_of_line() const {
    return channels_ * static_cast<std::size_t>(order_.columns ? data_.height : data_.width);
  }

  /// Where lines of three channels can be received as they are: from line `first` on.
  std::span<Rgb> in_place(std::int64_t first, std::int64_t lines) {
    const bool is_plain = channels_ == 3 && order_ == StoredOrder() && data_ == display_;
    if (!is_plain) return {};
    const auto width = static_cast<std::size_t>(data_.width);
    return picture_.values().subspan(static_cast<std::size_t>(first) * width,
                                     static_cast<std::size_t>(lines) * width);
  }

  void put(std::int64_t line, std::span<const float> samples) {
    const std::int64_t pixels = order_.columns ? data_.height : data_.width;
    const std::int64_t slow = order_.lines_backwards ? count_ - 1 - line : line;
    for (std::int64_t i = 0; i < pixels; ++i) {
      const std::int64_t fast = order_.pixels_backwards ? pixels - 1 - i : i;
      const std::int64_t x = (order_.columns ? slow : fast) + data_.x - display_.x;
      const std::int64_t y = (order_.columns ? fast : slow) + data_.y - display_.y;
      if (x < 0 || y < 0 || x >= display_.width || y >= display_.height) continue;
      const float* at = &samples[static_cast<std::size_t>(i) * channels_];
      picture_(static_cast<int>(x), static_cast<int>(y)) =
          channels_ == 1 ? Rgb(at[0]) : Rgb(at[0], at[1], at[2]);
    }
  }

  /// The picture, in which what was not stored is black.
  Grid<Rgb> take() {
    const std::int64_t left = std::clamp<std::int64_t>(data_.x - display_.x, 0, display_.width);
    const std::int64_t right =
        std::clamp<std::int64_t>(data_.x + data_.width - display_.x, 0, display_.width);
    for (int y = 0; y < picture_.extent().height; ++y) {
      const std::span<Rgb> row = picture_.row(y);
      const std::int64_t stored = y - (data_.y - display_.y);
      if (stored < 0 || stored >= data_.height) {
        std::ranges::fill(row, Rgb(0.0F));
      } else {
        std::ranges::fill(row.first(static_cast<std::size_t>(left)), Rgb(0.0F));
        std::ranges::fill(row.subspan(static_cast<std::size_t>(right)), Rgb(0.0F));
      }
    }
    return std::move(picture_);
  }

 private:
  Extent extent() const {
    return {static_cast<int>(display_.width), static_cast<int>(display_.height)};
  }

  PixelWindow data_;
  PixelWindow display_;
  StoredOrder order_;
  std::size_t channels_;
  std::int64_t count_;
  Grid<Rgb> picture_;
};

void receive_rearranged(Decoder& decoder, Lines& lines, std::int64_t first, std::int64_t count) {
  const std::size_t of_line = lines.floats_of_line();
  const auto at_once = static_cast<std::int64_t>(std::max<std::size_t>(1, kBlockFloats / of_line));
  std::vector<float> block;
  for (std::int64_t done = 0; done < count;) {
    const std::int64_t now = std::min(at_once, count - done);
    block.resize(static_cast<std::size_t>(now) * of_line);
    decoder.receive(std::as_writable_bytes(std::span(block)));
    for (std::int64_t i = 0; i < now; ++i) {
      lines.put(first + done + i,
                std::span(block).subspan(static_cast<std::size_t>(i) * of_line, of_line));
    }
    done += now;
  }
}

Grid<Rgb> receive_lines(Decoder& decoder, const StoredPicture& stored, int channels) {
  Lines lines(stored, channels);
  const std::uint64_t bytes_of_line = lines.floats_of_line() * sizeof(float);
  for (std::int64_t done = 0; done < lines.count();) {
    decoder.now_at(fmt::format("at {} {} of {}", order_of(stored).columns ? "column" : "row", done,
                               lines.count()));
    const MessageHead head = decoder.next();
    const std::uint64_t left = static_cast<std::uint64_t>(lines.count() - done);
    if (head.kind != MessageKind::rows || head.bytes == 0 || head.bytes % bytes_of_line != 0 ||
        head.bytes / bytes_of_line > left) {
      decoder.fail_nonsense();
    }
    const auto count = static_cast<std::int64_t>(head.bytes / bytes_of_line);
    if (const std::span<Rgb> target = lines.in_place(done, count); !target.empty()) {
      decoder.receive(std::as_writable_bytes(target));
    } else {
      receive_rearranged(decoder, lines, done, count);
    }
    done += count;
  }
  decoder.now_at("behind the last row");
  return lines.take();
}

/// Replaces the numbers i from 0 to levels by (i / levels)^exponent. False if there are others.
bool decode_integers(Grid<Rgb>& picture, int levels, double exponent) {
  std::vector<float> decoded;
  for (int i = 0; i <= levels; ++i) {
    decoded.push_back(static_cast<float>(std::pow(double{1.0} * i / levels, exponent)));
  }
  std::vector<char> is_good(static_cast<std::size_t>(picture.extent().height), 1);
  parallel_for(is_good.size(), [&](std::size_t y) {
    for (Rgb& rgb : picture.row(static_cast<int>(y))) {
      for (int i = 0; i < 3; ++i) {
        const bool fits = rgb[i] >= 0.0F && rgb[i] <= static_cast<float>(levels);
        if (!fits) is_good[y] = 0;
        rgb[i] = fits ? decoded[static_cast<std::size_t>(rgb[i])] : 0.0F;
      }
    }
  });
  return std::ranges::count(is_good, 0) == 0;
}

void convert_from_xyz(Grid<Rgb>& picture, const std::optional<Chromaticities>& space) {
  glm::dmat3 to_rgb = glm::inverse(xyz_of_rgb(kRec709Space));
  // (1, 1, 1) is what the file says of white; without a word the values are X, Y and Z themselves.
  if (space && is_colour_space(*space)) to_rgb = to_rgb * xyz_of_rgb(*space);
  parallel_for(static_cast<std::size_t>(picture.extent().height), [&](std::size_t y) {
    for (Rgb& rgb : picture.row(static_cast<int>(y))) rgb = Rgb(to_rgb * glm::dvec3(rgb));
  });
}

}  // namespace

StoredOrder order_of(const StoredPicture& stored) {
  StoredOrder order = stored.order;
  const int exif = stored.exif_orientation;
  if (exif == 2 || exif == 3) order.pixels_backwards = true;
  if (exif == 3 || exif == 4) order.lines_backwards = true;
  return order;
}

Grid<Rgb> receive_pixels(Decoder& decoder, const StoredPicture& stored, int channels) {
  Grid<Rgb> picture = receive_lines(decoder, stored, channels);
  if (const int levels = integer_levels(stored); levels != 0) {
    if (!decode_integers(picture, levels, decode_exponent(stored))) decoder.fail_nonsense();
  }
  if (stored.holds_xyz) convert_from_xyz(picture, stored.chromaticities);
  return picture;
}

}  // namespace lightproof
