// The reflectivity maps of project 004: a map prefiltered by half-vectors of Blinn's distribution
// at n = v, sample by sample and frame by frame, one roughness a level. As published, and mended.
#pragma once

#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/core/random.h"
#include "lightproof/prefilter/prefilter.h"
#include "lightproof/prefilter/progressive.h"
#include "lightproof/prefilter/specular_chain.h"

namespace lightproof {

/// The number of levels that the project proposes.
inline constexpr int kReflectivityLevels = 7;

/// Roughness of a level: (i + 1/2)/levels. The project sends i + 1/2 to the shader, which for i > 0
/// is beyond 1 and makes the shininess negative.
constexpr double reflectivity_roughness(int level, int levels = kReflectivityLevels) {
  return (level + 0.5) / levels;
}
constexpr double reflectivity_roughness_published(int level) { return level + 0.5; }

/// The level to look up for a roughness, the inverse of reflectivity_roughness: levels R - 1/2.
/// Below the first and beyond the last level the look-up clamps.
constexpr double level_of_reflectivity(double roughness, int levels = kReflectivityLevels) {
  return levels * roughness - 0.5;
}

/// Twice as wide as high. The project's text says height = 2 width, which would make every texel
/// four times as wide as high at the equator.
constexpr Extent reflectivity_extent(int width) { return {width, width / 2}; }
constexpr Extent reflectivity_extent_published(int width) { return {width, 2 * width}; }

/// The exact reflectivity maps: levels of reflectivity_roughness, from `extent` down, prefiltered
/// by the half-vector lobe. Throws InputError if the size has not so many levels.
SpecularChain reflectivity_chain(const Grid<Rgb>& map, Extent extent,
                                 int levels = kReflectivityLevels,
                                 GeometryTerm geometry = GeometryTerm::none,
                                 const PrefilterSettings& settings = {});

/// What the shader makes of two random numbers: a half-vector with cos(theta) = r^(1/(S+1)), and
/// the light that it mirrors in, both around +z.
struct HalfVectorDraw {
  double half_cosine;
  Direction light;
};
HalfVectorDraw draw_half_vector(double shininess, SquarePoint random);

/// The weight D/pdf of a draw. Published: (2/pi) (S+2)/(S+1) cos(theta), since the density of the
/// half-vector lacks its 1/2pi and the formula its 1/4. Corrected, times 2pi/4: its mean is 1.
double reflectivity_weight_published(double shininess, double half_cosine);
double reflectivity_weight(double shininess, double half_cosine);

/// The published shader skips a draw whose density (S+1) cos^S, without the 1/2pi, is below 1e-4.
bool is_skipped_published(double shininess, double half_cosine);

/// What the sum of the weighted samples is divided by.
enum class ReflectivityForm {
  published,  ///< the samples that were not skipped, a frame at a time, blended in single precision
  per_draw,   ///< all draws: the integral itself; darker where half-vectors mirror from below
  normalised,  ///< the sum of the weights: a white map stays white
};

/// One level that is refined frame by frame.
class ReflectivityAccumulation {
 public:
  /// The map must outlive it. Random numbers: of texel i the i-th substream of `stream`. Throws
  /// InputError unless the roughness is in (0,1].
  ReflectivityAccumulation(const Grid<Rgb>& map, Extent extent, double roughness,
                           ReflectivityForm form, const RandomStream& stream);

  /// Draws `samples` more for every texel. In the published form a texel draws on until one is
  /// good, at numbers that the next frame draws again.
  void add_frame(int samples);

  /// The mean radiance of all samples so far, texel by texel; 0 of a texel without a good sample.
  Grid<Rgb> mean() const;
  std::uint64_t samples() const { return samples_; }

 private:
  struct Exact {
    RunningMean<glm::dvec3> light;
    RunningMean<double> weight;
  };
  struct Published {
    PublishedBlend red;
    PublishedBlend green;
    PublishedBlend blue;
  };

  void add_published(std::size_t texel, int samples);
  void add_exact(std::size_t texel, int samples);

  const Grid<Rgb>* map_;
  Extent extent_;
  double shininess_;
  ReflectivityForm form_;
  RandomStream stream_;
  std::vector<Exact> exact_;
  std::vector<Published> published_;
  std::uint64_t samples_ = 0;
};

}  // namespace lightproof
