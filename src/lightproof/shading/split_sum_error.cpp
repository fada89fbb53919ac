#include "lightproof/shading/split_sum_error.h"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cassert>
#include <cmath>

#include "lightproof/image/lat_long_texels.h"
#include "lightproof/materials/fresnel.h"
#include "lightproof/materials/ggx.h"
#include "lightproof/materials/half_vector.h"
#include "lightproof/prefilter/legendre.h"
#include "lightproof/prefilter/lobe.h"
#include "lightproof/prefilter/resample.h"
#include "lightproof/prefilter/spherical_harmonics.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

using Rule = boost::math::quadrature::gauss<double, 20>;

/// Panels of a half turn in azimuth: with 20 nodes each they resolve cos(160 phi).
constexpr int kAzimuthPanels = 10;
/// Radians that a panel of the polar angle covers at most: 20 nodes resolve degree 160.
constexpr double kWidestPanel = 0.2;

struct Node {
  double at;
  double weight;
};

/// Gauss-Legendre nodes of one interval.
template <class Visit>
void visit_nodes(double from, double to, const Visit& visit) {
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
    const double weight = half * Rule::weights()[i];
    visit(Node{middle + half * Rule::abscissa()[i], weight});
    visit(Node{middle - half * Rule::abscissa()[i], weight});
  }
}

/// Edges of panels over polar angles from 0 on that double in width from `least` on; `breaks`, in
/// their order, are edges, the last one the end.
std::vector<double> panel_edges(double least, std::span<const double> breaks) {
  std::vector<double> edges = {0.0};
  double width = least;
  for (const double end : breaks) {
    while (edges.back() < end) {
      edges.push_back(std::min(end, edges.back() + width));
      width = std::min(2.0 * width, kWidestPanel);
    }
  }
  return edges;
}

/// Normal and view around the mirrored view, which is +z; all in one plane.
struct MirroredFrame {
  explicit MirroredFrame(double cosine_to_view)
      : cosine(cosine_to_view), sine(std::sqrt(1.0 - cosine * cosine)) {
    const Direction normal = {sine, 0.0, cosine};
    frame = {{cosine, 0.0, -sine}, {0.0, 1.0, 0.0}, normal};
    view = frame.to_local(reflect_about({0.0, 0.0, 1.0}, normal));
  }

  /// The azimuth in [0, pi] up to which directions at this polar angle are above the horizon.
  double horizon(double theta) const {
    const double height = cosine * std::cos(theta);
    const double radius = sine * std::sin(theta);
    if (height >= radius) return kPi;
    return height <= -radius ? 0.0 : std::acos(-height / radius);
  }

  double cosine;
  double sine;
  Frame frame;
  Direction view;  ///< relative to the surface
};

/// k = scale F0 + bias.
struct Reflection {
  double scale;
  double bias;
};

Reflection reflection(double alpha, Direction view, Direction light) {
  if (!(light.z > 0.0)) return {0.0, 0.0};
  const HalfVector half = half_vector(view, light);
  const double k = ggx_normal_distribution(alpha, half.normal) *
                   smith_visibility(SmithMasking::height_correlated, alpha, view.z, light.z) *
                   light.z;
  const double fresnel = schlick_weight(half.cosine);
  return {k * (1.0 - fresnel), k * fresnel};
}

/// Both parts of k: integrals over a circle of constant polar angle of k cos(m phi), m = 0 …
/// degree, and of products.
struct Circle {
  std::vector<double> scale;
  std::vector<double> bias;
  glm::dvec3 products;  ///< of scale and scale, scale and bias, bias and bias
};

/// Integrals over the sphere.
struct Coefficients {
  std::vector<double> scale;  ///< of harmonics, by legendre_index
  std::vector<double> bias;
  std::vector<double> lobe;  ///< of zonal harmonics, by degree
  glm::dvec3 products = glm::dvec3(0.0);
  double scale_and_lobe = 0.0;
  double bias_and_lobe = 0.0;
  double lobe_square = 0.0;
};

