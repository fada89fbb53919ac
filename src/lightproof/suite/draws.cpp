#include "lightproof/suite/draws.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

constexpr std::uint64_t kBatch = 1024;

template <class Into, class From>
void add_counts(Into&& into, const From& from) {
  std::transform(into.begin(), into.end(), from.begin(), into.begin(), std::plus<>());
}

void count(Draws& draws, const Expectation& expectation, SquarePoint u, const TexelSample& sample) {
  if (!is_on_map(sample, expectation.masses.extent())) {
    ++draws.strays;
    if (!draws.first_stray) draws.first_stray = Stray{u, sample};
    return;
  }
  ++draws.bins(cell_of(sample.at.s, kGateBins.width), cell_of(sample.at.t, kGateBins.height));
  ++draws.rows[static_cast<std::size_t>(sample.y)];
  ++draws.columns[static_cast<std::size_t>(sample.x)];
  // 2 pi^2 sin(theta) / p(s,t)
  const double inverse_pdf = 1.0 / to_solid_angle(sample.pdf, sample.at).value;
  const Direction direction = direction_from_square(sample.at);
  const double radiance = expectation.grey(sample.x, sample.y);
  for (std::size_t k = 0; k < kMeanCaseCount; ++k) {
    const double cosine = std::max(0.0, glm::dot(kMeanCases[k].normal, direction));
    draws.estimators[k].add(radiance * cosine * inverse_pdf);
  }
  draws.inverse_pdf.add(expectation.is_bright(sample.x, sample.y) ? inverse_pdf : 0.0);
}

}  // namespace

Draws::Draws(Extent map)
    : bins(kGateBins),
      rows(static_cast<std::size_t>(map.height)),
      columns(static_cast<std::size_t>(map.width)) {}

void Draws::merge(const Draws& other) {
  add_counts(bins.values(), other.bins.values());
  add_counts(rows, other.rows);
  add_counts(columns, other.columns);
  for (std::size_t i = 0; i < kMeanCaseCount; ++i) estimators[i].merge(other.estimators[i]);
  inverse_pdf.merge(other.inverse_pdf);
  strays += other.strays;
  if (!first_stray) first_stray = other.first_stray;
}

bool is_on_map(const TexelSample& sample, Extent map) {
  const bool in_square = sample.at.s >= 0.0 && sample.at.s < 1.0 && sample.at.t >= 0.0 &&
                         sample.at.t < 1.0;  // false for NaN
  return in_square && sample.x >= 0 && sample.x < map.width && sample.y >= 0 &&
         sample.y < map.height && sample.pdf.value > 0.0 && std::isfinite(sample.pdf.value);
}

Draws draw_samples(const BoundSampler& sampler, const Expectation& expectation,
                   const RandomStream& stream, std::uint64_t first, std::uint64_t count_all) {
  Draws draws(expectation.masses.extent());
  std::vector<SquarePoint> points(kBatch);
  std::vector<TexelSample> samples(kBatch);
  for (std::uint64_t done = 0; done < count_all; done += kBatch) {
    const auto size = static_cast<std::size_t>(std::min(kBatch, count_all - done));
    for (std::size_t i = 0; i < size; ++i) points[i] = stream.point(first + done + i);
    sampler.sample(std::span(points).first(size), std::span(samples).first(size));
    for (std::size_t i = 0; i < size; ++i) count(draws, expectation, points[i], samples[i]);
  }
  return draws;
}

}  // namespace lightproof
