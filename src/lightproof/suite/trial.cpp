#include "lightproof/suite/trial.h"

#include "lightproof/suite/law_sampler.h"
#include "lightproof/warp/lat_long.h"
#include "reference/texel_masses.h"

namespace lightproof {

Trial::Trial(const EnvironmentMap& map, Grid<double> masses)
    : expectation(std::make_shared<const Expectation>(expectation_of(map, kTrialTarget))),
      drawn(std::move(masses)) {
  const auto sampler = std::make_shared<const BoundSampler>(bound(LawSampler(drawn, Weighting::B)));
  inspection.own = integrate_pdf(*sampler, drawn.extent());
  inspection.density = compare_density(*sampler, *expectation, {});
  problem = {map.name,
             to_string(kTrialTarget.weighting),
             "",
             [shared = expectation] { return shared; },
             [] { return std::vector<Alternative>(); },
             {{.name = "oracle", .bind = [sampler] { return *sampler; }, .inverts_rows = true}}};
}

EnvironmentMap calibration_map() {
  EnvironmentMap map = {"calibration", Grid<Rgb>({48, 24}), {}};
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 48; ++x) {
      map.radiance(x, y) =
          Rgb(static_cast<float>((1.0 + y / 12.0) * (1.0 + 0.5 * sin_theta(x / 48.0))));
    }
  }
  return map;
}

Trial sound_trial() {
  const EnvironmentMap map = calibration_map();
  return {map, reference::texel_masses(map, kTrialTarget)};
}

std::vector<Measured> run_once(const Trial& trial, std::uint64_t samples, std::uint64_t seed) {
  const Configuration configuration{&trial.problem, &trial.problem.candidates[0], seed};
  const BoundSampler sampler = configuration.candidate->bind();
  const Draws draws = draw_samples_of(configuration, *trial.expectation, sampler, "draws", samples);
  const UniformEstimates uniform =
      draw_uniformly(*trial.expectation, RandomStream("self-test/uniform", seed), samples);
  return test_draws(configuration, *trial.expectation, trial.inspection, draws, uniform);
}

std::string name_of(const TestRecord& record) { return record.oracle + "/" + record.test; }

}  // namespace lightproof
