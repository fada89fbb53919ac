// Lambert and the modified Phong model for vectors of directions.
//
// Included by sources of Highway's foreach_target only, once for each kind of vector: hence the
// guard, which is Highway's.
#if defined(LIGHTPROOF_MATERIALS_LOBE_KERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHTPROOF_MATERIALS_LOBE_KERNELS_INL_H
#undef LIGHTPROOF_MATERIALS_LOBE_KERNELS_INL_H
#else
#define LIGHTPROOF_MATERIALS_LOBE_KERNELS_INL_H
#endif

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include "lightproof/materials/lambert.h"
#include "lightproof/materials/modified_phong.h"
#include "lightproof/warp/sin_cos-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

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

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
