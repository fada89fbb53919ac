#include "lightproof/testing/sampler_verdict.h"

#include <fmt/format.h>

#include "lightproof/gate/gate.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/report/gate_table.h"
#include "lightproof/results/verdict.h"
#include "lightproof/samplers/cell_margin.h"
#include "lightproof/samplers/mass_rounding.h"

namespace lightproof {
namespace {

double away_from_edges(double coordinate, int cell, int count) {
  return position_in_cell(cell, coordinate * count - cell, count);
}

}  // namespace

TexelSample sample_at(const EnvironmentMap& map, Direction direction, PerSteradian pdf) {
  const Extent extent = map.radiance.extent();
  const SquarePoint of_direction = square_point_of(map.mapping, direction);
  const int x = cell_of(of_direction.s, extent.width);
  const int y = cell_of(of_direction.t, extent.height);
  const SquarePoint at = {away_from_edges(of_direction.s, x, extent.width),
                          away_from_edges(of_direction.t, y, extent.height)};
  return {at, x, y, {pdf.value * solid_angle_per_square(map.mapping, at)}};
}

std::vector<EnvironmentMap> sampler_test_maps() {
  std::vector<EnvironmentMap> maps;
  for (const char* name : {"sun-sky", "black-first-row", "gradient"}) {
    maps.push_back(make_synthetic_map(name, {64, 32}));
  }
  maps.push_back(make_synthetic_map("one-texel", {16, 8}));
  maps.push_back(make_synthetic_map("sun-sky", {37, 19}));
  maps.back().name = "sun-sky 37x19";
  return maps;
}

SamplerVerdict judge_bound_sampler(const std::string& name,
                                   const std::function<BoundSampler(const EnvironmentMap&)>& bind,
                                   const SamplerTestOptions& options) {
  const std::vector<EnvironmentMap> usual =
      options.maps.empty() ? sampler_test_maps() : std::vector<EnvironmentMap>();
  const std::vector<EnvironmentMap>& maps = options.maps.empty() ? usual : options.maps;
  const SamplerUnderTest under_test = {
      .name = name,
      .target = {options.density_space, options.weights, options.lookup},
      .bind = bind,
      .rounding = rounding_of_float_sums};
  SamplerVerdict verdict{};
  verdict.result =
      run_gate(maps, {&under_test, 1}, {.samples = options.samples, .seed = options.seed});
  verdict.result.replay = fmt::format("this test, with the seed {}", options.seed);
  verdict.outcome = overall_outcome(verdict.result, true);
  verdict.is_accepted =
      verdict.outcome == Outcome::accept || verdict.outcome == Outcome::resolution_limited;
  verdict.text = gate_table(verdict.result, true);
  return verdict;
}

}  // namespace lightproof
