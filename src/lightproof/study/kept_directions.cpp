#include "lightproof/study/kept_directions.h"

#include "lightproof/gate/direction_sampler.h"

namespace lightproof {

KeptMeasurement<ScreenedRuns> kept_directions(const GateOptions& options,
                                              const MeasurementCache& cache,
                                              const Progress& progress,
                                              const Communicator& communicator) {
  ValueWriter dependence;
  dependence.add(options.samples);
  dependence.add(options.seed);
  return MeasurementKeeper(cache).get<ScreenedRuns>("directions", dependence.take(), [&] {
    return screen_runs(test_cases_of(direction_samplers()), options, progress, communicator);
  });
}

}  // namespace lightproof
