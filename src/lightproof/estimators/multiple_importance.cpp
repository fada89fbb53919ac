#include "lightproof/estimators/multiple_importance.h"

#include <algorithm>
#include <memory>

#include "lightproof/estimators/environment.h"

namespace lightproof {
namespace {

using reference::Heuristic;

constexpr std::size_t kCapacity = LightSamples::kCapacity;

/// A density times the number of samples that are drawn from it.
double expected(double samples, double pdf) { return samples * pdf; }

/// The density over the weight of a sample of the first of two techniques: of n samples in all of
/// it, with density p, where the techniques expect a and b samples per steradian.
double over_weight(Heuristic heuristic, double p, double a, double b) {
  if (!(a > 0.0)) return 0.0;
  const double ratio = b / a;
  return heuristic == Heuristic::balance ? p * (1.0 + ratio) : p * (1.0 + ratio * ratio);
}

/// How samples are weighted: by a heuristic, of so many samples of lobes and of the map.
struct Weighting {
  Heuristic heuristic;
  double lobes;
  double texels;
};

/// Two techniques: lobes of a material, and a table of the map.
class TwoTechniques {
 public:
  TwoTechniques(const EnvironmentMap& map, DensitySpace density_space, double compensation)
      : map_(&map), table_(map, density_space, compensation) {}

  const EnvironmentMap& map() const { return *map_; }
  bool has_light() const { return table_.has_light(); }
  std::size_t bytes() const { return table_.bytes(); }

  /// Draws from the lobes; divides densities by weights.
  void draw_lobes(const Material& material, const ShadingPoint& at,
                  std::span<const SquarePoint> points, const Weighting& weighting,
                  LightSamples& samples) const {
    const std::size_t count = samples.count = points.size();
    std::array<double, kCapacity> s;
    std::array<double, kCapacity> t;
    for (std::size_t i = 0; i < count; ++i) {
      s[i] = points[i].s;
      t[i] = points[i].t;
    }
    sample_material(material, at, std::span(s).first(count), std::span(t).first(count),
                    {std::span(samples.x).first(count), std::span(samples.y).first(count),
                     std::span(samples.z).first(count), std::span(samples.pdf).first(count),
                     std::span(samples.reflected_cosine).first(count)});
    samples.locate(map_->radiance.extent());
    for (std::size_t i = 0; i < count; ++i) {
      const double p = samples.pdf[i];
      samples.pdf[i] = over_weight(weighting.heuristic, p, expected(weighting.lobes, p),
                                   expected(weighting.texels, table_pdf(samples, i)));
    }
  }

  /// The same from the map. Its densities are those that the table draws, the ones in the weights
  /// those that it should, so that the weights of both techniques have the sum 1 at any direction.
  void draw_texels(const Material& material, const ShadingPoint& at,
                   std::span<const SquarePoint> points, const Weighting& weighting,
                   LightSamples& samples) const {
    const std::size_t count = samples.count = points.size();
    table_.draw(BatchPoints(points), samples);
    std::array<double, kCapacity> lobe_pdf;
    scatterings(
        material, at, samples.directions(),
        {std::span(samples.reflected_cosine).first(count), std::span(lobe_pdf).first(count)});
    for (std::size_t i = 0; i < count; ++i) {
      samples.pdf[i] = over_weight(weighting.heuristic, samples.pdf[i],
                                   expected(weighting.texels, table_pdf(samples, i)),
                                   expected(weighting.lobes, lobe_pdf[i]));
    }
  }

 private:
  double table_pdf(const LightSamples& samples, std::size_t i) const {
    const Rgb texel = map_->radiance(samples.column[i], samples.row[i]);
    return table_.pdf(texel, samples.row[i], std::hypot(samples.x[i], samples.y[i]));
  }

  const EnvironmentMap* map_;
  EnvironmentTable table_;
};

/// One binding of the multi-sample estimator.
struct MultiSample {
  std::shared_ptr<const TwoTechniques> techniques;
  const Scene* scene;
  Material material;
  Heuristic heuristic;

  Rgb integrate(const ShadingPoint& at, const RandomStream& stream, Budget budget,
                const EachEstimate& each) const;

 private:
  struct Batch;
};

/// Samples of both techniques on their way, and their sums.
struct MultiSample::Batch {
  LightSamples samples;
  Arrivals arrivals;
  std::array<SquarePoint, kCapacity> lobe_points;
  std::array<SquarePoint, kCapacity> texel_points;
  std::array<Rgb, kCapacity> pairs;
  glm::dvec3 lobe_sum = glm::dvec3(0.0);
  glm::dvec3 texel_sum = glm::dvec3(0.0);

