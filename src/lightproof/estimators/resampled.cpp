#include "lightproof/estimators/resampled.h"

#include <algorithm>
#include <cassert>

namespace lightproof {
namespace {

constexpr std::size_t kCapacity = LightSamples::kCapacity;

/// Chooses one of some candidates by their light, and sets it with its share of the light as the
/// density: the mean of all candidates' light over the chosen one's.
class Chooser {
 public:
  Chooser(const EnvironmentMap& map, const LightSamples& candidates)
      : map_(&map), candidates_(&candidates) {}

  void choose(std::size_t first, std::size_t count, double u, LightSamples& chosen,
              std::size_t index) {
    double sum = 0.0;
    for (std::size_t j = 0; j < count; ++j) sums_[j] = sum += weight(first + j);
    const auto end = sums_.begin() + static_cast<std::ptrdiff_t>(count);
    // The sum of all times u may round to the sum: then the first one that reaches it.
    auto found = std::upper_bound(sums_.begin(), end, u * sum);
    if (found == end) found = std::lower_bound(sums_.begin(), end, sum);
    const std::size_t from = first + static_cast<std::size_t>(found - sums_.begin());
    chosen.set(index, candidates_->direction(from));
    chosen.reflected_cosine[index] = candidates_->reflected_cosine[from];
    chosen.column[index] = candidates_->column[from];
    chosen.row[index] = candidates_->row[from];
    chosen.pdf[index] = sum > 0.0 ? light(from) * static_cast<double>(count) / sum : 0.0;
  }

 private:
  /// Luminance times k.
  double light(std::size_t i) const {
    const Rgb texel = map_->radiance(candidates_->column[i], candidates_->row[i]);
    return luminance_of(texel, map_->weights) * candidates_->reflected_cosine[i];
  }
  double weight(std::size_t i) const {
    return candidates_->pdf[i] > 0.0 ? light(i) / candidates_->pdf[i] : 0.0;
  }

  const EnvironmentMap* map_;
  const LightSamples* candidates_;
  std::array<double, kCapacity> sums_;
};

struct Resampled {
  const EnvironmentMap* map;
  const Scene* scene;
  SamplesAt at;
  std::size_t candidate_count;

  Rgb integrate(const ShadingPoint& point, const RandomStream& stream, Budget budget,
                const EachEstimate& each) const {
    const DrawSamples draw = at(point);
    LightSamples chosen;
    Arrivals arrivals;
    glm::dvec3 sum(0.0);
    for (std::uint64_t done = 0; done < budget.samples; done += kCapacity) {
      chosen.count = std::min<std::uint64_t>(budget.samples - done, kCapacity);
      choose_all(draw, stream, budget.first + done, chosen);
      const auto estimates = chosen.estimates(*scene, map->radiance, point.position, arrivals);
      for (const Rgb estimate : estimates) sum += glm::dvec3(estimate);
      if (each) each(estimates);
    }
    return Rgb(sum / static_cast<double>(budget.samples));
  }

 private:
  /// Every chosen sample takes the points of its candidates and one to choose with.
  void choose_all(const DrawSamples& draw, const RandomStream& stream, std::uint64_t first,
                  LightSamples& chosen) const {
    const std::size_t points_each = candidate_count + 1;
    const std::size_t at_once = kCapacity / candidate_count;
    std::array<double, 2 * kCapacity> s;
    std::array<double, 2 * kCapacity> t;
    std::array<SquarePoint, kCapacity> points;
    LightSamples candidates;
    for (std::size_t done = 0; done < chosen.count; done += at_once) {
      const std::size_t count = std::min(at_once, chosen.count - done);
      BatchPoints(stream, (first + done) * points_each)
          .fill(0, std::span(s).first(count * points_each),
                std::span(t).first(count * points_each));
      candidates.count = count * candidate_count;
      for (std::size_t i = 0; i < candidates.count; ++i) {
        const std::size_t from = i + i / candidate_count;
        points[i] = {s[from], t[from]};
      }
      draw(BatchPoints(std::span(points).first(candidates.count)), candidates);
      Chooser chooser(*map, candidates);
      for (std::size_t i = 0; i < count; ++i) {
        chooser.choose(i * candidate_count, candidate_count, s[i * points_each + candidate_count],
                       chosen, done + i);
      }
    }
  }
};

}  // namespace

PreparedEstimator resampled(PreparedSource candidates, std::size_t candidate_count) {
  assert(candidate_count >= 1 && candidate_count <= kCapacity);
  return {[candidates, candidate_count](const Scene& scene,
                                        const Material& material) -> BoundEstimator {
            const Resampled bound = {candidates.map, &scene, candidates.bind(material),
                                     candidate_count};
            return {[bound](const ShadingPoint& at, const RandomStream& stream, Budget budget,
                            const EachEstimate& each) {
              return bound.integrate(at, stream, budget, each);
            }};
          },
          candidates.bytes};
}

}  // namespace lightproof
