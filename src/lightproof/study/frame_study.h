// How far frames are from orthonormal next to the poles, for the report.
#pragma once

#include <vector>

#include "lightproof/results/frame_record.h"

namespace lightproof {

/// Every construction of warp/frame_errors.h, in float and double, around both poles, at distances
/// from 1e-12 to pi/2 radians, four a decade.
std::vector<FrameErrorRecord> study_frames();

}  // namespace lightproof
