#include "lightproof/precompute/chain_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lightproof/core/error.h"
#include "lightproof/core/random.h"
#include "lightproof/image/lat_long_texels.h"
#include "lightproof/image/level_look_up.h"
#include "lightproof/precompute/levels.h"
#include "lightproof/prefilter/irradiance_map.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// At which errors are looked up: enough for a root mean square that is known to 3 %, if the
/// differences are normal.
constexpr std::size_t kDirections = 512;
constexpr int kMostLevels = 12;

std::vector<Direction> random_directions(std::uint64_t seed) {
  const RandomStream stream("chain choice", seed);
  std::vector<Direction> directions;
  for (std::size_t i = 0; i < kDirections; ++i) {
    const SquarePoint u = stream.point(i);
    const double z = 1.0 - 2.0 * u.t;
    const double sine = std::sqrt(std::max(0.0, 1.0 - z * z));
    directions.push_back({sine * std::cos(2.0 * kPi * u.s), sine * std::sin(2.0 * kPi * u.s), z});
  }
  return directions;
}

/// The root mean square of differences, relative to the mean of the map's radiance in each channel;
/// the largest of the three counts.
class Distance {
 public:
  explicit Distance(const Grid<Rgb>& map) : mean_(0.0) {
    for (int y = 0; y < map.extent().height; ++y) {
      for (const Rgb& texel : map.row(y)) {
        mean_ += texel_solid_angle(map.extent(), y) / (4.0 * kPi) * glm::dvec3(texel);
      }
    }
  }
  double operator()(std::span<const glm::dvec3> values, std::span<const Rgb> exact) const {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const glm::dvec3 difference = values[i] - glm::dvec3(exact[i]);
      sum += difference * difference;
    }
    double worst = 0.0;
    for (int channel = 0; channel < 3; ++channel) {
      if (mean_[channel] <= 0.0) continue;
      const double mean_square = sum[channel] / static_cast<double>(values.size());
      worst = std::max(worst, std::sqrt(mean_square) / mean_[channel]);
    }
    return worst;
  }

 private:
  glm::dvec3 mean_;
};

class Chooser {
 public:
  Chooser(const EnvironmentMap& map, const PrecomputeRequest& request, Product product,
          std::uint64_t seed)
      : map_(map),
        request_(request),
        product_(product),
        directions_(random_directions(seed)),
        distance_(map.radiance) {}

  ChainChoice choose(double largest_error) const {
    ChainChoice choice{};
    for (int levels = product_ == Product::irradiance ? 1 : 2;; ++levels) {
      choice.levels = levels;
      choice.roughness_error = between_levels(levels);
      if (choice.roughness_error <= largest_error) break;
      if (levels == kMostLevels || product_ == Product::irradiance) refuse(largest_error, choice);
    }
    for (int height = 4;; height *= 2) {
      choice.extent = is_cube(request_.projection) ? Extent{height / 2, height / 2}
                                                   : Extent{2 * height, height};
      if (most_levels(choice.extent) < choice.levels) continue;
      choice.look_up_error = in_levels(choice);
      if (choice.look_up_error <= largest_error) return choice;
      if (height >= std::max(map_.radiance.extent().height, kLeastLargest)) {
        refuse(largest_error, choice);
      }
    }
  }

 private:
  /// The largest height that is tried, of small environments.
  static constexpr int kLeastLargest = 256;

  std::vector<LevelPlan> plans(Extent extent, int levels) const {
    return plan_levels({product_, extent, levels}, request_.projection);
  }

  std::vector<Rgb> exact(const std::optional<Lobe>& lobe) const {
    return prefilter(map_.radiance, lobe, directions_);
  }

  double between_levels(int levels) const {
    if (levels < 2) return 0.0;
    // Any size will do that has so many levels.
    const std::vector<LevelPlan> all = plans({1 << levels, 1 << levels}, levels);
    double worst = 0.0;
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
      if (!all[i].lobe) continue;
      const double middle = 0.5 * (*all[i].roughness + *all[i + 1].roughness);
      const std::vector<Rgb> finer = exact(all[i].lobe);
      const std::vector<Rgb> coarser = exact(all[i + 1].lobe);
      std::vector<glm::dvec3> mixed;
      for (std::size_t k = 0; k < finer.size(); ++k) {
        mixed.push_back(0.5 * (glm::dvec3(finer[k]) + glm::dvec3(coarser[k])));
      }
      worst = std::max(worst, distance_(mixed, exact(lobe_of(product_, middle))));
    }
    return worst;
  }

  double in_levels(const ChainChoice& choice) const {
    const std::vector<LevelPlan> all = plans(choice.extent, choice.levels);
    double worst = 0.0;
    const MapLevels made = {request_.projection, make_levels(map_, request_, all)};
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!all[i].lobe) continue;
      std::vector<glm::dvec3> values;
      for (const Direction& direction : directions_) {
        values.emplace_back(look_up_bilinear(made, static_cast<int>(i), direction));
      }
      worst = std::max(worst, distance_(values, exact(all[i].lobe)));
    }
    return worst;
  }

  [[noreturn]] void refuse(double largest_error, const ChainChoice& choice) const {
    const double reached = std::max(choice.roughness_error, choice.look_up_error);
    throw InputError(fmt::format(
        "{}: no {} map reaches an error of {:.3g}: {} still err by {:.3g}. Ask for --max-error "
        "{:.2g} or more, or give --size and --levels",
        map_.name, name_of(product_), largest_error,
        choice.extent.width == 0 ? fmt::format("{} levels", choice.levels)
                                 : fmt::format("{} levels from {}x{} down", choice.levels,
                                               choice.extent.width, choice.extent.height),
        reached, 1.05 * reached));
  }

  const EnvironmentMap& map_;
  const PrecomputeRequest& request_;
  Product product_;
  std::vector<Direction> directions_;
  Distance distance_;
};

}  // namespace

ChainChoice choose_chain(const EnvironmentMap& map, const PrecomputeRequest& request,
                         Product product, double largest_error, std::uint64_t seed) {
  require_lat_long(map, "a map for real-time rendering");
  return Chooser(map, request, product, seed).choose(largest_error);
}

}  // namespace lightproof
