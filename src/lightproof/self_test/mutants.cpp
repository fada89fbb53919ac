// The table of mutants: those of the literature and of old bug reports first, then mistakes that a
// tired programmer makes.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lightproof/self_test/mutant.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// Moves a sample to another texel, to the same position inside it.
void move_by(TexelSample& sample, Extent map, int columns, int rows) {
  sample.x += columns;
  sample.y += rows;
  sample.at.s += static_cast<double>(columns) / map.width;
  sample.at.t += static_cast<double>(rows) / map.height;
}

void flip_t(TexelSample& sample, Extent map) {
  sample.at.t = 1.0 - sample.at.t;
  sample.y = map.height - 1 - sample.y;
}

SquarePoint upside_down(SquarePoint at) { return {at.s, 1.0 - at.t}; }

PerSquare times(PerSquare p, double factor) { return {p.value * factor}; }

/// The lowest bits that a 16-bit random number does not have.
double coarse(double u) { return std::floor(u * 0x1p16) * 0x1p-16; }

/// The first cell whose upper edge is not below u, as std::lower_bound finds it.
int lower_bound_of(std::span<const double> sums, double u) {
  const auto found = std::lower_bound(sums.begin(), sums.end(), u);
  return static_cast<int>(std::min(found, sums.end() - 1) - sums.begin());
}

bool is_pole_row(const TexelSample& sample, const DiscreteSampler& distribution) {
  return sample.y == 0 || sample.y == distribution.extent().height - 1;
}

