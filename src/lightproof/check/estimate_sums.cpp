#include "lightproof/check/estimate_sums.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "lightproof/core/parallel.h"

namespace lightproof {

/// A sample's texel and what is given with it.
struct GivenSample {
  int x;
  int y;
  double pdf;
  SampleWeight weight;
};

namespace {

constexpr std::size_t kBatch = 4096;
/// Samples of one task; fixed, so that the split does not depend on the threads.
constexpr std::uint64_t kTaskSamples = std::uint64_t{1} << 18U;
constexpr std::uint64_t kTasksAtOnce = 16;

constexpr Quantity kArea = {TestId::given_area, EstimatedIntegrand::area, "solid angle"};
constexpr Quantity kLight = {TestId::given_light, EstimatedIntegrand::luminance, "light"};
constexpr std::array kGrey = {Quantity{TestId::given_weights, EstimatedIntegrand::grey, "light"}};
constexpr std::array kColours = {
    Quantity{TestId::given_weights, EstimatedIntegrand::red, "red light"},
    Quantity{TestId::given_weights, EstimatedIntegrand::green, "green light"},
    Quantity{TestId::given_weights, EstimatedIntegrand::blue, "blue light"}};

std::vector<Quantity> quantities_of(const SampleDump& dump, bool judges_pdf) {
  std::vector<Quantity> quantities;
  if (judges_pdf) quantities = {kArea, kLight};
  if (dump.has_coloured_weights()) {
    quantities.insert(quantities.end(), kColours.begin(), kColours.end());
  } else if (dump.has_weights()) {
    quantities.insert(quantities.end(), kGrey.begin(), kGrey.end());
  }
  return quantities;
}

bool is_weight(const SampleWeight& weight) {
  return std::ranges::all_of(weight, [](double w) { return w >= 0.0 && std::isfinite(w); });
}

/// Splits a range into tasks, makes a part of each in parallel, and hands them on in order.
template <class Part, class Make, class Take>
void for_each_part(std::uint64_t begin, std::uint64_t count, const Make& make, const Take& take) {
  constexpr std::uint64_t kAtOnce = kTasksAtOnce * kTaskSamples;
  for (std::uint64_t start = 0; start < count; start += kAtOnce) {
    const std::uint64_t size = std::min(kAtOnce, count - start);
    std::vector<Part> parts(static_cast<std::size_t>((size + kTaskSamples - 1) / kTaskSamples));
    parallel_for(parts.size(), [&](std::size_t task) {
      const std::uint64_t first = start + task * kTaskSamples;
      parts[task] = make(begin + first, std::min(kTaskSamples, start + size - first));
    });
    for (const Part& part : parts) take(part);
  }
}

void mark(Grid<std::uint8_t>& texels, int x, int y) {
  std::atomic_ref<std::uint8_t>(texels(x, y)).store(1, std::memory_order_relaxed);
}

}  // namespace

bool is_usable(const DumpedSample& sample, bool has_pdf) {
  if (!std::isfinite(sample.direction.x)) return false;
  return !has_pdf || (sample.pdf.value > 0.0 && std::isfinite(sample.pdf.value));
}

EstimateSums::EstimateSums(const SampleDump& dump, const EnvironmentMap& map,
                           const EnvironmentMap& colours, bool judges_pdf)
    : dump_(&dump),
      colours_(&colours),
      mapping_(map.mapping),
      luminance_(luminance_of(map)),
      blocks_(luminance_.extent()),
      quantities_(quantities_of(dump, judges_pdf)),
      judges_pdf_(judges_pdf),
      is_seen_(luminance_.extent()),
      is_hit_(luminance_.extent()) {
  first_ = std::max<std::uint64_t>(1, dump.count() / 5);
  rest_ = dump.count() - first_;
  screen();
  set_exact();
  count_rest();
}

template <class Visit>
void EstimateSums::for_each_texel(const Visit& visit) const {
  const Extent extent = luminance_.extent();
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      visit(x, y, texel_solid_angle(mapping_, extent, x, y));
    }
  }
}

double EstimateSums::radiance(EstimatedIntegrand integrand, int x, int y) const {
  switch (integrand) {
    case EstimatedIntegrand::area:
      return 1.0;
    case EstimatedIntegrand::luminance:
    case EstimatedIntegrand::grey:
      return luminance_(x, y);
    case EstimatedIntegrand::red:
      return colours_->radiance(x, y).r;
    case EstimatedIntegrand::green:
      return colours_->radiance(x, y).g;
    case EstimatedIntegrand::blue:
      return colours_->radiance(x, y).b;
  }
  return 0.0;
}

double EstimateSums::value(EstimatedIntegrand integrand, const GivenSample& sample) const {
  switch (integrand) {
    case EstimatedIntegrand::area:
      return 1.0 / sample.pdf;
    case EstimatedIntegrand::luminance:
      return luminance_(sample.x, sample.y) / sample.pdf;
    case EstimatedIntegrand::grey:
    case EstimatedIntegrand::red:
      return sample.weight[0];
    case EstimatedIntegrand::green:
      return sample.weight[1];
    case EstimatedIntegrand::blue:
      return sample.weight[2];
  }
  return 0.0;
}

