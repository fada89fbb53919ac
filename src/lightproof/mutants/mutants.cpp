// The table of mutants: those of the literature and of old bug reports first, then mistakes that a
// tired programmer makes.
#include <array>
#include <cmath>
#include <limits>

#include "lightproof/mutants/mutant.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// Moves a sample to another texel, to the same place inside it.
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

bool is_pole_row(const TexelSample& sample, const LawSampler& law) {
  return sample.y == 0 || sample.y == law.extent().height - 1;
}

constexpr std::array kMutants = {
    Mutant{"no-sine", "the rows' solid angle forgotten (or applied where it should not be)",
           "other-weighting", "reference", "other-weighting"},
    Mutant{"sine-at-edge", "sin(theta) at y/H", "sine-at-edge", "reference", "sine-at-edge"},
    Mutant{"sine-to-last-row", "sin(theta) at y/(H-1)", "sine-to-last-row", "reference",
           "sine-to-last-row"},
    Mutant{"column-off-by-one", "every column drawn for its neighbour", "column-late", "reference",
           "column-late"},
    Mutant{"t-flipped-in-sample",
           "t flipped in sample() only",
           "upside-down",
           "self",
           {},
           nullptr,
           [](TexelSample& s, const LawSampler& law) { flip_t(s, law.extent()); }},
    Mutant{"t-flipped-in-both", "t flipped in sample() and pdf()", "upside-down", "reference",
           "upside-down"},
    Mutant{"u-mirrored", "s mirrored in both", "mirrored", "reference", "mirrored"},
    Mutant{"other-grey", "the lecture's grey weights where Rec. 709 is declared", "other-grey",
           "reference", "other-grey"},
    Mutant{"average-grey", "the average of R, G and B", "average-grey", "reference",
           "average-grey"},
    Mutant{"bgr", "R and B swapped", "swapped-channels", "reference", "swapped-channels"},
    Mutant{"no-last-column", "the last column skipped", "no-last-column", "reference",
           "no-last-column"},
    Mutant{"no-last-row", "the last row skipped", "no-last-row", "reference", "no-last-row"},
    Mutant{"gamma-left-in", "the values of a gamma-encoded map taken as they are", "gamma",
           "reference", "gamma"},
    Mutant{"sun-clamped", "values clamped at sixteen times the mean", "clamped", "reference",
           "clamped"},
    Mutant{"rows-alike", "rows drawn uniformly", "rows-alike", "reference", "rows-alike"},
    Mutant{"same-u",
           "one random number for both dimensions",
           "same-number",
           "reference",
           {},
           [](std::span<const SquarePoint> batch, std::size_t i) {
             return SquarePoint{batch[i].t, batch[i].t};
           }},
    Mutant{"uniform-in-sample",
           "1 % uniform samples that pdf() does not know",
           "uniform-mixed-in",
           "self",
           {},
           nullptr,
           [](TexelSample& s, const LawSampler& law) {
             // Every hundredth of the places inside a texel goes to a place chosen by its digits.
             const double within = s.at.s * law.extent().width - s.x;
             const double again = within * 100.0;
             if (again >= 1.0) return;
             const double across = again * law.extent().width;
             const double down = (across - std::floor(across)) * law.extent().height;
             s.x = static_cast<int>(across);
             s.y = static_cast<int>(down);
             s.at = {place_in_cell(s.x, 0.5, law.extent().width),
                     place_in_cell(s.y, 0.5, law.extent().height)};
           }},
    Mutant{"16-bit-random",
           "random numbers of 16 bits",
           "coarse-numbers",
           "check",
           {},
           [](std::span<const SquarePoint> batch, std::size_t i) {
             return SquarePoint{coarse(batch[i].s), coarse(batch[i].t)};
           }},
    Mutant{"pi-squared",
           "pi^2 sin(theta) for 2 pi^2 sin(theta)",
           "pdf-scaled",
           "check",
           {},
           nullptr,
           nullptr,
           nullptr,
           [](const LawSampler&) { return 2.0; }},
    Mutant{"sum-for-average",
           "divided by the sum where the average belongs",
           "pdf-scaled",
           "check",
           {},
           nullptr,
           nullptr,
           nullptr,
           [](const LawSampler& law) { return 1.0 / static_cast<double>(law.extent().count()); }},
    Mutant{"lower-bound",
           "the lower bound at equal knots: u on a knot gives the texel before",
           "wrong-at-knots",
           "check",
           {},
           nullptr,
           [](TexelSample& s, const LawSampler& law) {
             // Right at a knot the place is the lower end of its row.
             const double within = s.at.t * law.extent().height - s.y;
             if (s.y > 0 && within <= 2.0 * kCellMargin) s.y -= 1;
           }},
    Mutant{"cdf-ends-early",
           "the last sum is below 1: the rest runs off the map",
           "off-the-map",
           "check",
           {},
           nullptr,
           [](TexelSample& s, const LawSampler& law) {
             const double within = s.at.s * law.extent().width - s.x;
             if (within < 1e-4) s.x = law.extent().width;
           }},
    Mutant{"phi-wrap", "phi in [0, 2 pi) taken for phi in [-pi, pi)", "half-turn", "reference",
           "half-turn"},
    Mutant{"half-texel",
           "half a texel added in sample() only",
           "half-texel",
           "self",
           {},
           nullptr,
           [](TexelSample& s, const LawSampler& law) {
             s.at.s = std::fmod(s.at.s + 0.5 / law.extent().width, 1.0);
             s.x = cell_of(s.at.s, law.extent().width);
           }},
    Mutant{"first-row-at-zero",
           "u = 0 gives row 0, lit or not",
           "wrong-at-knots",
           "check",
           {},
           nullptr,
           [](TexelSample& s, const LawSampler& law) {
             const double within = s.at.t * law.extent().height - s.y;
             const bool first = s.y == 0 || law.rows()[static_cast<std::size_t>(s.y) - 1] == 0.0;
             if (!first || within > 2.0 * kCellMargin) return;
             s.at.t = place_in_cell(0, 0.0, law.extent().height);
             s.y = 0;
             s.pdf = law.pdf(s.at);
           }},
    Mutant{"nan-at-pole",
           "0/0 in the rows of the poles",
           "off-the-map",
           "check",
           {},
           nullptr,
           [](TexelSample& s, const LawSampler& law) {
             if (is_pole_row(s, law)) s.pdf = {std::numeric_limits<double>::quiet_NaN()};
           }},
    Mutant{"interpolated-in-u",
           "the place in the texel is that of u, not of the rest of its mass",
           "uneven-in-texel",
           "reference",
           {},
           nullptr,
           [](TexelSample& s, const LawSampler& law) {
             const double within = s.at.s * law.extent().width - s.x;
             s.at.s = place_in_cell(s.x, within * within, law.extent().width);
           }},
    Mutant{"rotated-in-both", "a quarter turn of the map applied forwards in sample and pdf",
           "quarter-turn", "reference", "quarter-turn"},
    Mutant{"rows-below-threshold", "rows darker than 1e-4 skipped, whatever the exposure",
           "dim-rows-skipped", "reference", "dim-rows-skipped"},
    Mutant{"pole-row-negative", "the row of the pole gets a weight slightly below zero",
           "no-first-row", "reference", "no-first-row"},
    // Of our own.
    Mutant{"columns-of-next-row", "columns drawn from the next row's sums", "columns-of-next-row",
           "reference", "columns-of-next-row"},
    Mutant{"row-off-by-one", "every row drawn for the one below it", "row-late", "reference",
           "row-late"},
    Mutant{"sine-twice", "sin(theta) in the table and again in the search", "sine-twice",
           "reference", "sine-twice"},
    Mutant{"squared", "grey squared: weighted twice", "squared", "reference", "squared"},
    Mutant{"map-ignored", "uniform samples, uniform density", "uniform", "reference", "uniform"},
    Mutant{"texel-centres",
           "always the centre of the texel",
           "uneven-in-texel",
           "reference",
           {},
           nullptr,
           [](TexelSample& s, const LawSampler& law) {
             s.at = {place_in_cell(s.x, 0.5, law.extent().width),
                     place_in_cell(s.y, 0.5, law.extent().height)};
             s.pdf = law.pdf(s.at);
           }},
    Mutant{"pdf-of-neighbour",
           "the density of the next column returned",
           "pdf-of-another-place",
           "check",
           {},
           nullptr,
           [](TexelSample& s, const LawSampler& law) {
             const double s_next = std::fmod(s.at.s + 1.0 / law.extent().width, 1.0);
             const PerSquare next = law.pdf({s_next, s.at.t});
             if (next.value > 0.0) s.pdf = next;
           }},
    Mutant{"pdf-per-steradian",
           "a density per steradian returned as one over the square",
           "pdf-of-another-measure",
           "check",
           {},
           nullptr,
           [](TexelSample& s, const LawSampler&) { s.pdf = {to_solid_angle(s.pdf, s.at).value}; },
           [](const LawSampler& law, SquarePoint at) {
             return PerSquare{to_solid_angle(law.pdf(at), at).value};
           }},
    Mutant{"pdf-upside-down",
           "t flipped in pdf() only",
           "upside-down",
           "check",
           {},
           nullptr,
           nullptr,
           [](const LawSampler& law, SquarePoint at) { return law.pdf(upside_down(at)); }},
    Mutant{"noisy-weights",
           "densities 10 % too small and too large by turns",
           "noisy-pdf",
           "check",
           {},
           nullptr,
           [](TexelSample& s, const LawSampler&) {
             s.pdf = times(s.pdf, s.x % 2 == 0 ? 1.0 / 1.1 : 1.0 / 0.9);
           }},
    Mutant{"weights-2-percent-off",
           "densities 2 % too large, in both",
           "pdf-scaled",
           "check",
           {},
           nullptr,
           nullptr,
           nullptr,
           [](const LawSampler&) { return 1.02; }},
    Mutant{"repeated-numbers",
           "every random number used four times",
           "repeated-numbers",
           "reference",
           {},
           [](std::span<const SquarePoint> batch, std::size_t i) { return batch[i - i % 4]; }},
    Mutant{"stratified",
           "jittered points, one in each of 32x32 strata, passed off as independent",
           "stratified",
           "reference",
           {},
           [](std::span<const SquarePoint> batch, std::size_t i) {
             constexpr std::size_t kStrata = 32;
             return SquarePoint{
                 (static_cast<double>(i % kStrata) + batch[i].s) / kStrata,
                 (static_cast<double>(i / kStrata % kStrata) + batch[i].t) / kStrata};
           }},
    Mutant{"one-texel-moved",
           "one texel's samples go to its neighbour",
           "one-place",
           "reference",
           {},
           nullptr,
           [](TexelSample& s, const LawSampler& law) {
             const Extent map = law.extent();
             const TexelSample& one = law.median();
             if (s.x != one.x || s.y != one.y) return;
             move_by(s, map, s.x + 1 < map.width ? 1 : -1, 0);
           }},
};

}  // namespace

std::span<const Mutant> mutants() { return kMutants; }

}  // namespace lightproof
