#include "lightproof/stability/direction_trials.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "lightproof/materials/material.h"
#include "lightproof/points/r2.h"

namespace lightproof {
namespace {

constexpr double kLast = 1.0 - 0x1p-53;
constexpr std::array kInner = {0x1p-24, 0.25, 0.5, 0.75};
constexpr std::array kNextToOne = {1.0 - 0x1p-24, kLast};
/// Directions are unit vectors to a few roundings, also those that frames have turned.
constexpr double kUnit = 1e-7;
constexpr double kSamePdf = 1e-4;

std::vector<SquarePoint> pairs_of(std::span<const double> s, std::span<const double> t) {
  std::vector<SquarePoint> points;
  for (const double v : t) {
    for (const double u : s) points.push_back({u, v});
  }
  return points;
}

std::vector<SquarePoint> zero_points() {
  constexpr std::array kZero = {0.0};
  std::vector<SquarePoint> points = pairs_of(kZero, kZero);
  for (const SquarePoint u : pairs_of(kZero, kInner)) points.insert(points.end(), {u, {u.t, u.s}});
  return points;
}

std::vector<SquarePoint> last_points() {
  std::vector<SquarePoint> points = pairs_of(kNextToOne, kNextToOne);
  for (const SquarePoint u : pairs_of(kNextToOne, kInner)) {
    points.insert(points.end(), {u, {u.t, u.s}});
  }
  return points;
}

std::vector<SquarePoint> even_points() {
  const R2 points({});
  std::vector<SquarePoint> all;
  for (std::uint32_t i = 0; i < 256; ++i) all.push_back(points.point(i));
  return all;
}

using Draw = std::function<DrawnDirection(SquarePoint)>;

Finding broken(const DrawnDirection& drawn, SquarePoint u, std::string_view fault) {
  const bool finite =
      std::isfinite(drawn.direction.x + drawn.direction.y + drawn.direction.z + drawn.pdf.value);
  return {
      .outcome = finite ? StabilityOutcome::wrong : StabilityOutcome::not_a_number,
      .put_in = fmt::format("u = ({:.17g}, {:.17g})", u.s, u.t),
      .came_out = fmt::format("({:.6g}, {:.6g}, {:.6g}) of density {:.4g}: {}", drawn.direction.x,
                              drawn.direction.y, drawn.direction.z, drawn.pdf.value, fault)};
}

Finding check_points(const Draw& draw, std::span<const SquarePoint> points, bool must_be_positive) {
  for (const SquarePoint u : points) {
    const DrawnDirection drawn = draw(u);
    const std::string_view fault = fault_of(drawn, must_be_positive);
    if (!fault.empty()) return broken(drawn, u, fault);
  }
  return {.came_out = fmt::format("unit vectors of finite density at {} points", points.size())};
}

/// The number 1 is none of [0,1): what comes out is a direction, but its density may be 0.
Finding check_one(const Draw& draw) {
  constexpr std::array kOne = {1.0};
  constexpr std::array kAll = {0.0, 0.5, 1.0};
  std::vector<SquarePoint> points = pairs_of(kOne, kAll);
  for (const SquarePoint u : pairs_of(kAll, kOne)) points.push_back(u);
  return check_points(draw, points, false);
}

Finding check_round_trip(const Draw& draw, const std::function<PerSteradian(Direction)>& pdf) {
  Finding found{.bound = kSamePdf};
  for (const SquarePoint u : even_points()) {
    const DrawnDirection drawn = draw(u);
    const double off = std::abs(pdf(drawn.direction).value / drawn.pdf.value - 1.0);
    if (off <= found.amount) continue;
    found.amount = off;
    found.put_in = fmt::format("u = ({:.6g}, {:.6g})", u.s, u.t);
    found.came_out = fmt::format("density {:.6g} returned, {:.6g} asked for", drawn.pdf.value,
                                 pdf(drawn.direction).value);
    if (!(off <= kSamePdf)) found.outcome = StabilityOutcome::wrong;
  }
  return found;
}

constexpr Direction kUp = {0.0, 0.0, 1.0};

ShadingPoint seen_at(double cosine) {
  const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
  return {{}, frame_around(kUp), {sine, 0.0, cosine}};
}

DirectionSample drawn_by(const Material& material, const ShadingPoint& at, SquarePoint u) {
  return std::visit([&](const auto& m) { return m.sample(at, u); }, material);
}

/// A lobe seen at one angle.
struct SeenLobe {
  Material material;
  ShadingPoint at;

