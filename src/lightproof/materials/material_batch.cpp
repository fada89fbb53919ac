#include "lightproof/materials/material_batch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lightproof/materials/material_batch.cpp"
#include <hwy/foreach_target.h>
// Highway asks for this order.
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include "lightproof/warp/sin_cos-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR

std::size_t evaluate_front(const Material& /*material*/, const ShadingPoint& /*at*/,
                           const DirectionArrays& /*light*/, std::span<double> /*out*/) {
  return 0;
}
std::size_t sample_front(const Material& /*material*/, const ShadingPoint& /*at*/,
                         std::span<const double> /*s*/, std::span<const double> /*t*/,
                         const MaterialSamples& /*samples*/) {
  return 0;
}

#else

namespace hn = hwy::HWY_NAMESPACE;

using Numbers = hn::ScalableTag<double>;
using Number = hn::Vec<Numbers>;

HWY_INLINE Number number(double value) { return hn::Set(Numbers(), value); }

struct Directions {
  Number x;
  Number y;
  Number z;
};

HWY_INLINE Number dot(const Direction& a, const Directions& b) {
  return hn::MulAdd(number(a.x), b.x, hn::MulAdd(number(a.y), b.y, hn::Mul(number(a.z), b.z)));
}

HWY_INLINE Number to_axis(const Directions& local, double tangent, double bitangent,
                          double normal) {
  return hn::MulAdd(local.x, number(tangent),
                    hn::MulAdd(local.y, number(bitangent), hn::Mul(local.z, number(normal))));
}
HWY_INLINE Directions to_world(const Frame& frame, const Directions& local) {
  const auto& [tangent, bitangent, normal] = frame;
  return {to_axis(local, tangent.x, bitangent.x, normal.x),
          to_axis(local, tangent.y, bitangent.y, normal.y),
          to_axis(local, tangent.z, bitangent.z, normal.z)};
}

/// direction_around_z.
HWY_INLINE Directions around_z(Number cosine, Number turns) {
  const Number one = number(1.0);
  const Number square = hn::Mul(hn::Sub(one, cosine), hn::Add(one, cosine));
  const Number sine = hn::Sqrt(hn::Max(hn::Zero(Numbers()), square));
  const auto azimuth = sin_cos_of_turns(Numbers(), turns);
  return {hn::Mul(sine, azimuth.cos), hn::Mul(sine, azimuth.sin), cosine};
}

HWY_INLINE Number power(Number base, double exponent) {
  return hn::Exp(Numbers(), hn::Mul(number(exponent), hn::Log(Numbers(), base)));
}

/// cosine_power, of cosines > 0.
HWY_INLINE Number cosine_powers(Number cosine, double n) {
  if (!squares_power(n)) return power(cosine, n);
  Number result = number(1.0);
  Number square = cosine;
  for (auto bits = static_cast<unsigned>(n); bits != 0;
       bits >>= 1U, square = hn::Mul(square, square)) {
    if ((bits & 1U) != 0) result = hn::Mul(result, square);
  }
  return result;
}

struct Scatterings {
  Number reflected_cosine;
  Number pdf;
};

class LambertKernel {
 public:
  LambertKernel(const Lambert& material, const ShadingPoint& at)
      : albedo_(material.albedo), frame_(at.frame) {}

  HWY_INLINE Scatterings evaluate(const Directions& light) const {
    const Number cosine = hn::Max(hn::Zero(Numbers()), dot(frame_.normal, light));
    const Number density = hn::Mul(cosine, number(1.0 / kPi));
    return {hn::Mul(number(albedo_), density), density};
  }
  HWY_INLINE Directions draw(Number s, Number t) const {
    return to_world(frame_, around_z(hn::Sqrt(hn::Sub(number(1.0), t)), s));
  }

 private:
  double albedo_;
  Frame frame_;
};

class PhongKernel {
 public:
  PhongKernel(const ModifiedPhong& material, const ShadingPoint& at)
      : material_(material),
        share_(material.diffuse / (material.diffuse + material.specular)),
        frame_(at.frame),
        mirrored_(frame_around(reflect_about(at.view, at.frame.normal))) {}

  HWY_INLINE Scatterings evaluate(const Directions& light) const {
    const Number zero = hn::Zero(Numbers());
    const double n = material_.exponent;
    const Number cosine = hn::Max(zero, dot(frame_.normal, light));
    const Number alpha = dot(mirrored_.normal, light);
    const Number lobe = hn::Mul(number((n + 2.0) / (2.0 * kPi)), cosine_powers(alpha, n));
    const Number glossy = hn::IfThenElseZero(hn::Gt(alpha, zero), lobe);
    const Number brdf =
        hn::MulAdd(number(material_.specular), glossy, number(material_.diffuse / kPi));
    const Number glossy_pdf = hn::Mul(number((1.0 - share_) * (n + 1.0) / (n + 2.0)), glossy);
    return {hn::Mul(cosine, brdf), hn::MulAdd(number(share_ / kPi), cosine, glossy_pdf)};
  }
  HWY_INLINE Directions draw(Number s, Number t) const {
    const Number share = number(share_);
    const auto diffuse = hn::Lt(s, share);
    const Number part = hn::IfThenElse(diffuse, s, hn::Sub(s, share));
    const Number turns =
        hn::Mul(part, hn::IfThenElse(diffuse, number(1.0 / share_), number(1.0 / (1.0 - share_))));
    const Number rest = hn::Sub(number(1.0), t);
    const Number glossy_cosine = power(rest, 1.0 / (material_.exponent + 1.0));
    const Directions local =
        around_z(hn::IfThenElse(diffuse, hn::Sqrt(rest), glossy_cosine), turns);
    const Directions a = to_world(frame_, local);
    const Directions b = to_world(mirrored_, local);
    return {hn::IfThenElse(diffuse, a.x, b.x), hn::IfThenElse(diffuse, a.y, b.y),
            hn::IfThenElse(diffuse, a.z, b.z)};
  }

