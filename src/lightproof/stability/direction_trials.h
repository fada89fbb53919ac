// What hard inputs do to samplers of directions: warps of the hemisphere, lobes of materials, and
// frames around a normal. Each is named after its case.
#pragma once

#include <span>

#include "lightproof/stability/stability_case.h"

namespace lightproof {

/// What is wrong with a drawn direction: it is no unit vector, its density is not finite or, where
/// it must be positive, is not; empty if nothing is.
std::string_view fault_of(const DrawnDirection& drawn, bool must_be_positive);

/// Whether a lobe draws and knows its density at this roughness, seen at this cosine from the
/// normal: at the ends of the random numbers' range and at points in between directions are unit
/// vectors of a positive, finite density, and the density asked for is that one to 1e-4.
Finding check_lobe(const LobeMethod& method, double roughness, double view_cosine);

namespace trials {

Finding zero_numbers(const DirectionSamplerInfo& method, const TrialOptions& options);
Finding numbers_next_to_one(const DirectionSamplerInfo& method, const TrialOptions& options);
Finding round_trip(const DirectionSamplerInfo& method, const TrialOptions& options);

Finding zero_numbers(const LobeMethod& method, const TrialOptions& options);
Finding numbers_next_to_one(const LobeMethod& method, const TrialOptions& options);
Finding exact_poles(const LobeMethod& method, const TrialOptions& options);
Finding round_trip(const LobeMethod& method, const TrialOptions& options);
Finding roughness_zero(const LobeMethod& method, const TrialOptions& options);
Finding little_roughness(const LobeMethod& method, const TrialOptions& options);
Finding grazing_view(const LobeMethod& method, const TrialOptions& options);

Finding axes(const FrameMethod& method, const TrialOptions& options);

}  // namespace trials
}  // namespace lightproof
