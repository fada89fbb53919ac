// What the suite finds out, as plain values. The report, the command line and the JSON files read
// these and nothing else.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/core/measure.h"
#include "lightproof/image/environment_map.h"
#include "lightproof/stats/verdict.h"

namespace lightproof {

/// Stands where the map's name would in records of laws that need no map.
inline constexpr std::string_view kDirections = "directions";

/// Probability with which the detectable effect of a test is found.
inline constexpr double kDetectablePower = 0.99;

/// The root mean square deviation of the bins, relative to their expectations, that an accepting
/// run must have been able to see with kDetectablePower, unless another one is asked for.
inline constexpr double kMustDetect = 0.1;

/// The test of the bins over (phi, theta), and that of all counts in a sequential run: what they
/// could have seen decides whether an accepting run says anything.
inline constexpr std::string_view kBinsTest = "bins 16x32";
inline constexpr std::string_view kSequentialTest = "sequential";

/// One test of one configuration.
struct TestRecord {
  std::string sampler;
  std::string weighting;  ///< "A" (p proportional to g) or "B" (g times solid angle)
  std::string map;
  std::string oracle;  ///< "self", "reference", "mean", "variance", or "check" (exact)
  std::string test;
  std::uint64_t samples = 0;
  double statistic = 0.0;
  double dof = 0.0;                         ///< 0 where it has no meaning
  std::optional<double> log10_p;            ///< none for a deterministic check
  double effect = 0.0;                      ///< size of the deviation that was seen
  std::optional<double> detectable_effect;  ///< seen with kDetectablePower at this run's alpha
  Outcome outcome = Outcome::inconclusive;
  std::string detail;         ///< why, in words; empty if there is nothing to say
  std::uint64_t seed = 0;     ///< base seed of the samples
  std::string source = {};    ///< of the map, as it was given; empty: its name
  int stage = 1;              ///< 2: run again, with more samples, because it looked suspicious
  bool known_defect = false;  ///< of a sampler kept as published, to show what the gate finds
  /// Below this effect the sampler's own rounding shows; for texels and rows of laws that are
  /// added up.
  std::optional<double> resolution_floor = {};
};

/// A configuration that was rejected, for whoever has to mend it.
struct Rejection {
  std::string sampler;
  std::string weighting;
  std::string map;
  std::string looks_like;              ///< the most likely defect, by name
  std::string diagnosis;               ///< the same in words
  Grid<double> residual;               ///< (O - E) / sqrt(E) of the 16x32 bins
  std::vector<double> row_divergence;  ///< of the marginal of rows, cumulative from t = 0
  /// How sure the name is, in words; empty where nothing is named.
  std::string confidence = {};
};

struct GateResult {
  double family_alpha = 0.0;  ///< probability that a run over correct samplers rejects anything
  std::uint64_t samples = 0;  ///< per configuration; suspicious tests are run again with four times
  std::uint64_t seed = 0;
  std::vector<TestRecord> tests;
  std::vector<Rejection> rejections = {};
  std::string input_options = {};  ///< of the command line, with which the maps were read
  std::uint64_t family = 0;        ///< p-values, or candidates if sequential, that share the error
  bool sequential = false;
  double must_detect = kMustDetect;  ///< as asked for
};

/// The error of an estimator at one number of samples.
struct ConvergencePoint {
  std::uint64_t samples = 0;
  double rmse = 0.0;        ///< root mean square error over pixels and replicates / mean value
  double rmse_error = 0.0;  ///< its standard error (from the exact fourth moment)
  double predicted = 0.0;   ///< from the exact variance
};

struct ConvergenceRecord {
  std::string map;
  std::string receiver;
  std::string material;
  std::string strategy;
  int pixels = 0;
  int replicates = 0;                    ///< per pixel and number of samples
  std::vector<ConvergencePoint> points;  ///< ascending numbers of samples
  /// Of log rmse against log samples, fitted to the points whose rmse_error is below a quarter of
  /// the prediction; -1/2 is expected. Not a number, like slope_error, where fewer than three
  /// points are (light found by rare hits), or where the estimator has no variance at all.
  double slope = 0.0;
  double slope_error = 0.0;
  double measured_variance = 0.0;  ///< per sample, averaged over pixels, relative to mean^2
  double predicted_variance = 0.0;
  double variance_ratio_error = 0.0;  ///< standard error of measured / predicted
};

/// One row of the throughput benchmark.
struct ThroughputRecord {
  std::string sampler;
  std::string map;
  Extent extent;
  double ns_per_sample = 0.0;  ///< median over repetitions
  double ns_low = 0.0;         ///< smallest and largest repetition
  double ns_high = 0.0;
  double table_bytes = 0.0;
  double build_ms = 0.0;  ///< median of some builds, on all threads
};

/// What a sampler's table costs and how well it keeps the map: a row of the benchmark of batches
/// with fused random numbers.
struct TableRecord {
  std::string sampler;
  std::string map;
  Extent extent;
  double ns_per_sample = 0.0;  ///< median over repetitions
  double bytes_per_texel = 0.0;
  double worst_texel_error = 0.0;  ///< relative, of the probability that a texel is drawn with
  double times_baseline = 0.0;     ///< as fast as std::upper_bound; 0 if it is that itself
  double share_of_limit = 0.0;     ///< of the speed of a bare gather; likewise
};

/// What one step of a search takes on maps of one size.
struct StepTime {
  Extent extent;
  double ns = 0.0;
};

/// Sizes in bytes of the caches that a core of the measured machine reads through, as its system
/// reports them; empty where it does not.
struct CacheSizes {
  std::optional<double> l2;
  std::optional<double> l3;
};

/// Of a power law, by least squares on logarithms.
struct FittedExponent {
  double value = 0.0;
  double error = 0.0;  ///< standard error, from the scatter about the law
};

/// Where the time of a step starts to grow in another way.
struct StepKnee {
  Extent extent;
  double exponent_after = 0.0;  ///< of ns per step against S + T
};

/// Of the time of a step: power laws that follow each other, where a single one will not do.
struct StepKnees {
  double exponent_before = 0.0;
  std::vector<StepKnee> knees;  ///< one or two, ascending sizes
  double p_value = 1.0;         ///< that scatter about one power law seems to bend so clearly
};

/// How a sampler's costs grow with the map.
struct GrowthFit {
  std::string sampler;
  std::string model;      ///< how many steps one sample takes: "S + T" or "log2 S + log2 T"
  double exponent = 0.0;  ///< of ns per sample against S + T, by least squares on logs
  double exponent_error = 0.0;
  std::vector<StepTime> steps;  ///< ascending sizes; constant if time grows as the model does
  /// The smallest measured map whose table is larger than the cache; none if all fit, or if the
  /// size of the cache is not known.
  std::optional<Extent> leaves_l2 = {};
  std::optional<Extent> leaves_l3 = {};
  std::optional<StepKnees> knees = {};                ///< none if one power law will do
  std::optional<FittedExponent> build_exponent = {};  ///< of the time to build, against S times T
};

/// A map as the report shows it.
struct MapRecord {
  EnvironmentMap map;
  std::string source;               ///< the map's name, unique in the study
  double mean_luminance = 0.0;      ///< over the sphere
  double peak_ratio = 0.0;          ///< brightest texel / mean
  double effective_fraction = 0.0;  ///< G^2/(4 pi Q): share of the sphere that the light fills
  std::vector<SquarePoint> drawn;   ///< some hundred samples of binary_search, weighting B
};

/// One picture of a receiver, by one strategy at equal numbers of samples.
struct RenderRecord {
  std::string map;
  std::string receiver;
  std::string material;
  std::string strategy;
  std::uint64_t samples = 0;
  Grid<Rgb> picture;    ///< row 0 at the top
  Grid<Rgb> reference;  ///< the same for every strategy
  Grid<double> error;   ///< signed, over the reference's mean luminance at the receiver
  double rmse = 0.0;    ///< of `error` at the pixels that show the receiver
  double seconds = 0.0;
  std::uint64_t reference_samples = 0;  ///< per pixel of the reference; 0 if it is not sampled
};

/// p-values of one test of a sampler that is right: uniform, if the test is.
struct CalibrationRecord {
  std::string test;       ///< "reference/rows"
  bool is_bound = false;  ///< its p-values may be too large, never too small
  std::uint64_t replicates = 0;
  std::vector<double> quantiles;           ///< of p, at 0 %, 1 %, … 100 %
  double ks_distance = 0.0;                ///< of their distribution from uniform
  double log10_p_ks = 0.0;                 ///< Kolmogorov-Smirnov; one-sided for a bound
  std::optional<double> log10_p_anderson;  ///< none for a bound
  std::uint64_t below_one_percent = 0;     ///< p-values below 0.01
};

/// How often runs over right samplers reject anything.
struct FamilyRecord {
  std::string procedure;
  double family_alpha = 0.0;
  std::uint64_t runs = 0;
  std::uint64_t rejected = 0;
  bool is_bound = false;  ///< far from reached, by construction
};

struct CalibrationResult {
  std::vector<CalibrationRecord> tests;
  std::vector<FamilyRecord> families;
};

/// How often a test rejects a law that is off by a known effect.
struct PowerRecord {
  std::string test;
  double effect = 0.0;
  double level = 0.0;  ///< size of the test
  std::uint64_t samples = 0;
  std::uint64_t replicates = 0;
  std::uint64_t rejected = 0;
  double predicted = 0.0;  ///< share that should be rejected
  bool is_bound = false;   ///< at least that share
};

/// The fewest samples, of those tried, with which each test rejects one mutant.
struct KillRecord {
  std::string mutant;
  std::string oracle;  ///< that must reject it
  std::string looks_like;
  std::string expected_diagnosis;
  struct Kill {
    std::string test;  ///< "reference/rows"
    std::uint64_t samples;
  };
  std::vector<Kill> kills;
  std::optional<std::uint64_t> sequential;  ///< that the sequential gate took; none: accepted
};

/// What the gate calls one mutant on the maps of a study, under both weightings.
struct NamingRecord {
  std::string mutant;
  std::string expected;        ///< its name
  std::uint64_t runs = 0;      ///< maps, weightings and seeds
  std::uint64_t rejected = 0;  ///< runs in which it was; the others are in no other count
  std::uint64_t right = 0;
  std::uint64_t unknown = 0;  ///< no known defect explains the samples
  std::uint64_t wrong = 0;
  std::vector<std::string> wrong_names = {};  ///< each once
};

/// The gate tested on itself.
struct SelfTestResult {
  CalibrationResult calibration;
  std::vector<PowerRecord> power;
  std::vector<KillRecord> mutants;
  std::vector<NamingRecord> naming = {};
};

/// Everything that one study found.
struct StudyResult {
  std::string version;
  std::string machine;
  std::uint64_t seed = 0;
  std::vector<MapRecord> maps;
  GateResult gate;
  std::vector<ConvergenceRecord> convergence;
  std::vector<ThroughputRecord> throughput;
  CacheSizes caches;  ///< of the machine that measured the throughput
  std::vector<GrowthFit> growth;
  std::vector<TableRecord> tables;
  std::vector<RenderRecord> renders;
  std::optional<SelfTestResult> self_test = {};
};

}  // namespace lightproof