  /// The points first, first + 2, … to the lobes, those between to the map.
  void deal(const BatchPoints& points, std::size_t lobes, std::size_t texels) {
    std::array<double, 2 * kCapacity> s;
    std::array<double, 2 * kCapacity> t;
    points.fill(0, std::span(s).first(lobes + texels), std::span(t).first(lobes + texels));
    const bool both = texels > 0;
    for (std::size_t i = 0; i < lobes; ++i) {
      const std::size_t from = both ? 2 * i : i;
      lobe_points[i] = {s[from], t[from]};
    }
    for (std::size_t i = 0; i < texels; ++i) texel_points[i] = {s[2 * i + 1], t[2 * i + 1]};
  }
};

Rgb MultiSample::integrate(const ShadingPoint& at, const RandomStream& stream, Budget budget,
                           const EachEstimate& each) const {
  const std::uint64_t texels = techniques->has_light() ? budget.samples / 2 : 0;
  const std::uint64_t lobes = budget.samples - texels;
  const double of_lobes = static_cast<double>(lobes);
  const double of_texels = static_cast<double>(texels);
  const Weighting weighting = {heuristic, of_lobes, of_texels};
  const Grid<Rgb>& radiance = techniques->map().radiance;
  Batch batch;
  for (std::uint64_t done = 0; done < lobes; done += kCapacity) {
    const auto lobe_count = std::min<std::uint64_t>(lobes - done, kCapacity);
    const auto texel_count =
        texels == 0 ? 0 : std::min<std::uint64_t>(texels - std::min(texels, done), kCapacity);
    batch.deal({stream, budget.first + (texels > 0 ? 2 * done : done)}, lobe_count, texel_count);
    techniques->draw_lobes(material, at, std::span(batch.lobe_points).first(lobe_count), weighting,
                           batch.samples);
    const auto by_lobes = batch.samples.estimates(*scene, radiance, at.position, batch.arrivals);
    for (std::size_t i = 0; i < lobe_count; ++i) {
      batch.lobe_sum += glm::dvec3(by_lobes[i]);
      batch.pairs[i] = by_lobes[i];
    }
    if (texel_count > 0) {
      techniques->draw_texels(material, at, std::span(batch.texel_points).first(texel_count),
                              weighting, batch.samples);
      const auto by_texels = batch.samples.estimates(*scene, radiance, at.position, batch.arrivals);
      for (std::size_t i = 0; i < texel_count; ++i) {
        batch.texel_sum += glm::dvec3(by_texels[i]);
        batch.pairs[i] += by_texels[i];
      }
    }
    if (each && (lobes == texels || texels == 0)) each(std::span(batch.pairs).first(lobe_count));
  }
  const glm::dvec3 sum = batch.lobe_sum / of_lobes;
  return Rgb(texels == 0 ? sum : sum + batch.texel_sum / of_texels);
}

/// Points that were dealt to one of two techniques, and where their samples belong.
struct Dealt {
  std::array<SquarePoint, kCapacity> points;
  std::array<std::size_t, kCapacity> indices;
  std::size_t count = 0;

  void add(SquarePoint point, std::size_t index) {
    points[count] = point;
    indices[count++] = index;
  }
  std::span<const SquarePoint> all() const { return std::span(points).first(count); }
  /// Puts the samples where they belong, with their densities times a factor.
  void put(const LightSamples& from, double factor, LightSamples& to) const {
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t index = indices[i];
      to.set(index, from.direction(i));
      to.pdf[index] = factor * from.pdf[i];
      to.reflected_cosine[index] = from.reflected_cosine[i];
      to.column[index] = from.column[i];
      to.row[index] = from.row[i];
    }
  }
};

void draw_mixture(const TwoTechniques& techniques, const Material& material, const ShadingPoint& at,
                  const BatchPoints& points, LightSamples& samples) {
  std::array<double, kCapacity> s;
  std::array<double, kCapacity> t;
  points.fill(0, std::span(s).first(samples.count), std::span(t).first(samples.count));
  const double share = techniques.has_light() ? 0.5 : 1.0;
  const Weighting weighting = {Heuristic::balance, share, 1.0 - share};
  Dealt lobes;
  Dealt texels;
  for (std::size_t i = 0; i < samples.count; ++i) {
    if (s[i] < share) {
      lobes.add({s[i] / share, t[i]}, i);
    } else {
      texels.add({(s[i] - share) / (1.0 - share), t[i]}, i);
    }
  }
  LightSamples some;
  if (lobes.count > 0) {
    techniques.draw_lobes(material, at, lobes.all(), weighting, some);
    lobes.put(some, share, samples);
  }
  if (texels.count > 0) {
    techniques.draw_texels(material, at, texels.all(), weighting, some);
    texels.put(some, 1.0 - share, samples);
  }
}

}  // namespace

PreparedEstimator multi_sample(const EnvironmentMap& map, DensitySpace density_space,
                               Heuristic heuristic, double compensation) {
  const auto techniques = std::make_shared<const TwoTechniques>(map, density_space, compensation);
  return {[techniques, heuristic](const Scene& scene, const Material& material) -> BoundEstimator {
            const MultiSample bound = {techniques, &scene, material, heuristic};
            return {[bound](const ShadingPoint& at, const RandomStream& stream, Budget budget,
                            const EachEstimate& each) {
              return bound.integrate(at, stream, budget, each);
            }};
          },
          techniques->bytes()};
}

PreparedSource one_sample_mixture(const EnvironmentMap& map, DensitySpace density_space,
                                  double compensation) {
  const auto techniques = std::make_shared<const TwoTechniques>(map, density_space, compensation);
  return {&map,
          [techniques](const Material& material) -> SamplesAt {
            return [techniques, material](const ShadingPoint& at) -> DrawSamples {
              return [&techniques = *techniques, &material, &at](const BatchPoints& points,
                                                                 LightSamples& samples) {
                draw_mixture(techniques, material, at, points, samples);
              };
            };
          },
          techniques->bytes()};
}

}  // namespace lightproof
