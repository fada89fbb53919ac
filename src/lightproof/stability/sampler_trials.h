// What hard inputs do to samplers of environment maps; each named after its case.
#pragma once

#include "lightproof/stability/stability_case.h"

namespace lightproof::trials {

Finding one_bright_texel(const SamplerUnderTest& method, const TrialOptions& options);
Finding own_filter(const SamplerUnderTest& method, const TrialOptions& options);
Finding black_map(const SamplerUnderTest& method, const TrialOptions& options);
Finding nan_texel(const SamplerUnderTest& method, const TrialOptions& options);
Finding infinite_texel(const SamplerUnderTest& method, const TrialOptions& options);
Finding negative_texel(const SamplerUnderTest& method, const TrialOptions& options);
Finding constant_map(const SamplerUnderTest& method, const TrialOptions& options);
Finding leading_zeros_at_zero(const SamplerUnderTest& method, const TrialOptions& options);
Finding numbers_next_to_one(const SamplerUnderTest& method, const TrialOptions& options);
Finding zero_row_inside(const SamplerUnderTest& method, const TrialOptions& options);
Finding trailing_zeros(const SamplerUnderTest& method, const TrialOptions& options);
Finding wide_constant_map(const SamplerUnderTest& method, const TrialOptions& options);
Finding sun_over_sky(const SamplerUnderTest& method, const TrialOptions& options);
Finding pole_rows(const SamplerUnderTest& method, const TrialOptions& options);
Finding exact_poles(const SamplerUnderTest& method, const TrialOptions& options);
Finding round_trip(const SamplerUnderTest& method, const TrialOptions& options);
Finding inside_the_texel(const SamplerUnderTest& method, const TrialOptions& options);
Finding seam(const SamplerUnderTest& method, const TrialOptions& options);
Finding exposure(const SamplerUnderTest& method, const TrialOptions& options);
Finding rotation(const SamplerUnderTest& method, const TrialOptions& options);
Finding orientation(const SamplerUnderTest& method, const TrialOptions& options);
Finding odd_sizes(const SamplerUnderTest& method, const TrialOptions& options);
Finding pure_colours(const SamplerUnderTest& method, const TrialOptions& options);
Finding denormal_map(const SamplerUnderTest& method, const TrialOptions& options);
Finding rebuilt_probabilities(const SamplerUnderTest& method, const TrialOptions& options);
Finding two_maps(const SamplerUnderTest& method, const TrialOptions& options);

}  // namespace lightproof::trials
