#include "lightproof/estimators/specular_tables.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/estimators/diffuse_tables.h"
#include "lightproof/prefilter/brdf_map.h"
#include "lightproof/prefilter/brdf_quadrature.h"
#include "lightproof/prefilter/irradiance_map.h"
#include "lightproof/prefilter/radiance_look_up.h"
#include "lightproof/prefilter/specular_chain.h"
#include "lightproof/warp/hemisphere.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

constexpr Extent kFinestLevel = kSplitSumFinest;
constexpr int kLevels = kSplitSumLevels;
constexpr Extent kNormals = kTabulatedNormals;
constexpr std::size_t kCosines = 64;

/// Values at the cosines i/(kCosines - 1), interpolated linearly between them.
class CosineTable {
 public:
  explicit CosineTable(std::vector<double> values) : values_(std::move(values)) {}

  double operator()(double cosine) const {
    const double last = static_cast<double>(values_.size() - 1);
    const double scaled = std::clamp(cosine, 0.0, 1.0) * last;
    const auto below = static_cast<std::size_t>(std::min(scaled, last - 1.0));
    return std::lerp(values_[below], values_[below + 1], scaled - static_cast<double>(below));
  }
  std::size_t bytes() const { return values_.size() * sizeof(double); }

 private:
  std::vector<double> values_;
};

std::vector<double> table_cosines() {
  std::vector<double> cosines;
  for (std::size_t i = 0; i < kCosines; ++i) {
    cosines.push_back(static_cast<double>(i) / static_cast<double>(kCosines - 1));
  }
  return cosines;
}

Masking masking_of(SmithMasking masking) {
  switch (masking) {
    case SmithMasking::karis:
      return Masking::karis;
    case SmithMasking::separable:
      return Masking::separable;
    case SmithMasking::height_correlated:
      return Masking::height_correlated;
  }
  return Masking::height_correlated;
}

/// What Phong's lobe of unit reflectance reflects of a white sky: (n+2)/(n+1) times the mean of
/// (n·l)+ over the density (n+1)/2pi cos^n around the mirrored view, by midpoints of its inverse
/// distribution function.
double white_sky_of_lobe(double exponent, double cosine) {
  constexpr int kPoints = 64;
  const double sine = std::sqrt(1.0 - cosine * cosine);
  double sum = 0.0;
  for (int j = 0; j < kPoints; ++j) {
    for (int i = 0; i < kPoints; ++i) {
      const Direction local =
          phong_lobe_from_square({(i + 0.5) / kPoints, (j + 0.5) / kPoints}, exponent);
      sum += std::max(0.0, local.x * sine + local.z * cosine);
    }
  }
  return (exponent + 2.0) / (exponent + 1.0) * sum / (kPoints * kPoints);
}

std::size_t bytes_of(const SpecularChain& chain) {
  std::size_t bytes = 0;
  for (const Grid<Rgb>& level : chain) bytes += level.values().size_bytes();
  return bytes;
}

/// What is looked up for a modified Phong material.
struct PhongTables {
  std::shared_ptr<const Grid<Rgb>> by_normal;
  Grid<Rgb> by_reflection;
  CosineTable white;

  Rgb reflected(const ModifiedPhong& phong, const ShadingPoint& at) const {
    const Direction mirrored = reflect_about(at.view, at.frame.normal);
    const glm::dvec3 diffuse = look_up_bilinear(*by_normal, square_from_direction(at.frame.normal));
    const glm::dvec3 glossy = look_up_bilinear(by_reflection, square_from_direction(mirrored));
    const double cosine = glm::dot(at.view, at.frame.normal);
    return Rgb(phong.diffuse * diffuse + phong.specular * white(cosine) * glossy);
  }
};

}  // namespace

PhongLobe prefilter_lobe(const ModifiedPhong& phong) { return {phong.exponent + 1.0}; }

Extent prefilter_extent(const PhongLobe& lobe) {
  int rows = 16;
  while (rows < kFinestLevel.height && rows * width(lobe).value < 8.0 * kPi) rows *= 2;
  return {2 * rows, rows};
}

std::vector<double> reflected_of_white_sky(const Ggx& ggx, std::span<const double> cosines) {
  std::vector<ScaleBias> row(cosines.size());
  BrdfQuadrature(10, 18).integrate(cosines, ggx.roughness, masking_of(ggx.masking), row);
  std::vector<double> reflected;
  for (const ScaleBias& value : row) reflected.push_back(value.reflected(ggx.normal_reflectance));
  return reflected;
}

std::vector<double> reflected_of_white_sky(const ModifiedPhong& phong,
                                           std::span<const double> cosines) {
  std::vector<double> reflected;
  for (const double cosine : cosines) {
    reflected.push_back(white_sky_of_lobe(phong.exponent, cosine));
  }
  return reflected;
}

PreparedEstimator split_sum(const EnvironmentMap& map) {
  const auto chain =
      std::make_shared<const SpecularChain>(ggx_chain(map.radiance, kFinestLevel, kLevels));
  return {[chain](const Scene& /*scene*/, const Material& material) -> BoundEstimator {
            const Ggx* ggx = std::get_if<Ggx>(&material);
            if (ggx == nullptr) {
              throw InputError("the split sum is for GGX, and for no other material");
            }
            return {[chain, white = CosineTable(reflected_of_white_sky(*ggx, table_cosines())),
                     level = level_of_roughness(ggx->roughness, kLevels)](
                        const ShadingPoint& at, const RandomStream& /*stream*/, Budget /*budget*/,
                        const EachEstimate& /*each*/) {
              const Direction mirrored = reflect_about(at.view, at.frame.normal);
              const double reflected = white(glm::dot(at.view, at.frame.normal));
              return look_up(*chain, mirrored, level) * static_cast<float>(reflected);
            }};
          },
          bytes_of(*chain) + kCosines * sizeof(double)};
}

PreparedEstimator prefiltered_phong(const EnvironmentMap& map) {
  const auto diffuse = std::make_shared<const Grid<Rgb>>(
      rounded(diffuse_map(irradiance_map(map, kNormals)).radiance));
  return {[&map, diffuse](const Scene& /*scene*/, const Material& material) -> BoundEstimator {
            const auto* phong = std::get_if<ModifiedPhong>(&material);
            if (phong == nullptr) {
              throw InputError("a map prefiltered by Phong's lobe is for the modified Phong model");
            }
            const PhongLobe lobe = prefilter_lobe(*phong);
            const PrefilteredLevel wanted = {lobe, prefilter_extent(lobe)};
            const auto tables = std::make_shared<const PhongTables>(
                PhongTables{diffuse, prefilter(map.radiance, {&wanted, 1}).front(),
                            CosineTable(reflected_of_white_sky(*phong, table_cosines()))});
            return {[tables, phong = *phong](const ShadingPoint& at, const RandomStream& /*stream*/,
                                             Budget /*budget*/, const EachEstimate& /*each*/) {
                      return tables->reflected(phong, at);
                    },
                    tables->by_reflection.values().size_bytes() + tables->white.bytes()};
          },
          diffuse->values().size_bytes()};
}

bool is_phong(const Material& material) { return std::holds_alternative<ModifiedPhong>(material); }

}  // namespace lightproof
