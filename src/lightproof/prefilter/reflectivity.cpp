#include "lightproof/prefilter/reflectivity.h"

#include <fmt/format.h>

#include <cmath>

#include "lightproof/core/error.h"
#include "lightproof/core/parallel.h"
#include "lightproof/prefilter/lobe_samples.h"
#include "lightproof/prefilter/radiance_look_up.h"
#include "lightproof/warp/hemisphere.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

constexpr std::size_t kTexelsOfTask = 64;

Direction texel_centre(std::size_t texel, Extent extent) {
  const auto width = static_cast<std::size_t>(extent.width);
  const std::size_t row = texel / width;
  return direction_from_square({(static_cast<double>(texel % width) + 0.5) / extent.width,
                                (static_cast<double>(row) + 0.5) / extent.height});
}

/// What the map shows from around an axis.
glm::dvec3 radiance_from(const Grid<Rgb>& map, const Frame& frame, Direction local) {
  return glm::dvec3(look_up_nearest(map, approximate_square_from_direction(frame.to_world(local))));
}

}  // namespace

SpecularChain reflectivity_chain(const Grid<Rgb>& map, Extent extent, int levels,
                                 GeometryTerm geometry, const PrefilterSettings& settings) {
  const std::vector<Extent> extents = level_extents(extent, levels);
  std::vector<PrefilteredLevel> wanted;
  for (int level = 0; level < levels; ++level) {
    const double shininess = half_vector_shininess(reflectivity_roughness(level, levels));
    wanted.push_back(
        {HalfVectorLobe{shininess, geometry}, extents[static_cast<std::size_t>(level)]});
  }
  return prefilter(map, wanted, settings);
}

HalfVectorDraw draw_half_vector(double shininess, SquarePoint random) {
  const double half = half_vector_cosine(shininess, random.s);
  return {half, direction_around_z(2.0 * half * half - 1.0, random.t)};
}

double reflectivity_weight_published(double shininess, double half_cosine) {
  return 2.0 / kPi * reflectivity_weight(shininess, half_cosine);
}

double reflectivity_weight(double shininess, double half_cosine) {
  return (shininess + 2.0) / (shininess + 1.0) * half_cosine;
}

bool is_skipped_published(double shininess, double half_cosine) {
  constexpr double kLeastDensity = 1e-4;
  return (shininess + 1.0) * std::pow(half_cosine, shininess) < kLeastDensity;
}

ReflectivityAccumulation::ReflectivityAccumulation(const Grid<Rgb>& map, Extent extent,
                                                   double roughness, ReflectivityForm form,
                                                   const RandomStream& stream)
    : map_(&map),
      extent_(level_extents(extent, 1).front()),
      shininess_(half_vector_shininess(roughness)),
      form_(form),
      stream_(stream) {
  if (!(roughness > 0.0 && roughness <= 1.0)) {
    throw InputError(fmt::format(
        "a roughness of {}: more than 0, where the shininess is infinite, and at most 1 needed",
        roughness));
  }
  form == ReflectivityForm::published ? published_.resize(extent.count())
                                      : exact_.resize(extent.count());
}

void ReflectivityAccumulation::add_frame(int samples) {
  parallel_chunks(extent_.count(), kTexelsOfTask,
                  [&](std::size_t, std::size_t begin, std::size_t end) {
                    for (std::size_t texel = begin; texel < end; ++texel) {
                      form_ == ReflectivityForm::published ? add_published(texel, samples)
                                                           : add_exact(texel, samples);
                    }
                  });
  samples_ += static_cast<std::uint64_t>(samples);
}

void ReflectivityAccumulation::add_published(std::size_t texel, int samples) {
  const RandomStream stream = stream_.substream(texel);
  const Frame frame = frame_around(texel_centre(texel, extent_));
  glm::dvec3 sum(0.0);
  int good = 0;
  for (int i = 0; i < samples || good == 0; ++i) {
    const HalfVectorDraw draw =
        draw_half_vector(shininess_, stream.point(samples_ + static_cast<std::uint64_t>(i)));
    if (is_skipped_published(shininess_, draw.half_cosine) || !(draw.light.z > 0.0)) continue;
    sum += reflectivity_weight_published(shininess_, draw.half_cosine) *
           radiance_from(*map_, frame, draw.light);
    ++good;
  }
  const Rgb mean(sum / static_cast<double>(good));
  Published& blend = published_[texel];
  const auto count = static_cast<std::uint64_t>(samples);
  blend.red.add(mean.r, count);
  blend.green.add(mean.g, count);
  blend.blue.add(mean.b, count);
}

void ReflectivityAccumulation::add_exact(std::size_t texel, int samples) {
  const RandomStream stream = stream_.substream(texel);
  const Frame frame = frame_around(texel_centre(texel, extent_));
  Exact& sums = exact_[texel];
  for (int i = 0; i < samples; ++i) {
    const HalfVectorDraw draw =
        draw_half_vector(shininess_, stream.point(samples_ + static_cast<std::uint64_t>(i)));
    const double weight =
        draw.light.z > 0.0 ? reflectivity_weight(shininess_, draw.half_cosine) : 0.0;
    sums.light.add(
        weight > 0.0 ? weight * radiance_from(*map_, frame, draw.light) : glm::dvec3(0.0), 1);
    sums.weight.add(weight, 1);
  }
}

Grid<Rgb> ReflectivityAccumulation::mean() const {
  Grid<Rgb> map(extent_);
  for (std::size_t texel = 0; texel < extent_.count(); ++texel) {
    if (form_ == ReflectivityForm::published) {
      const Published& blend = published_[texel];
      map.values()[texel] = {blend.red.mean(), blend.green.mean(), blend.blue.mean()};
      continue;
    }
    const double weight = form_ == ReflectivityForm::per_draw ? 1.0 : exact_[texel].weight.mean();
    if (weight > 0.0) map.values()[texel] = Rgb(exact_[texel].light.mean() / weight);
  }
  return map;
}

}  // namespace lightproof
