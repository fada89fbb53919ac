// How many rows a prefiltered map needs: no more than its lobe and the light ask for.
#pragma once

#include <optional>

#include "lightproof/prefilter/lobe.h"
#include "lightproof/recommend/map_summary.h"

namespace lightproof {

/// A bound of the root mean square error over directions of a latitude-longitude map of so many
/// rows (at least 2), prefiltered by a lobe and looked up bilinearly, relative to its mean: what it
/// holds of harmonics beyond the degree rows/2 - 1, and h^2/8 times the root mean square of its
/// Laplacian, h the height of a row. Up to the summary's degree the map's power is exact; beyond,
/// it is spread over degrees in the worst way that the map's ∫ L^2 and that no light is negative
/// allow: degree l has at most that of a single point, (2l+1)/4pi (∫ L)^2.
double prefiltered_error(const MapSummary& summary, const Lobe& lobe, int rows);

/// The least number of rows, even ones from 2 on, whose error by this bound is at most the given
/// one, relative to the mean. Nothing if more than 2048 are needed.
std::optional<int> rows_needed(const MapSummary& summary, const Lobe& lobe, double error);

}  // namespace lightproof