 private:
  ModifiedPhong material_;
  double share_;  ///< of the diffuse lobe
  Frame frame_;
  Frame mirrored_;  ///< around the mirrored view
};

HWY_INLINE LambertKernel kernel_of(const Lambert& material, const ShadingPoint& at) {
  return {material, at};
}
HWY_INLINE PhongKernel kernel_of(const ModifiedPhong& material, const ShadingPoint& at) {
  return {material, at};
}

/// Materials without a kernel are left to the scalar code.
template <class Surface>
concept HasKernel = requires(const Surface& material, const ShadingPoint& at) {
  kernel_of(material, at);
};

/// Whole vectors from the front; returns how many directions that were.
template <class Kernel>
HWY_INLINE std::size_t evaluate_vectors(const Kernel& kernel, const DirectionArrays& light,
                                        std::span<double> out) {
  const Numbers d;
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= out.size(); i += hn::Lanes(d)) {
    const Directions at = {hn::LoadU(d, light.x.data() + i), hn::LoadU(d, light.y.data() + i),
                           hn::LoadU(d, light.z.data() + i)};
    hn::StoreU(kernel.evaluate(at).reflected_cosine, d, out.data() + i);
  }
  return i;
}

template <class Kernel>
HWY_INLINE std::size_t sample_vectors(const Kernel& kernel, std::span<const double> s,
                                      std::span<const double> t, const MaterialSamples& samples) {
  const Numbers d;
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= s.size(); i += hn::Lanes(d)) {
    const Directions light = kernel.draw(hn::LoadU(d, s.data() + i), hn::LoadU(d, t.data() + i));
    const Scatterings scattering = kernel.evaluate(light);
    hn::StoreU(light.x, d, samples.x.data() + i);
    hn::StoreU(light.y, d, samples.y.data() + i);
    hn::StoreU(light.z, d, samples.z.data() + i);
    hn::StoreU(scattering.pdf, d, samples.pdf.data() + i);
    hn::StoreU(scattering.reflected_cosine, d, samples.reflected_cosine.data() + i);
  }
  return i;
}

std::size_t evaluate_front(const Material& material, const ShadingPoint& at,
                           const DirectionArrays& light, std::span<double> out) {
  return std::visit(
      [&]<class Surface>(const Surface& surface) HWY_ATTR -> std::size_t {
        if constexpr (HasKernel<Surface>) {
          return evaluate_vectors(kernel_of(surface, at), light, out);
        } else {
          return 0;
        }
      },
      material);
}

std::size_t sample_front(const Material& material, const ShadingPoint& at,
                         std::span<const double> s, std::span<const double> t,
                         const MaterialSamples& samples) {
  return std::visit(
      [&]<class Surface>(const Surface& surface) HWY_ATTR -> std::size_t {
        if constexpr (HasKernel<Surface>) {
          return sample_vectors(kernel_of(surface, at), s, t, samples);
        } else {
          return 0;
        }
      },
      material);
}

#endif

}  // namespace
}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lightproof {
namespace {

HWY_EXPORT(evaluate_front);
HWY_EXPORT(sample_front);

}  // namespace

std::size_t reflected_cosines(const Material& material, const ShadingPoint& at,
                              const DirectionArrays& light, std::span<double> reflected_cosine) {
  const std::size_t by_vectors =
      HWY_DYNAMIC_DISPATCH(evaluate_front)(material, at, light, reflected_cosine);
  std::visit(
      [&](const auto& surface) {
        for (std::size_t i = by_vectors; i < reflected_cosine.size(); ++i) {
          const Direction direction = {light.x[i], light.y[i], light.z[i]};
          reflected_cosine[i] = surface.evaluate(at, direction).reflected_cosine;
        }
      },
      material);
  return by_vectors;
}

std::size_t sample_material(const Material& material, const ShadingPoint& at,
                            std::span<const double> s, std::span<const double> t,
                            const MaterialSamples& samples) {
  const std::size_t by_vectors = HWY_DYNAMIC_DISPATCH(sample_front)(material, at, s, t, samples);
  std::visit(
      [&](const auto& surface) {
        for (std::size_t i = by_vectors; i < s.size(); ++i) {
          const auto [direction, scattering] = surface.sample(at, {s[i], t[i]});
          samples.x[i] = direction.x;
          samples.y[i] = direction.y;
          samples.z[i] = direction.z;
          samples.pdf[i] = scattering.pdf.value;
          samples.reflected_cosine[i] = scattering.reflected_cosine;
        }
      },
      material);
  return by_vectors;
}

}  // namespace lightproof
#endif
