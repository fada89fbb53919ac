#include "lightproof/self_test/trial.h"

#include "lightproof/gate/discrete_sampler.h"
#include "lightproof/warp/lat_long.h"
#include "reference/texel_masses.h"

namespace lightproof {

Trial::Trial(const EnvironmentMap& map, Grid<double> masses)
    : expectation(shared_expectation_of(std::make_shared<const EnvironmentMap>(map), kTrialTarget)),
      drawn(std::move(masses)) {
  const auto sampler = std::make_shared<const BoundSampler>(
      bound(DiscreteSampler(drawn, DensitySpace::solid_angle)));
  inspection.own = integrate_pdf(*sampler, drawn.extent());
  inspection.density = compare_density(*sampler, *expectation, {});
  test_case = {map.name,
               std::string(to_string(kTrialTarget.density_space)),
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

Trial correct_trial() {
  const EnvironmentMap map = calibration_map();
  return {map, reference::texel_masses(map, kTrialTarget)};
}

std::vector<Measured> run_once(const Trial& trial, std::uint64_t samples, std::uint64_t seed) {
  const TestRun run{&trial.test_case, &trial.test_case.instances[0], seed};
  const BoundSampler sampler = run.instance->bind();
  const Draws draws = draw_samples_of(run, *trial.expectation, sampler, "draws", samples);
  const UniformEstimates uniform =
      draw_uniformly(*trial.expectation, RandomStream("self-test/uniform", seed), samples);
  return test_draws(run, *trial.expectation, trial.inspection, draws, uniform);
}

}  // namespace lightproof