class KernelTransform {
 public:
  KernelTransform(double roughness, double cosine, int degree)
      : alpha_(alpha_of_roughness(roughness)),
        frame_(cosine),
        lobe_(GgxLobe{alpha_}),
        lobe_angle_(solid_angle(lobe_)),
        functions_(degree),
        legendre_(legendre_count(degree)),
        circle_{std::vector<double>(degrees()), std::vector<double>(degrees()), glm::dvec3(0.0)} {
    sums_.scale.resize(legendre_.size());
    sums_.bias.resize(legendre_.size());
    sums_.lobe.resize(degrees());
    // Out of the plane of incidence the lobe is narrower than in it, by the cosine of the view.
    // Circles meet the horizon from one angle on and are below it from another; the lobe ends
    // between.
    const double tilt = std::atan2(frame_.sine, frame_.cosine);
    const std::array breaks = {0.5 * kPi - tilt, 0.5 * kPi, 0.5 * kPi + tilt};
    const std::vector<double> edges = panel_edges(0.5 * alpha_ * frame_.cosine, breaks);
    for (std::size_t i = 1; i < edges.size(); ++i) {
      visit_nodes(edges[i - 1], edges[i], [&](Node polar) { add(polar); });
    }
  }

  SplitSumKernel at(double f0) const {
    const double reflectance = (f0 * sums_.scale[0] + sums_.bias[0]) * std::sqrt(kSphere);
    const double product = f0 * sums_.scale_and_lobe + sums_.bias_and_lobe;
    double left = glm::dot(glm::dvec3(f0 * f0, 2.0 * f0, 1.0), sums_.products) -
                  2.0 * reflectance * product + reflectance * reflectance * sums_.lobe_square;
    std::vector<double> power(degrees());
    for (int l = 0; l <= functions_.degree(); ++l) {
      double& sum = power[static_cast<std::size_t>(l)];
      for (int m = 0; m <= l; ++m) {
        const std::size_t index = legendre_index(l, m);
        double value = f0 * sums_.scale[index] + sums_.bias[index];
        if (m == 0) value -= reflectance * sums_.lobe[static_cast<std::size_t>(l)];
        sum += (m == 0 ? 1.0 : 2.0) * value * value;
      }
      left -= sum;
    }
    return {reflectance, {power, std::max(0.0, left)}};
  }

 private:
  std::size_t degrees() const { return static_cast<std::size_t>(functions_.degree()) + 1; }

  void add(Node polar) {
    const double sine = std::sin(polar.at);
    const double cosine = std::cos(polar.at);
    const double area = sine * polar.weight;
    const double lobe = relative_density(lobe_, cosine) / lobe_angle_;
    measure_circle(sine, cosine, frame_.horizon(polar.at));
    functions_.evaluate(sine, cosine, legendre_);
    sums_.products += area * circle_.products;
    sums_.scale_and_lobe += area * lobe * circle_.scale[0];
    sums_.bias_and_lobe += area * lobe * circle_.bias[0];
    sums_.lobe_square += area * 2.0 * kPi * lobe * lobe;
    std::size_t index = 0;
    for (std::size_t l = 0; l < degrees(); ++l) {
      sums_.lobe[l] += area * 2.0 * kPi * lobe * legendre_[index];
      for (std::size_t m = 0; m <= l; ++m, ++index) {
        sums_.scale[index] += area * circle_.scale[m] * legendre_[index];
        sums_.bias[index] += area * circle_.bias[m] * legendre_[index];
      }
    }
  }

  void measure_circle(double sine, double cosine, double end) {
    std::fill(circle_.scale.begin(), circle_.scale.end(), 0.0);
    std::fill(circle_.bias.begin(), circle_.bias.end(), 0.0);
    circle_.products = glm::dvec3(0.0);
    for (int panel = 0; panel < kAzimuthPanels && end > 0.0; ++panel) {
      visit_nodes(end * panel / kAzimuthPanels, end * (panel + 1) / kAzimuthPanels, [&](Node node) {
        const double along = std::cos(node.at);
        const Direction light = {sine * along, sine * std::sin(node.at), cosine};
        const Reflection r = reflection(alpha_, frame_.view, frame_.frame.to_local(light));
        // Both halves of the circle are alike.
        const double weight = 2.0 * node.weight;
        circle_.products +=
            weight * glm::dvec3(r.scale * r.scale, r.scale * r.bias, r.bias * r.bias);
        add_multiples({weight * r.scale, weight * r.bias}, along);
      });
    }
  }

