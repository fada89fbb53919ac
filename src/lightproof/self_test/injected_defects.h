// What mutants do that is no distribution of its own: to their random numbers, in place of drawing,
// to what was drawn, and to their densities. The names are those of the table in mutants.cpp.
#pragma once

#include <cstddef>
#include <span>

#include "lightproof/gate/discrete_sampler.h"

namespace lightproof::defects {

// Random numbers that a mutant uses in place of the i-th point of a batch.

/// The point's t for both coordinates.
SquarePoint t_for_both(std::span<const SquarePoint> batch, std::size_t i);
/// The first 16 bits of both coordinates.
SquarePoint sixteen_bits(std::span<const SquarePoint> batch, std::size_t i);
/// The first 16 bits of s, and all of t.
SquarePoint sixteen_bits_of_s(std::span<const SquarePoint> batch, std::size_t i);
/// The t of the point before as s.
SquarePoint s_from_last_t(std::span<const SquarePoint> batch, std::size_t i);
/// Every second point mirrored from the one before it.
SquarePoint antithetic_to_the_one_before(std::span<const SquarePoint> batch, std::size_t i);
/// Every fourth point, four times.
SquarePoint each_four_times(std::span<const SquarePoint> batch, std::size_t i);
/// The points moved into 32 x 32 strata in turn.
SquarePoint jittered(std::span<const SquarePoint> batch, std::size_t i);

// Samples that a mutant draws in place of DiscreteSampler::sample.

/// A sample of the first cell whose CDF entry is not below u, as std::lower_bound finds it.
TexelSample draw_by_lower_bound(const DiscreteSampler& distribution, SquarePoint u);
/// A sample from sums of columns that end 2^-20 below 1, beside the map beyond that.
TexelSample draw_from_sums_that_end_early(const DiscreteSampler& distribution, SquarePoint u);
/// A sample that lies in row 0 if u.t is 0, lit or not.
TexelSample draw_first_row_at_zero(const DiscreteSampler& distribution, SquarePoint u);

// What a mutant does to a sample that was drawn.

/// Turns the sample's t upside down.
void flip_t(TexelSample& sample, const DiscreteSampler& distribution);
/// Sends every hundredth of the positions inside a texel anywhere on the map.
void mix_in_uniform_samples(TexelSample& sample, const DiscreteSampler& distribution);
/// Moves the sample to the right by half a texel.
void add_half_a_texel(TexelSample& sample, const DiscreteSampler& distribution);
/// Makes the density NaN in the rows of the poles.
void lose_pdf_in_pole_rows(TexelSample& sample, const DiscreteSampler& distribution);
/// Squares the position over s inside the texel.
void square_position_in_texel(TexelSample& sample, const DiscreteSampler& distribution);
/// Makes the position in the rows of the poles uniform in cos(theta) where t is declared, or in t.
void change_measure_in_pole_rows(TexelSample& sample, const DiscreteSampler& distribution);
/// Makes the position in every row uniform in cos(theta) where t is declared, or in t, exactly.
void change_measure(TexelSample& sample, const DiscreteSampler& distribution);
/// Moves the sample to the centre of its texel.
void move_to_centre(TexelSample& sample, const DiscreteSampler& distribution);
/// Gives the sample the density of the next column, if that has any.
void return_pdf_of_next_column(TexelSample& sample, const DiscreteSampler& distribution);
/// Gives the sample its density per steradian as if it were one over the square.
void return_pdf_per_steradian(TexelSample& sample, const DiscreteSampler& distribution);
/// Makes the density too small by 10 % in every even column, and too large in every odd one.
void make_pdf_noisy(TexelSample& sample, const DiscreteSampler& distribution);
/// Moves the samples of one texel to its neighbour.
void move_one_texel(TexelSample& sample, const DiscreteSampler& distribution);

// Densities that a mutant gives in place of DiscreteSampler::pdf.

/// The density per steradian as if it were one over the square.
PerSquare pdf_per_steradian(const DiscreteSampler& distribution, SquarePoint at);
/// The density at the position mirrored in t.
PerSquare pdf_upside_down(const DiscreteSampler& distribution, SquarePoint at);

}  // namespace lightproof::defects
