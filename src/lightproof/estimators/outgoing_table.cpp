#include "lightproof/estimators/outgoing_table.h"

#include <memory>
#include <vector>

#include "lightproof/core/parallel.h"
#include "lightproof/estimators/multiple_importance.h"
#include "lightproof/estimators/sampled.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/warp/hemisphere.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

constexpr Extent kNormals = {32, 16};
/// Azimuths and cosines of views around the normal.
constexpr Extent kViews = {16, 8};
constexpr std::uint64_t kSeed = 1;

std::size_t cell_at(Extent cells, SquarePoint at) {
  return static_cast<std::size_t>(cell_of(at.t, cells.height)) *
             static_cast<std::size_t>(cells.width) +
         static_cast<std::size_t>(cell_of(at.s, cells.width));
}

SquarePoint centre_of(Extent cells, std::size_t index) {
  const auto width = static_cast<std::size_t>(cells.width);
  const std::size_t row = index / width;
  return {(static_cast<double>(index % width) + 0.5) / cells.width,
          (static_cast<double>(row) + 0.5) / cells.height};
}

/// Views by azimuth and cosine in the frame of the normal, which turns steadily over either half of
/// the sphere; no row of normals lies in both.
std::size_t entry_of(const ShadingPoint& at) {
  const Direction view = frame_around(at.frame.normal).to_local(at.view);
  const SquarePoint of_view = {approximate_square_from_direction(view).s, view.z};
  return cell_at(kNormals, square_from_direction(at.frame.normal)) * kViews.count() +
         cell_at(kViews, of_view);
}

ShadingPoint point_of(std::size_t entry) {
  const Direction normal = direction_from_square(centre_of(kNormals, entry / kViews.count()));
  const SquarePoint of_view = centre_of(kViews, entry % kViews.count());
  const double sine = std::sqrt(1.0 - of_view.t * of_view.t);
  const double phi = kPi - 2.0 * kPi * of_view.s;
  const Frame frame = frame_around(normal);
  return {glm::dvec3(0.0), frame,
          frame.to_world({sine * std::cos(phi), sine * std::sin(phi), of_view.t})};
}

std::vector<Rgb> tabulated(const PreparedEstimator& estimator, const Material& material) {
  const Scene nothing({false, false});
  const BoundEstimator bound = estimator.bind(nothing, material);
  const RandomStream stream("estimators/outgoing table", kSeed);
  std::vector<Rgb> table(kNormals.count() * kViews.count());
  parallel_for(kNormals.count(), [&](std::size_t normal) {
    for (std::size_t view = 0; view < kViews.count(); ++view) {
      const std::size_t entry = normal * kViews.count() + view;
      table[entry] = bound.integrate(point_of(entry), stream,
                                     {entry * kOutgoingTableSamples, kOutgoingTableSamples}, {});
    }
  });
  return table;
}

}  // namespace

ShadingPoint outgoing_table_point(const ShadingPoint& at) { return point_of(entry_of(at)); }

PreparedEstimator outgoing_table(const EnvironmentMap& map) {
  const auto filling = std::make_shared<const PreparedEstimator>(
      samples_at_points(one_sample_mixture(map, DensitySpace::solid_angle, 0.0), "sobol"));
  return {[filling](const Scene& /*scene*/, const Material& material) -> BoundEstimator {
    const auto table = std::make_shared<const std::vector<Rgb>>(tabulated(*filling, material));
    return {[table](const ShadingPoint& at, const RandomStream& /*stream*/, Budget /*budget*/,
                    const EachEstimate& /*each*/) { return (*table)[entry_of(at)]; },
            table->size() * sizeof(Rgb)};
  }};
}

}  // namespace lightproof