template <class Visit>
void EstimateSums::visit_range(std::uint64_t first, std::uint64_t count, FaultyRows& faulty,
                               FaultyRows& faulty_weights, const Visit& visit) const {
  std::vector<DumpedSample> samples(kBatch);
  std::vector<SampleWeight> weights(dump_->has_weights() ? kBatch : 0);
  const Extent extent = luminance_.extent();
  for (std::uint64_t done = 0; done < count; done += kBatch) {
    const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(kBatch, count - done));
    dump_->read(first + done, std::span(samples).first(size));
    if (!weights.empty()) dump_->read_weights(first + done, std::span(weights).first(size));
    for (std::size_t i = 0; i < size; ++i) {
      if (!is_usable(samples[i], judges_pdf_)) {
        faulty.add(first + done + i);
        continue;
      }
      if (!weights.empty() && !is_weight(weights[i])) {
        faulty_weights.add(first + done + i);
        continue;
      }
      const SquarePoint point = square_point_of(mapping_, samples[i].direction);
      visit(GivenSample{cell_of(point.s, extent.width), cell_of(point.t, extent.height),
                        samples[i].pdf.value, weights.empty() ? SampleWeight{} : weights[i]});
    }
  }
}

double EstimateSums::light_not_hit() const {
  double light = 0.0;
  for_each_texel([&](int x, int y, double solid_angle) {
    if (is_seen_(x, y) == 0 && is_hit_(x, y) == 0) light += luminance_(x, y) * solid_angle;
  });
  return light;
}

std::vector<EstimateSums::LitOthers> EstimateSums::lit_others() const {
  std::vector<LitOthers> others(blocks_.count());
  for_each_texel([&](int x, int y, double solid_angle) {
    if (is_seen_(x, y) != 0 || !(luminance_(x, y) > 0.0)) return;
    LitOthers& of_block = others[blocks_.of(x, y)];
    of_block.light += luminance_(x, y) * solid_angle;
    of_block.area += solid_angle;
  });
  return others;
}

double EstimateSums::all_light() const {
  double light = 0.0;
  for_each_texel(
      [&](int x, int y, double solid_angle) { light += luminance_(x, y) * solid_angle; });
  return light;
}

void EstimateSums::screen() {
  struct Part {
    std::vector<double> largest;
    FaultyRows faulty;
    FaultyRows faulty_weights;
  };
  largest_.assign(quantities_.size() * blocks_.count(), 0.0);
  for_each_part<Part>(
      0, first_,
      [&](std::uint64_t begin, std::uint64_t count) {
        Part part{std::vector<double>(largest_.size()), {}, {}};
        visit_range(begin, count, part.faulty, part.faulty_weights, [&](const GivenSample& s) {
          mark(is_seen_, s.x, s.y);
          const std::size_t block = blocks_.of(s.x, s.y);
          for (std::size_t q = 0; q < quantities_.size(); ++q) {
            double& most = part.largest[at(q, block)];
            most = std::max(most, value(quantities_[q].integrand, s));
          }
        });
        return part;
      },
      [&](const Part& part) {
        for (std::size_t i = 0; i < largest_.size(); ++i) {
          largest_[i] = std::max(largest_[i], part.largest[i]);
        }
        faulty_.merge(part.faulty);
        faulty_weights_.merge(part.faulty_weights);
      });
}

void EstimateSums::set_exact() {
  exact_seen_.assign(largest_.size(), 0.0);
  exact_others_.assign(largest_.size(), 0.0);
  for_each_texel([&](int x, int y, double solid_angle) {
    std::vector<double>& exact = is_seen_(x, y) != 0 ? exact_seen_ : exact_others_;
    const std::size_t block = blocks_.of(x, y);
    for (std::size_t q = 0; q < quantities_.size(); ++q) {
      exact[at(q, block)] += radiance(quantities_[q].integrand, x, y) * solid_angle;
    }
  });
}

void EstimateSums::count_rest() {
  struct Part {
    std::vector<Sums> sums;
    std::vector<std::uint64_t> hits_of_others;
    FaultyRows faulty;
    FaultyRows faulty_weights;
  };
  sums_.resize(largest_.size());
  hits_of_others_.resize(blocks_.count());
  for_each_part<Part>(
      first_, rest_,
      [&](std::uint64_t begin, std::uint64_t count) {
        Part part{
            std::vector<Sums>(sums_.size()), std::vector<std::uint64_t>(blocks_.count()), {}, {}};
        visit_range(begin, count, part.faulty, part.faulty_weights, [&](const GivenSample& s) {
          const std::size_t block = blocks_.of(s.x, s.y);
          const bool is_seen = is_seen_(s.x, s.y) != 0;
          if (!is_seen) {
            mark(is_hit_, s.x, s.y);
            ++part.hits_of_others[block];
          }
          for (std::size_t q = 0; q < quantities_.size(); ++q) {
            Sums& sums = part.sums[at(q, block)];
            (is_seen ? sums.seen : sums.others).add(value(quantities_[q].integrand, s));
          }
        });
        return part;
      },
      [&](const Part& part) {
        for (std::size_t i = 0; i < sums_.size(); ++i) {
          sums_[i].seen.merge(part.sums[i].seen);
          sums_[i].others.merge(part.sums[i].others);
        }
        for (std::size_t i = 0; i < hits_of_others_.size(); ++i) {
          hits_of_others_[i] += part.hits_of_others[i];
        }
        faulty_.merge(part.faulty);
        faulty_weights_.merge(part.faulty_weights);
      });
}

}  // namespace lightproof
