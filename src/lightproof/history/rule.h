// The rule by which one benchmark of one session is slower, the same or faster.
//
// Times: the runs of head are slower if a one-sided Mann-Whitney test says so at `alpha` AND the
// medians' ratio is beyond a limit. The test alone finds differences that nobody feels; the effect
// alone is chance where times scatter. The limit is 1.05, or three times what comparing base with
// itself would show (A/A noise), whichever is larger. That noise is the standard deviation of the
// logarithm of the ratio of two medians of runs of the same program:
//
//     noise = e sqrt(1 + n/m),    e = standard error of the median of log time of base's n runs,
//
// where m runs of head have the error e sqrt(n/m). The error of a median is by Maritz and Jarrett:
// it needs no assumed distribution, and no luck with how runs are split into halves. Three of them
// are exceeded once in 740 comparisons of equal programs by normal noise, about as often as alpha.
//
// Instructions: a kernel of fixed work, compiled for a fixed instruction set, executes the same
// number every time, so there is nothing to test. The limit is 1.01: one instruction more in a loop
// of a hundred, the length of the longer samplers here, shows; what moves a shorter loop by less
// than one instruction per round is work outside of the loop.
//
// Errors of methods, tables and maps depend on the seed alone: they may grow by what another order
// of sums rounds, one part in a million, and not by more.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "lightproof/history/run.h"

namespace lightproof {

/// The limits of the rule.
struct RegressionRule {
  double alpha = 0.001;              ///< level of the one-sided Mann-Whitney test
  double least_effect = 0.05;        ///< least relative difference of times that counts
  double noise_factor = 3.0;         ///< least difference of times over the A/A noise
  double instruction_effect = 0.01;  ///< least relative difference of instruction counts
  double error_effect = 1e-6;        ///< least relative difference of errors
};

/// How head does against base.
enum class Change { none, slower, faster };

/// What one session says of one benchmark.
struct Judgement {
  std::size_t base_runs = 0;
  std::size_t head_runs = 0;
  double base = 0.0;              ///< median over the runs of base
  double head = 0.0;              ///< median over the runs of head
  double ratio = 1.0;             ///< head / base
  double limit = 1.0;             ///< the ratio, or its inverse, is an effect beyond this
  double noise = 0.0;             ///< A/A noise, relative; 0 of an exact metric
  std::optional<double> log10_p;  ///< log10 p of the Mann-Whitney test; none of an exact metric
  Change change = Change::none;
};

/// Judges one benchmark by one value a run; neither side is empty.
Judgement judge(Metric metric, std::span<const double> base, std::span<const double> head,
                const RegressionRule& rule);

/// Whether the Mann-Whitney test could reject at all with so many runs.
bool enough_runs(std::size_t base, std::size_t head, const RegressionRule& rule);

/// The least number of runs on each side that is enough.
std::size_t least_runs(const RegressionRule& rule);

}  // namespace lightproof
