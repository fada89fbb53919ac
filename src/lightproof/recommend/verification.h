// Candidates are run: how many samples the uncertain ones need, and whether all of them do reach
// the error.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lightproof/accuracy/lit_receiver.h"
#include "lightproof/recommend/candidates.h"
#include "lightproof/results/accuracy_chart.h"

namespace lightproof {

/// An error so many times the one that is asked for is missed.
inline constexpr double kMissed = 1.02;

/// Rounds of a measurement by which a method is judged.
inline constexpr int kFinalRounds = 12;

/// What is to be run: numbers of samples, ascending, by estimator.
using SamplesOf = std::map<std::string_view, std::vector<std::uint64_t>>;
/// Lines of a chart by estimator, with a point for each number of samples.
using MeasuredLines = std::map<std::string, AccuracyLine, std::less<>>;

/// How thoroughly something is run, and what for: another purpose has other random numbers.
struct RunKind {
  int rounds;
  std::string purpose;
};
/// Runs estimators. Every one that is asked for has its line.
using RunEstimators = std::function<MeasuredLines(const SamplesOf& samples, const RunKind& kind)>;

/// Runs them on a receiver.
RunEstimators run_on(const LitReceiver& lit, std::uint64_t seed);

/// The error that a point of a measured line stands for: the exact one if it is known and the
/// measured one is no more than three standard errors from it, else the measured one; infinite if
/// rare estimates that were not seen may carry it.
double credible_error(const AccuracyPoint& point);

/// What became of candidates in a search.
struct Search {
  std::vector<Candidate> found;  ///< at numbers of samples that seem to do, the cheapest first
  std::vector<std::pair<Candidate, Obstacle>> failed;
  /// Those that were given up because others take less time.
  std::vector<Candidate> too_slow;
};

/// Finds the numbers of samples that the uncertain ones of the candidates need: doubled up to what
/// budget and kMostDirections allow, or until others reach the error in much less time.
Search search_samples(const RunEstimators& run, const MethodDemand& demand,
                      const std::vector<Candidate>& candidates);

/// A candidate and what was measured of it.
struct Verified {
  Candidate candidate;
  AccuracyLine line;  ///< of one point

  const AccuracyPoint& point() const { return line.points.front(); }
  /// Measured processor time of a shading point, with its part of the set-up.
  double seconds(const MethodDemand& demand) const {
    return point().seconds +
           line.set_up_processor_seconds / static_cast<double>(demand.shading_points);
  }
};

/// Candidates that were run at their numbers of samples.
struct Verification {
  std::vector<Verified> reaching;  ///< the error, by measured time, the fastest first
  std::vector<std::pair<Candidate, Obstacle>> failed;
  std::vector<Candidate> too_slow;  ///< not run
};

/// Measures candidates, which come cheapest first, until there are two that reach the error and no
/// other one is expected to take less time. One that misses it gets more samples, as a slope of
/// -1/2 asks for, some times, within its budget; one whose samples have no number is out. One that
/// reaches much less than the error, and whose error falls nobody knows how, is tried with fewer.
Verification verify(const RunEstimators& run, const MethodDemand& demand,
                    const std::vector<Candidate>& candidates);

}  // namespace lightproof
