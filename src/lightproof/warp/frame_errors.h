// How far the frames of warp/frames.h are from orthonormal, near the poles.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "lightproof/warp/frames.h"

namespace lightproof {

/// A construction of frames by its name.
struct FrameConstruction {
  std::string_view name;
  std::string_view source;  ///< paper or book
  FrameOf<float> (*in_float)(UnitVector<float> normal);
  FrameOf<double> (*in_double)(UnitVector<double> normal);
  std::string_view defect = {};  ///< what is known to be wrong with it; empty if nothing
};

std::span<const FrameConstruction> frame_constructions();

/// Largest entry of |M^T M - I|, M = (tangent, bitangent, normal), computed in long double; not a
/// number if an entry of M is not.
double orthonormality_error(const FrameOf<float>& frame);
double orthonormality_error(const FrameOf<double>& frame);

/// One point of a chart.
struct FrameError {
  std::string_view construction;  ///< name of a row of frame_constructions()
  bool is_float;                  ///< else double
  bool is_nadir;                  ///< around -z, else around +z
  double distance;                ///< of the normal from that pole, in radians
  double error;                   ///< the largest orthonormality_error of 64 normals on that circle
};

/// Every construction, in both precisions, around both poles, at every distance in [0, pi]; rows of
/// a line of the chart follow each other. Normals are rounded to the precision: without any loss
/// errors are some 1e-7 and 2e-16.
std::vector<FrameError> frame_errors(std::span<const double> distances);

}  // namespace lightproof
