#include "lightproof/results/test_id.h"

#include <array>

namespace lightproof {
namespace {

using enum TestId;
using enum EffectMeasure;

constexpr std::string_view kPositions = "positions of samples within their texel, 8 x 8 cells";
constexpr std::string_view kPairs = "pairs of transformed coordinates of samples so far apart";
constexpr std::string_view kSums = "sums of a transformed coordinate over 16 samples in a row";

constexpr std::array kTests = {
    TestDescription{bins, Oracle::reference, "bins 16x32",
                    "samples in 16 x 32 bins of (theta, phi)"},
    TestDescription{texels, Oracle::reference, "texels", "samples in each texel"},
    TestDescription{rows, Oracle::reference, "rows", "samples in each row"},
    TestDescription{columns, Oracle::reference, "columns", "samples in each column"},
    TestDescription{worst_texel, Oracle::reference, "worst texel",
                    "samples in the texel that is farthest off", true, worst_cell},
    TestDescription{worst_row, Oracle::reference, "worst row",
                    "samples in the row that is farthest off", true, worst_cell},
    TestDescription{worst_column, Oracle::reference, "worst column",
                    "samples in the column that is farthest off", true, worst_cell},
    TestDescription{own_pdf_bins, Oracle::self, "bins 16x32 of its own pdf",
                    "samples in 16 x 32 bins of (theta, phi)"},
    TestDescription{phi, Oracle::reference, "phi (Kuiper)",
                    "the column marginal of samples, transformed: mass to the left over all rows",
                    false, distance},
    TestDescription{theta, Oracle::reference, "theta (Anderson-Darling)",
                    "the row marginal of samples, transformed: mass of all rows below", false,
                    distance},
    TestDescription{transformed_pair, Oracle::reference, "transformed pair",
                    "both Rosenblatt coordinates of samples, 32 x 32 cells"},
    TestDescription{positions_first_row, Oracle::reference, "positions in the first row",
                    kPositions},
    TestDescription{positions_between, Oracle::reference, "positions between the pole rows",
                    kPositions},
    TestDescription{positions_last_row, Oracle::reference, "positions in the last row", kPositions},
    TestDescription{independence_lag_1, Oracle::reference, "independence at lag 1", kPairs},
    TestDescription{independence_lag_2, Oracle::reference, "independence at lag 2", kPairs},
    TestDescription{independence_lag_4, Oracle::reference, "independence at lag 4", kPairs},
    TestDescription{independence_lag_8, Oracle::reference, "independence at lag 8", kPairs},
    TestDescription{independence_lag_16, Oracle::reference, "independence at lag 16", kPairs},
    TestDescription{independence_lag_32, Oracle::reference, "independence at lag 32", kPairs},
    TestDescription{independence_lag_64, Oracle::reference, "independence at lag 64", kPairs},
    TestDescription{run_sums_theta, Oracle::reference, "sums over runs of 16, theta", kSums},
    TestDescription{run_sums_phi, Oracle::reference, "sums over runs of 16, phi", kSums},
    TestDescription{irradiance_z_mean, Oracle::mean, "irradiance, normal +z",
                    "the estimator's values, against the exact mean", false, relative_mean},
    TestDescription{irradiance_z_variance, Oracle::variance, "irradiance, normal +z",
                    "squares of the estimator's values, against the exact variance", false,
                    relative_mean},
    TestDescription{irradiance_z_uniform, Oracle::mean, "irradiance, normal +z, against uniform",
                    "the estimator's values, against those of uniform directions", false,
                    relative_mean},
    TestDescription{irradiance_x_mean, Oracle::mean, "irradiance, normal +x",
                    "the estimator's values, against the exact mean", false, relative_mean},
    TestDescription{irradiance_x_variance, Oracle::variance, "irradiance, normal +x",
                    "squares of the estimator's values, against the exact variance", false,
                    relative_mean},
    TestDescription{irradiance_x_uniform, Oracle::mean, "irradiance, normal +x, against uniform",
                    "the estimator's values, against those of uniform directions", false,
                    relative_mean},
    TestDescription{inverse_pdf, Oracle::self, "mean of 1/pdf",
                    "1/pdf of samples in bright texels, against their solid angle", false,
                    relative_mean},
    TestDescription{two_samples, Oracle::reference, "two samples with linear_scan",
                    "samples in 16 x 32 bins, against those of the reference implementation"},
    TestDescription{sequential, Oracle::reference, "sequential",
                    "all counts so far, by e-processes; valid whenever it stops"},
    TestDescription{irradiance_z_constant, Oracle::check, "irradiance, normal +z is constant",
                    "an estimator without variance", false, difference},
    TestDescription{irradiance_x_constant, Oracle::check, "irradiance, normal +x is constant",
                    "an estimator without variance", false, difference},
    TestDescription{inverse_pdf_constant, Oracle::check, "mean of 1/pdf is constant",
                    "an estimator without variance", false, difference},
    TestDescription{in_domain, Oracle::check, "no out-of-domain samples",
                    "samples beside the map, or without a positive, finite density", false, share},
    TestDescription{positive_density, Oracle::check, "no zero-density samples",
                    "samples in texels whose declared density is 0", false, share},
    TestDescription{random_bits, Oracle::check, "random numbers have more than 20 bits",
                    "samples on a lattice of 2^-20", false, share},
    TestDescription{pdf_integral, Oracle::check, "pdf integrates to 1", "the pdf over the square",
                    false, difference},
    TestDescription{pdf_support, Oracle::check, "support of the pdf",
                    "cells in which the pdf is 0 and the declared density is not, or the reverse",
                    false, unreachable_mass},
    TestDescription{declared_density, Oracle::check, "pdf is the declared density",
                    "the pdf at the centre of every cell", false, relative_pdf},
    TestDescription{returned_pdf, Oracle::check, "pdf of the sample",
                    "the pdf that comes with a sample, against pdf() there", false, relative_pdf},
    TestDescription{next_to_one, Oracle::check, "u next to 1",
                    "samples at the largest numbers below 1", false, share},
    TestDescription{edge_points, Oracle::check, "edges of u",
                    "samples at CDF entries and their neighbours", false, share},
    TestDescription{answers, Oracle::check, "every call returns",
                    "calls of a sampler that runs in another process", false, share},
    TestDescription{same_texel, Oracle::check, "same texel as linear_scan",
                    "texels of the reference implementation at the same points", false, share},
    TestDescription{given_area, Oracle::self, "solid angle by 1/pdf",
                    "1/pdf of samples in blocks of texels, against their solid angle", true,
                    relative_mean},
    TestDescription{given_light, Oracle::mean, "light by L/pdf",
                    "light over pdf of samples in blocks of texels, against their exact light",
                    true, relative_mean},
    TestDescription{given_weights, Oracle::mean, "light by the given weights",
                    "weights of samples in blocks of texels, against their exact light", true,
                    relative_mean},
    TestDescription{light_reached, Oracle::self, "light that no sample reaches",
                    "texels with light in which none of the first samples lies", true,
                    unreachable_mass},
    TestDescription{weight_is_light, Oracle::check, "weight is L/pdf",
                    "weights against light over pdf at the sample", false, relative_pdf},
    TestDescription{grid_density, Oracle::check, "pdf of a grid of directions",
                    "densities on a grid, against the declared ones", false, relative_pdf},
    TestDescription{grid_integral, Oracle::check, "pdf of a grid integrates to 1",
                    "densities on a grid times the solid angles of its cells", false, difference},
    TestDescription{grid_bins, Oracle::self, "bins of the pdf of a grid",
                    "samples in up to 16 x 32 blocks of cells, against the densities of a grid",
                    true, worst_cell},
};

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < kTests.size(); ++i) {
    if (static_cast<std::size_t>(kTests[i].id) != i) return false;
  }
  return true;
}
static_assert(is_in_order());
static_assert(kTests.size() == static_cast<std::size_t>(grid_bins) + 1);

}  // namespace