constexpr std::array kMutants = {
    Mutant{.name = "no-sine",
           .defect = "the rows' solid angle forgotten (or applied where it should not be)",
           .diagnosis = "other-density",
           .oracle = Oracle::reference,
           .distribution = "other-density"},
    Mutant{.name = "sine-at-edge",
           .defect = "sin(theta) at y/H",
           .diagnosis = "sine-at-edge",
           .oracle = Oracle::reference,
           .distribution = "sine-at-edge"},
    Mutant{.name = "sine-to-last-row",
           .defect = "sin(theta) at y/(H-1)",
           .diagnosis = "sine-to-last-row",
           .oracle = Oracle::reference,
           .distribution = "sine-to-last-row"},
    Mutant{.name = "column-off-by-one",
           .defect = "every column drawn for its neighbour",
           .diagnosis = "column-late",
           .oracle = Oracle::reference,
           .distribution = "column-late"},
    Mutant{.name = "t-flipped-in-sample",
           .defect = "t flipped in sample() only",
           .diagnosis = "upside-down",
           .oracle = Oracle::self,
           .sample = [](TexelSample& s,
                        const DiscreteSampler& distribution) { flip_t(s, distribution.extent()); }},
    Mutant{.name = "t-flipped-in-both",
           .defect = "t flipped in sample() and pdf()",
           .diagnosis = "upside-down",
           .oracle = Oracle::reference,
           .distribution = "upside-down"},
    Mutant{.name = "u-mirrored",
           .defect = "s mirrored in both",
           .diagnosis = "mirrored",
           .oracle = Oracle::reference,
           .distribution = "mirrored"},
    Mutant{.name = "other-luminance",
           .defect = "the lecture's luminance weights where Rec. 709 is declared",
           .diagnosis = "other-luminance",
           .oracle = Oracle::reference,
           .needs = "more than one colour",
           .distribution = "other-luminance"},
    Mutant{.name = "average-luminance",
           .defect = "the average of R, G and B",
           .diagnosis = "average-luminance",
           .oracle = Oracle::reference,
           .needs = "more than one colour",
           .distribution = "average-luminance"},
    Mutant{.name = "bgr",
           .defect = "R and B swapped",
           .diagnosis = "swapped-channels",
           .oracle = Oracle::reference,
           .needs = "more than one colour",
           .distribution = "swapped-channels"},
    Mutant{.name = "no-last-column",
           .defect = "the last column skipped",
           .diagnosis = "no-last-column",
           .oracle = Oracle::reference,
           .distribution = "no-last-column"},
    Mutant{.name = "no-last-row",
           .defect = "the last row skipped",
           .diagnosis = "no-last-row",
           .oracle = Oracle::reference,
           .distribution = "no-last-row"},
    Mutant{.name = "gamma-left-in",
           .defect = "the values of a gamma-encoded map taken as they are",
           .diagnosis = "gamma",
           .oracle = Oracle::reference,
           .distribution = "gamma"},
    Mutant{.name = "sun-clamped",
           .defect = "values clamped at sixteen times the mean",
           .diagnosis = "clamped",
           .oracle = Oracle::reference,
           .distribution = "clamped"},
    Mutant{.name = "rows-alike",
           .defect = "rows drawn uniformly",
           .diagnosis = "rows-alike",
           .oracle = Oracle::reference,
           .distribution = "rows-alike"},
    Mutant{.name = "same-u",
           .defect = "one random number for both dimensions",
           .diagnosis = "same-number",
           .oracle = Oracle::reference,
           .numbers =
               [](std::span<const SquarePoint> batch, std::size_t i) {
                 return SquarePoint{batch[i].t, batch[i].t};
               }},
    Mutant{.name = "uniform-in-sample",
           .defect = "1 % uniform samples that pdf() does not know",
           .diagnosis = "uniform-mixed-in",
           .oracle = Oracle::self,
           .sample =
               [](TexelSample& s, const DiscreteSampler& distribution) {
                 // Every hundredth of the positions inside a texel goes to a position chosen by its
                 // digits.
                 const double within = s.at.s * distribution.extent().width - s.x;
                 const double stretched = within * 100.0;
                 if (stretched >= 1.0) return;
                 const double across = stretched * distribution.extent().width;
                 const double down = (across - std::floor(across)) * distribution.extent().height;
                 s.x = static_cast<int>(across);
                 s.y = static_cast<int>(down);
                 s.at = {position_in_cell(s.x, 0.5, distribution.extent().width),
                         position_in_cell(s.y, 0.5, distribution.extent().height)};
               }},
    Mutant{.name = "16-bit-random",
           .defect = "random numbers of 16 bits",
           .diagnosis = "coarse-numbers",
           .oracle = Oracle::check,
           .numbers =
               [](std::span<const SquarePoint> batch, std::size_t i) {
                 return SquarePoint{coarse(batch[i].s), coarse(batch[i].t)};
               }},
    Mutant{.name = "16-bit-conditional",
           .defect = "random numbers of 16 bits for the columns only",
           .diagnosis = "coarse-numbers",
           .oracle = Oracle::check,
           .numbers =
               [](std::span<const SquarePoint> batch, std::size_t i) {
                 return SquarePoint{coarse(batch[i].s), batch[i].t};
               }},
    Mutant{.name = "pi-squared",
           .defect = "pi^2 sin(theta) for 2 pi^2 sin(theta)",
           .diagnosis = "pdf-scaled",
           .oracle = Oracle::check,
           .pdf_factor = [](const DiscreteSampler&) { return 2.0; }},
    Mutant{.name = "sum-for-average",
           .defect = "divided by the sum where the average belongs",
           .diagnosis = "pdf-scaled",
           .oracle = Oracle::check,
           .pdf_factor =
               [](const DiscreteSampler& distribution) {
                 return 1.0 / static_cast<double>(distribution.extent().count());
               }},
    Mutant{.name = "lower-bound",
           .defect =
               "lower for upper bound: u on equal CDF entries gives the first of them, lit or not",
           .diagnosis = "wrong-at-cdf-entries",
           .oracle = Oracle::check,
           .needs = "texels without light",
           .draw =
               [](const DiscreteSampler& distribution, SquarePoint u) {
                 const int row = lower_bound_of(distribution.rows(), u.t);
                 const int column = lower_bound_of(distribution.columns().row(row), u.s);
                 const TexelSample upper = distribution.sample(u);
                 if (upper.x == column && upper.y == row) return upper;
                 const SquarePoint at = {position_in_cell(column, 1.0, distribution.extent().width),
                                         position_in_cell(row, 1.0, distribution.extent().height)};
                 return TexelSample{at, column, row, distribution.pdf(at)};
               }},
    Mutant{.name = "cdf-ends-early",
           .defect = "the sums of a row end a millionth below 1: the rest runs off the map",
           .diagnosis = "off-the-map",
           .oracle = Oracle::check,
           .draw =
               [](const DiscreteSampler& distribution, SquarePoint u) {
                 constexpr double kEnd = 1.0 - 0x1p-20;
                 TexelSample drawn = distribution.sample({std::min(u.s / kEnd, kEnd), u.t});
                 if (u.s >= kEnd) drawn.x = distribution.extent().width;
                 return drawn;
               }},
    Mutant{.name = "phi-wrap",
           .defect = "phi in [0, 2 pi) taken for phi in [-pi, pi)",
           .diagnosis = "half-turn",
           .oracle = Oracle::reference,
           .distribution = "half-turn"},
    Mutant{.name = "half-texel",
           .defect = "half a texel added in sample() only",
           .diagnosis = "half-texel",
           .oracle = Oracle::self,
           .sample =
               [](TexelSample& s, const DiscreteSampler& distribution) {
                 s.at.s = std::fmod(s.at.s + 0.5 / distribution.extent().width, 1.0);
                 s.x = cell_of(s.at.s, distribution.extent().width);
               }},
    Mutant{.name = "first-row-at-zero",
           .defect = "u = 0 gives row 0, lit or not",
           .diagnosis = "wrong-at-cdf-entries",
           .oracle = Oracle::check,
           .needs = "a first row without light",
           .draw =
               [](const DiscreteSampler& distribution, SquarePoint u) {
                 TexelSample drawn = distribution.sample(u);
                 if (u.t > 0.0) return drawn;
                 drawn.at.t = position_in_cell(0, 0.0, distribution.extent().height);
                 drawn.y = 0;
                 drawn.pdf = distribution.pdf(drawn.at);
                 return drawn;
               }},
    Mutant{.name = "nan-at-pole",
           .defect = "0/0 in the rows of the poles",
           .diagnosis = "off-the-map",
           .oracle = Oracle::check,
           .sample =
               [](TexelSample& s, const DiscreteSampler& distribution) {
                 if (is_pole_row(s, distribution))
                   s.pdf = {std::numeric_limits<double>::quiet_NaN()};
               }},
    Mutant{.name = "interpolated-in-u",
           .defect = "the position in the texel is that of u, not of the rest of its mass",
           .diagnosis = "uneven-in-texel",
           .oracle = Oracle::reference,
           .sample =
               [](TexelSample& s, const DiscreteSampler& distribution) {
                 const double within = s.at.s * distribution.extent().width - s.x;
                 s.at.s = position_in_cell(s.x, within * within, distribution.extent().width);
               }},
    Mutant{.name = "rotated-in-both",
           .defect = "a quarter turn of the map applied forwards in sample and pdf",
           .diagnosis = "quarter-turn",
           .oracle = Oracle::reference,
           .distribution = "quarter-turn"},
    Mutant{.name = "rows-below-threshold",
           .defect = "rows darker than 1e-4 skipped, whatever the exposure",
           .diagnosis = "dim-rows-skipped",
           .oracle = Oracle::reference,
           .needs = "rows darker than 1e-4",
           .distribution = "dim-rows-skipped"},
    Mutant{.name = "pole-row-negative",
           .defect = "the row of the pole gets a weight slightly below zero",
           .diagnosis = "no-first-row",
           .oracle = Oracle::reference,
           .distribution = "no-first-row"},
    Mutant{.name = "abs-of-negative",
           .defect = "abs() of values below zero: texels without light get a little weight",
           .diagnosis = "dark-texels-drawn",
           .oracle = Oracle::check,
           .needs = "texels without light",
           .distribution = "dark-texels-drawn"},
    Mutant{.name = "s-from-last-t",
           .defect = "s of every sample drawn with the number of the t before it",
           .diagnosis = "dependent-samples",
           .oracle = Oracle::reference,
           .numbers =
               [](std::span<const SquarePoint> batch, std::size_t i) {
                 return SquarePoint{i > 0 ? batch[i - 1].t : batch[i].s, batch[i].t};
               }},
    Mutant{.name = "antithetic",
           .defect = "every second sample antithetic to the one before it",
           .diagnosis = "dependent-samples",
           .oracle = Oracle::reference,
           .numbers =
               [](std::span<const SquarePoint> batch, std::size_t i) {
                 if (i % 2 == 0) return batch[i];
                 constexpr double kLast = 1.0 - 0x1p-53;
                 return SquarePoint{kLast - batch[i - 1].s, kLast - batch[i - 1].t};
               }},
    Mutant{.name = "one-texel-missing",
           .defect = "one texel of six times the median set to zero in the table and in pdf()",
           .diagnosis = "one-texel-missing",
           .oracle = Oracle::check,
           .distribution = "one-texel-missing"},
    Mutant{.name = "other-rows-at-poles",
           .defect = "in the rows of the poles uniform in cos(theta) where t is declared, or in t",
           .diagnosis = "uneven-in-texel",
           .oracle = Oracle::reference,
           .sample =
               [](TexelSample& s, const DiscreteSampler& distribution) {
                 if (!is_pole_row(s, distribution)) return;
                 const int height = distribution.extent().height;
                 const double within = s.at.t * height - s.y;
                 // A row of the poles counted from the pole: its solid angle grows with the square
                 // of the angle there.
                 const double from_pole = 2 * s.y < height ? within : 1.0 - within;
                 const double moved = distribution.density_space() == DensitySpace::texture
                                          ? std::sqrt(from_pole)
                                          : from_pole * from_pole;
                 s.at.t = position_in_cell(s.y, 2 * s.y < height ? moved : 1.0 - moved, height);
                 s.pdf = distribution.pdf(s.at);
               }},
    // Of our own.
    Mutant{.name = "columns-of-next-row",
           .defect = "columns drawn from the next row's sums",
           .diagnosis = "columns-of-next-row",
           .oracle = Oracle::reference,
           .distribution = "columns-of-next-row"},
    Mutant{.name = "row-off-by-one",
           .defect = "every row drawn for the one below it",
           .diagnosis = "row-late",
           .oracle = Oracle::reference,
           .distribution = "row-late"},
    Mutant{.name = "sine-twice",
           .defect = "sin(theta) in the table and again in the search",
           .diagnosis = "sine-twice",
           .oracle = Oracle::reference,
           .distribution = "sine-twice"},
    Mutant{.name = "squared",
           .defect = "luminance squared: weighted twice",
           .diagnosis = "squared",
           .oracle = Oracle::reference,
           .distribution = "squared"},
    Mutant{.name = "map-ignored",
           .defect = "uniform samples, uniform density",
           .diagnosis = "uniform",
           .oracle = Oracle::reference,
           .distribution = "uniform"},
    Mutant{.name = "texel-centres",
           .defect = "always the centre of the texel",
           .diagnosis = "uneven-in-texel",
           .oracle = Oracle::reference,
           .sample =
               [](TexelSample& s, const DiscreteSampler& distribution) {
                 s.at = {position_in_cell(s.x, 0.5, distribution.extent().width),
                         position_in_cell(s.y, 0.5, distribution.extent().height)};
                 s.pdf = distribution.pdf(s.at);
               }},
    Mutant{.name = "pdf-of-neighbour",
           .defect = "the density of the next column returned",
           .diagnosis = "pdf-of-another-position",
           .oracle = Oracle::check,
           .sample =
               [](TexelSample& s, const DiscreteSampler& distribution) {
                 const double s_next = std::fmod(s.at.s + 1.0 / distribution.extent().width, 1.0);
                 const PerSquare next = distribution.pdf({s_next, s.at.t});
                 if (next.value > 0.0) s.pdf = next;
               }},
    Mutant{
        .name = "pdf-per-steradian",
        .defect = "a density per steradian returned as one over the square",
        .diagnosis = "pdf-of-another-measure",
        .oracle = Oracle::check,
        .sample = [](TexelSample& s,
                     const DiscreteSampler&) { s.pdf = {to_solid_angle(s.pdf, s.at).value}; },
        .pdf =
            [](const DiscreteSampler& distribution, SquarePoint at) {
              return PerSquare{to_solid_angle(distribution.pdf(at), at).value};
            }},
    Mutant{.name = "pdf-upside-down",
           .defect = "t flipped in pdf() only",
           .diagnosis = "upside-down",
           .oracle = Oracle::check,
           .pdf = [](const DiscreteSampler& distribution,
                     SquarePoint at) { return distribution.pdf(upside_down(at)); }},
    Mutant{.name = "noisy-weights",
           .defect = "densities 10 % too small and too large by turns",
           .diagnosis = "pdf-mismatch",
           .oracle = Oracle::check,
           .sample =
               [](TexelSample& s, const DiscreteSampler&) {
                 s.pdf = times(s.pdf, s.x % 2 == 0 ? 1.0 / 1.1 : 1.0 / 0.9);
               }},
    Mutant{.name = "weights-2-percent-off",
           .defect = "densities 2 % too large, in both",
           .diagnosis = "pdf-scaled",
           .oracle = Oracle::check,
           .pdf_factor = [](const DiscreteSampler&) { return 1.02; }},
    Mutant{.name = "repeated-numbers",
           .defect = "every random number used four times",
           .diagnosis = "repeated-numbers",
           .oracle = Oracle::reference,
           .numbers = [](std::span<const SquarePoint> batch,
                         std::size_t i) { return batch[i - i % 4]; }},
    Mutant{.name = "stratified",
           .defect = "jittered points, one in each of 32x32 strata, passed off as independent",
           .diagnosis = "stratified",
           .oracle = Oracle::reference,
           .numbers =
               [](std::span<const SquarePoint> batch, std::size_t i) {
                 constexpr std::size_t kStrata = 32;
                 return SquarePoint{
                     (static_cast<double>(i % kStrata) + batch[i].s) / kStrata,
                     (static_cast<double>(i / kStrata % kStrata) + batch[i].t) / kStrata};
               }},
    Mutant{.name = "one-texel-moved",
           .defect = "one texel's samples go to its neighbour",
           .diagnosis = "one-texel",
           .oracle = Oracle::reference,
           .sample =
               [](TexelSample& s, const DiscreteSampler& distribution) {
                 const Extent map = distribution.extent();
                 const TexelSample& one = distribution.median();
                 if (s.x != one.x || s.y != one.y) return;
                 move_by(s, map, s.x + 1 < map.width ? 1 : -1, 0);
               }},
};

}  // namespace

std::span<const Mutant> mutants() { return kMutants; }

}  // namespace lightproof
