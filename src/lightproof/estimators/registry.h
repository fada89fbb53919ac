// All estimators, in one table: the study, the lists and the tests iterate over it.
#pragma once

#include <span>
#include <string_view>

#include "lightproof/estimators/estimator.h"

namespace lightproof {

/// All estimators, in the order in which they are shown.
std::span<const EstimatorInfo> estimators();

/// The estimator of this name. Throws InputError, which lists the names, if there is none.
const EstimatorInfo& estimator_by_name(std::string_view name);

}  // namespace lightproof
