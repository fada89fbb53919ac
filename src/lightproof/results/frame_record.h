// How far frames around a normal are from orthonormal.
#pragma once

#include <string>

namespace lightproof {

/// One construction of frames at one distance of the normal from a pole.
struct FrameErrorRecord {
  std::string construction;
  std::string source;     ///< paper or book
  bool is_float = false;  ///< else double
  bool is_nadir = false;  ///< around -z, else around +z
  double distance = 0.0;  ///< of the normal from that pole, in radians
  double error = 0.0;  ///< largest entry of |M^T M - 1| of all normals there; NaN if one is not a
                       ///< number
};

}  // namespace lightproof