std::string_view to_string(Oracle oracle) {
  switch (oracle) {
    case Oracle::reference:
      return "reference";
    case Oracle::self:
      return "self";
    case Oracle::mean:
      return "mean";
    case Oracle::variance:
      return "variance";
    case Oracle::check:
      return "check";
  }
  return "";
}

std::string_view meaning_of(EffectMeasure measure) {
  switch (measure) {
    case cells:
      return "the root mean square deviation of the cells, relative to their expectations";
    case worst_cell:
      return "the observed count of the worst cell over its expectation, less 1";
    case distance:
      return "the distance of the distribution functions, as the statistic weighs it";
    case relative_mean:
      return "the measured value over the exact one, less 1";
    case share:
      return "the share of the samples or points that fail";
    case relative_pdf:
      return "the largest relative difference of densities";
    case difference:
      return "the relative difference from the exact value";
    case unreachable_mass:
      return "the share of the light that the pdf calls unreachable";
  }
  return "";
}

std::span<const TestDescription> tests() { return kTests; }

const TestDescription& describe(TestId test) { return kTests[static_cast<std::size_t>(test)]; }

std::string full_name(TestId test) {
  const TestDescription& row = describe(test);
  return std::string(to_string(row.oracle)).append("/").append(row.name);
}

}  // namespace lightproof
