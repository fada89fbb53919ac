// Writes the report of a synthetic study, for looking at and for the browser test:
//   write_sample_report FOLDER [bare]
// `bare` leaves out throughput and renders and most of the convergence records.
#include <cstdio>
#include <exception>
#include <string_view>

#include "fixture.h"
#include "lightproof/report/report.h"

namespace {

void strip(lightproof::StudyResult& study) {
  study.throughput.clear();
  study.growth.clear();
  study.renders.clear();
  study.maps.resize(1);
  study.self_test.reset();
  study.frames.clear();
  study.points.decay.clear();
  study.level_costs.levels.resize(1);
  study.level_costs.gains.clear();
  study.convergence.resize(5);  // leaves a scene with one estimator
  study.gate.tests.resize(3);
  study.gate.tests[1].outcome = lightproof::Outcome::inconclusive;
}

int run(int count, char** arguments) {
  lightproof::StudyResult study = lightproof::testing::synthetic_study();
  if (count == 3 && std::string_view(arguments[2]) == "bare") strip(study);
  const lightproof::RunDescription made_by = {study.version, "", "write_sample_report"};
  lightproof::write_report(study, arguments[1], made_by, lightproof::Overwriting::of_listed_files);
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2 && count != 3) {
    std::fputs("usage: write_sample_report FOLDER [bare]\n", stderr);
    return 2;
  }
  try {
    return run(count, arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