  DrawnDirection operator()(SquarePoint u) const {
    const DirectionSample sample = drawn_by(material, at, u);
    return {sample.direction, sample.scattering.pdf};
  }
  PerSteradian pdf(Direction direction) const {
    return std::visit([&](const auto& m) { return m.evaluate(at, direction); }, material).pdf;
  }
};

constexpr std::array kRoughnesses = {1.0, 0.3, 0.1, 0.01, 1e-3, 1e-4};
/// Cosines to the normal: along it, at 45, 80 and 89.9 degrees.
constexpr std::array kCosines = {1.0, 0.7071067811865476, 0.17364817766693041,
                                 0.0017453283658983088};

/// The first finding that is not right, of all roughnesses and cosines.
template <class Check>
Finding at_all_places(const LobeMethod& method, const Check& check) {
  Finding last;
  for (const double roughness : kRoughnesses) {
    for (const double cosine : kCosines) {
      last = check(SeenLobe{method.of_roughness(roughness), seen_at(cosine)});
      if (last.outcome == StabilityOutcome::right) continue;
      last.put_in = fmt::format("roughness {:g}, cosine of the view {:.4g}, {}", roughness, cosine,
                                last.put_in);
      return last;
    }
  }
  last.put_in = fmt::format("roughness 1 to 1e-4, seen at 0 to 89.9 degrees");
  return last;
}

/// A normal beside an axis, by some radians to a side that is none of the axes.
struct BesideAxis {
  Direction axis;
  double off;

