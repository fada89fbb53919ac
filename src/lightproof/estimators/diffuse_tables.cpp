#include "lightproof/estimators/diffuse_tables.h"

#include <array>
#include <cmath>

#include "lightproof/core/error.h"
#include "lightproof/prefilter/irradiance_map.h"
#include "lightproof/prefilter/radiance_look_up.h"
#include "lightproof/prefilter/spherical_harmonics.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// The albedo of a diffuse material. Throws InputError for other ones.
double albedo_of(const Material& material) {
  const Lambert* lambert = std::get_if<Lambert>(&material);
  if (lambert == nullptr) {
    throw InputError("irradiance alone lights Lambert's material, and no material with a lobe");
  }
  return lambert->albedo;
}

/// An estimator that looks the normal up, and multiplies by the albedo.
template <class LookUp>
PreparedEstimator by_normal(LookUp look_up, std::size_t bytes) {
  return {[look_up](const Scene& /*scene*/, const Material& material) -> BoundEstimator {
            const double albedo = albedo_of(material);
            return {[look_up, albedo](const ShadingPoint& at, const RandomStream& /*stream*/,
                                      Budget /*budget*/, const EachEstimate& /*each*/) {
              return Rgb(albedo * look_up(at.frame.normal));
            }};
          },
          bytes};
}

/// Y(0,0), Y(1,-1) … Y(2,2) as spherical_harmonics.h has them, as polynomials.
std::array<double, 9> nine_harmonics(Direction d) {
  const double a = 0.5 / std::sqrt(kPi);
  const double b = std::sqrt(3.0) * a;
  const double c = std::sqrt(15.0) * a;
  const double e = std::sqrt(5.0) * a;
  return {a,
          b * d.y,
          b * d.z,
          b * d.x,
          c * d.x * d.y,
          c * d.y * d.z,
          0.5 * e * (3.0 * d.z * d.z - 1.0),
          c * d.x * d.z,
          0.5 * c * (d.x * d.x - d.y * d.y)};
}

}  // namespace

PreparedEstimator harmonic_irradiance(const EnvironmentMap& map) {
  std::array<glm::dvec3, 9> of_white;
  const SphericalHarmonics irradiance = irradiance_harmonics(project(map, 2));
  for (std::size_t i = 0; i < of_white.size(); ++i) of_white[i] = irradiance.coefficients[i] / kPi;
  return by_normal(
      [of_white](Direction normal) {
        const auto harmonics = nine_harmonics(normal);
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < harmonics.size(); ++i) sum += harmonics[i] * of_white[i];
        return glm::max(sum, glm::dvec3(0.0));
      },
      sizeof(of_white));
}

PreparedEstimator tabulated_irradiance(const EnvironmentMap& map) {
  const auto table = std::make_shared<const Grid<Rgb>>(
      rounded(diffuse_map(irradiance_map(map, kTabulatedNormals)).radiance));
  return by_normal(
      [table](Direction normal) { return look_up_bilinear(*table, square_from_direction(normal)); },
      table->values().size_bytes());
}

bool is_lambert(const Material& material) { return std::holds_alternative<Lambert>(material); }

}  // namespace lightproof