  /// cos(m phi) of all m by Chebyshev's recurrence.
  void add_multiples(Reflection weighted, double cosine) {
    double before = cosine;
    double now = 1.0;
    for (std::size_t m = 0; m < circle_.scale.size(); ++m) {
      circle_.scale[m] += weighted.scale * now;
      circle_.bias[m] += weighted.bias * now;
      const double next = 2.0 * cosine * now - before;
      before = now;
      now = next;
    }
  }

  double alpha_;
  MirroredFrame frame_;
  Lobe lobe_;
  double lobe_angle_;
  LegendreFunctions functions_;
  std::vector<double> legendre_;
  Circle circle_;
  Coefficients sums_;
};

double dot(glm::dvec3 rgb, LuminanceWeights weights) {
  return weights.red * rgb.r + weights.green * rgb.g + weights.blue * rgb.b;
}

double integral_of_square(const EnvironmentMap& map) {
  const Extent extent = map.radiance.extent();
  double sum = 0.0;
  for (int y = 0; y < extent.height; ++y) {
    double row = 0.0;
    for (const Rgb& rgb : map.radiance.row(y)) {
      const double luminance = luminance_of(rgb, map.weights);
      row += luminance * luminance;
    }
    sum += row * texel_solid_angle(extent, y);
  }
  return sum;
}

}  // namespace

std::vector<SplitSumKernel> split_sum_kernels(double roughness, double cosine,
                                              std::span<const double> normal_reflectances,
                                              int degree) {
  const KernelTransform transform(roughness, cosine, degree);
  std::vector<SplitSumKernel> kernels;
  for (const double f0 : normal_reflectances) kernels.push_back(transform.at(f0));
  return kernels;
}

AngularPower luminance_power(const EnvironmentMap& map, int degree) {
  require_lat_long(map, "the error of the split sum");
  const Extent extent = map.radiance.extent();
  if (extent.width > kSplitSumWidth) {
    const int height = std::max(1, extent.height * kSplitSumWidth / extent.width);
    EnvironmentMap smaller{map.name, resampled(map.radiance, {kSplitSumWidth, height})};
    smaller.weights = map.weights;
    return luminance_power(smaller, degree);
  }
  const SphericalHarmonics harmonics = project(map, degree);
  AngularPower power{{}, integral_of_square(map)};
  for (int l = 0; l <= degree; ++l) {
    double sum = 0.0;
    for (int m = -l; m <= l; ++m) {
      const double coefficient = dot(harmonics(l, m), map.weights);
      sum += coefficient * coefficient;
    }
    power.of_degree.push_back(sum);
    power.beyond -= sum;
  }
  power.beyond = std::max(0.0, power.beyond);
  return power;
}

SplitSumError split_sum_error(const SplitSumKernel& kernel, const AngularPower& luminance) {
  const std::vector<double>& error = kernel.difference.of_degree;
  assert(error.size() == luminance.of_degree.size());
  const double mean_square =
      luminance.of_degree[0] * kernel.reflectance * kernel.reflectance / kSphere;
  if (!(mean_square > 0.0)) return {0.0, 0.0};
  double sum = 0.0;
  for (std::size_t l = 0; l < error.size(); ++l) {
    sum += luminance.of_degree[l] * error[l] / (2.0 * static_cast<double>(l) + 1.0);
  }
  // Neither power is larger than all that is left of it; and of light that is nowhere negative, no
  // P_l / (2l + 1) is larger than P_0.
  const double next = 2.0 * static_cast<double>(error.size()) + 1.0;
  const double beyond =
      kernel.difference.beyond * std::min(luminance.beyond / next, luminance.of_degree[0]);
  return {std::sqrt(sum / mean_square), std::sqrt(beyond / mean_square)};
}

}  // namespace lightproof