  Direction normal() const {
    const Direction side = {axis.y + axis.z, 0.5 * axis.z + axis.x, axis.x + axis.y};
    return glm::normalize(axis + off * side);
  }
};

std::vector<BesideAxis> beside_axes() {
  std::vector<BesideAxis> all;
  for (const Direction axis : {Direction(1, 0, 0), Direction(0, 1, 0), Direction(0, 0, 1)}) {
    // Of -axis the zeros are -0.
    for (const double off : {0.0, 1e-7, 1e-3}) {
      all.push_back({axis, off});
      all.push_back({-axis, off});
    }
  }
  return all;
}

bool depends_on_roughness(const LobeMethod& method) {
  return !std::holds_alternative<Lambert>(method.of_roughness(0.5));
}

}  // namespace

std::string_view fault_of(const DrawnDirection& drawn, bool must_be_positive) {
  if (!(std::abs(glm::dot(drawn.direction, drawn.direction) - 1.0) <= kUnit))
    return "no unit vector";
  if (!(drawn.pdf.value >= 0.0) || std::isinf(drawn.pdf.value)) return "no finite density";
  if (must_be_positive && !(drawn.pdf.value > 0.0)) return "no positive density";
  return {};
}

Finding check_lobe(const LobeMethod& method, double roughness, double view_cosine) {
  const SeenLobe lobe = {method.of_roughness(roughness), seen_at(view_cosine)};
  for (const std::vector<SquarePoint>& points : {zero_points(), last_points(), even_points()}) {
    Finding found = check_points(lobe, points, true);
    if (found.outcome != StabilityOutcome::right) return found;
  }
  return check_round_trip(lobe, [&](Direction d) { return lobe.pdf(d); });
}

namespace trials {

Finding zero_numbers(const DirectionSamplerInfo& method, const TrialOptions& /*options*/) {
  return check_points(method.sample, zero_points(), true);
}

Finding numbers_next_to_one(const DirectionSamplerInfo& method, const TrialOptions& /*options*/) {
  Finding found = check_points(method.sample, last_points(), true);
  return found.outcome == StabilityOutcome::right ? check_one(method.sample) : found;
}

Finding round_trip(const DirectionSamplerInfo& method, const TrialOptions& /*options*/) {
  return check_round_trip(method.sample, method.pdf);
}

Finding zero_numbers(const LobeMethod& method, const TrialOptions& /*options*/) {
  return at_all_places(
      method, [](const SeenLobe& lobe) { return check_points(lobe, zero_points(), true); });
}

Finding numbers_next_to_one(const LobeMethod& method, const TrialOptions& /*options*/) {
  return at_all_places(method, [](const SeenLobe& lobe) {
    Finding found = check_points(lobe, last_points(), true);
    return found.outcome == StabilityOutcome::right ? check_one(lobe) : found;
  });
}

Finding exact_poles(const LobeMethod& method, const TrialOptions& /*options*/) {
  Finding found{.came_out = "finite for view and light along the normal, and opposite to it"};
  for (const double roughness : kRoughnesses) {
    const SeenLobe lobe = {method.of_roughness(roughness), seen_at(1.0)};
    for (const Direction light : {kUp, -kUp}) {
      const Scattering scattering =
          std::visit([&](const auto& m) { return m.evaluate(lobe.at, light); }, lobe.material);
      if (std::isfinite(scattering.reflected_cosine) && std::isfinite(scattering.pdf.value))
        continue;
      return {.outcome = StabilityOutcome::not_a_number,
              .put_in = fmt::format("roughness {:g}, light along {:+g} z", roughness, light.z),
              .came_out = fmt::format("{} of density {}", scattering.reflected_cosine,
                                      scattering.pdf.value)};
    }
  }
  return found;
}

Finding round_trip(const LobeMethod& method, const TrialOptions& /*options*/) {
  return at_all_places(method, [](const SeenLobe& lobe) {
    return check_round_trip(lobe, [&](Direction d) { return lobe.pdf(d); });
  });
}

Finding roughness_zero(const LobeMethod& method, const TrialOptions& /*options*/) {
  if (method.parameter.empty()) {
    return {.outcome = StabilityOutcome::not_applicable,
            .came_out = "no roughness can be asked for"};
  }
  const std::string asked = method.parameter == "phong:" ? "phong:inf" : method.parameter + "0";
  const Material material = material_of(asked);
  return check_points(SeenLobe{material, seen_at(0.5)}, even_points(), true);
}

Finding little_roughness(const LobeMethod& method, const TrialOptions& /*options*/) {
  if (!depends_on_roughness(method)) {
    return {.outcome = StabilityOutcome::not_applicable, .came_out = "it has no roughness"};
  }
  constexpr std::array kRising = {1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 0.01, 0.02, 0.05};
  double before = 0.0;
  for (const double roughness : kRising) {
    // Of a material of two lobes u.s chooses: this one is of the mirrored view. The sine from both
    // components along the surface, since 1 - cosine^2 has no digits left.
    const DrawnDirection drawn = SeenLobe{method.of_roughness(roughness), seen_at(1.0)}({0.7, 0.5});
    const double angle = std::hypot(drawn.direction.x, drawn.direction.y);
    if (!(angle > before)) {
      return {.outcome = StabilityOutcome::wrong,
              .amount = before - angle,
              .put_in = fmt::format("roughness {:g}", roughness),
              .came_out = fmt::format("the median direction at {:.4g} rad from the mirrored view, "
                                      "{:.4g} before",
                                      angle, before)};
    }
    before = angle;
  }
  return {.came_out = "the rougher, the wider, at every step"};
}

Finding grazing_view(const LobeMethod& method, const TrialOptions& /*options*/) {
  Finding found;
  for (const double cosine : {1e-3, 1e-6, 1e-9, 1e-12}) {
    for (const double roughness : {1.0, 0.1}) {
      found = check_lobe(method, roughness, cosine);
      found.put_in = fmt::format("roughness {:g}, cosine of the view {:g}, {}", roughness, cosine,
                                 found.put_in);
      if (found.outcome != StabilityOutcome::right) return found;
    }
  }
  return found;
}

Finding axes(const FrameMethod& method, const TrialOptions& /*options*/) {
  // Of nine products of three terms each, none larger than 1, of vectors rounded before.
  Finding found{.bound = 16.0 * method.rounding, .came_out = "orthonormal around all of them"};
  for (const BesideAxis& beside : beside_axes()) {
    const double error = method.error(beside.normal());
    if (error <= found.amount) continue;
    found.amount = error;
    found.put_in = fmt::format("a normal {:g} rad from ({:+g}, {:+g}, {:+g})", beside.off,
                               beside.axis.x, beside.axis.y, beside.axis.z);
    found.came_out = fmt::format("orthonormal to {:.3g}", error);
    if (std::isnan(error)) {
      found.outcome = StabilityOutcome::not_a_number;
      return found;
    }
    if (error > found.bound) found.outcome = StabilityOutcome::wrong;
  }
  return found;
}

}  // namespace trials
}  // namespace lightproof
