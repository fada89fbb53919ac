// The frame and the measure in which another program's samples are given.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "lightproof/core/direction.h"
#include "lightproof/warp/preset.h"

namespace lightproof {

/// Which of another program's axes each of Lightproof's is, and its sign: a rotation by right
/// angles, or one with a mirror image.
class AxisMap {
 public:
  /// Axes as they are.
  AxisMap() = default;
  /// Reads "x,-z,y": Lightproof's x, y and z (up), each one of the other program's axes or its
  /// opposite. Throws InputError unless each axis is there once.
  static AxisMap parse(std::string_view text);
  /// All 48, the axes as they are first.
  static const std::array<AxisMap, 48>& all();

  Direction operator()(Direction theirs) const {
    const double parts[] = {theirs.x, theirs.y, theirs.z};
    return {sign_[0] * parts[axis_[0]], sign_[1] * parts[axis_[1]], sign_[2] * parts[axis_[2]]};
  }

  /// The axes of what `first` gives, taken by this one.
  AxisMap after(const AxisMap& first) const;

  /// What takes Lightproof's axes back to theirs.
  AxisMap inverse() const;

  /// "x,-z,y".
  std::string text() const;
  /// Whether it turns right-handed axes into left-handed ones.
  bool mirrors() const;
  friend bool operator==(const AxisMap&, const AxisMap&) = default;

 private:
  static std::array<AxisMap, 48> make_all();

  std::array<int, 3> axis_ = {0, 1, 2};
  std::array<int, 3> sign_ = {1, 1, 1};
};

/// The axes of the renderers that a preset is named after: its directions, as Lightproof's.
AxisMap axes_of(Preset preset);

/// What a density is per.
enum class DensityMeasure {
  solid_angle,  ///< steradian
  square,       ///< area of the image, whose sides are 1
};

/// What must be known of samples beside their numbers.
struct SampleConvention {
  /// From the axes of the directions, given or named by image coordinates, to Lightproof's.
  AxisMap axes;
  /// By which image coordinates are directions, and densities over the image are ones over
  /// directions.
  Preset preset = Preset::z_up;
  DensityMeasure measure = DensityMeasure::solid_angle;
};

}  // namespace lightproof
