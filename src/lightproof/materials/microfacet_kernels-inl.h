// GGX and Blinn's microfacets for vectors of directions: formulas and names are those of
// microfacet.h and the headers that it includes.
//
// Included by sources of Highway's foreach_target only, once for each kind of vector: hence the
// guard, which is Highway's.
#if defined(LIGHTPROOF_MATERIALS_MICROFACET_KERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIGHTPROOF_MATERIALS_MICROFACET_KERNELS_INL_H
#undef LIGHTPROOF_MATERIALS_MICROFACET_KERNELS_INL_H
#else
#define LIGHTPROOF_MATERIALS_MICROFACET_KERNELS_INL_H
#endif

#include "lightproof/materials/lobe_kernels-inl.h"
#include "lightproof/materials/microfacet.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

HWY_INLINE Number square(Number x) { return hn::Mul(x, x); }
HWY_INLINE Number length_squared(const Directions& d) {
  return hn::MulAdd(d.x, d.x, hn::MulAdd(d.y, d.y, square(d.z)));
}
HWY_INLINE Directions scaled(const Directions& d, Number factor) {
  return {hn::Mul(d.x, factor), hn::Mul(d.y, factor), hn::Mul(d.z, factor)};
}
HWY_INLINE Directions normalised(const Directions& d) {
  return scaled(d, hn::Div(number(1.0), hn::Sqrt(length_squared(d))));
}
HWY_INLINE Directions to_local(const Frame& frame, const Directions& world) {
  return {dot(frame.tangent, world), dot(frame.bitangent, world), dot(frame.normal, world)};
}
/// 2 (v.h) h - v.
HWY_INLINE Directions mirrored_at(const Direction& v, const Directions& h) {
  const Number twice = hn::Mul(number(2.0), dot(v, h));
  return {hn::MulSub(twice, h.x, number(v.x)), hn::MulSub(twice, h.y, number(v.y)),
          hn::MulSub(twice, h.z, number(v.z))};
}

struct HalfVectors {
  Directions normal;
  Number cosine;
};
HWY_INLINE HalfVectors half_vectors(const Direction& view, const Directions& light) {
  const Directions sum = {hn::Add(light.x, number(view.x)), hn::Add(light.y, number(view.y)),
                          hn::Add(light.z, number(view.z))};
  const Number length = hn::Sqrt(length_squared(sum));
  const Directions h = scaled(sum, hn::Div(number(1.0), length));
  const auto is_pair = hn::Gt(length, hn::Zero(Numbers()));
  const HalfVector other = half_vector_of_opposite(view);
  return {{hn::IfThenElse(is_pair, h.x, number(other.normal.x)),
           hn::IfThenElse(is_pair, h.y, number(other.normal.y)),
           hn::IfThenElse(is_pair, h.z, number(other.normal.z))},
          hn::IfThenElse(is_pair, hn::Mul(number(0.5), length), number(other.cosine))};
}

HWY_INLINE Number schlick_fresnels(double normal_reflectance, Number cosine) {
  const Number m = hn::Clamp(hn::Sub(number(1.0), cosine), number(0.0), number(1.0));
  const Number weight = hn::Mul(square(square(m)), m);
  return hn::MulAdd(number(1.0 - normal_reflectance), weight, number(normal_reflectance));
}

/// A normal on the ring of this sine and cosine.
HWY_INLINE Directions on_ring(Number sine, Number cosine, Number turns) {
  const auto azimuth = sin_cos_of_turns(Numbers(), turns);
  return {hn::Mul(sine, azimuth.cos), hn::Mul(sine, azimuth.sin), cosine};
}

class GgxKernel {
 public:
  GgxKernel(const Ggx& material, const ShadingPoint& at)
      : material_(material),
        alpha_(ggx_alpha(material.roughness)),
        frame_(at.frame),
        view_(at.frame.to_local(at.view)),
        view_length_(smith_stretched_length(alpha_, view_.z)),
        on_hemisphere_(to_hemisphere_of_normals(alpha_, view_)),
        bound_(material.sampling == MicrofacetSampling::bounded_caps ? cap_bound(alpha_, view_)
                                                                     : 1.0) {}

  HWY_INLINE Scatterings evaluate(const Directions& world) const {
    const Number zero = hn::Zero(Numbers());
    const Directions light = to_local(frame_, world);
    const HalfVectors half = half_vectors(view_, light);
    const Number a2 = number(alpha_ * alpha_);
    const Number stretched =
        hn::MulAdd(half.normal.x, half.normal.x,
                   hn::MulAdd(half.normal.y, half.normal.y, hn::Mul(a2, square(half.normal.z))));
    const Number d = hn::Div(hn::Mul(a2, number(1.0 / kPi)), square(stretched));
    const Number reflected =
        hn::Mul(hn::Mul(schlick_fresnels(material_.normal_reflectance, half.cosine), d),
                hn::Mul(visibility(light.z), light.z));
    return {hn::IfThenElseZero(hn::Gt(light.z, zero), reflected), pdf(half, d)};
  }

  HWY_INLINE Directions draw(Number s, Number t) const {
    return to_world(frame_, mirrored_at(view_, normal(s, t)));
  }

 private:
  HWY_INLINE Number stretched_length(Number mu) const {
    const double a2 = alpha_ * alpha_;
    return hn::Sqrt(hn::MulAdd(number(1.0 - a2), square(mu), number(a2)));
  }

  HWY_INLINE Number visibility(Number mu) const {
    switch (material_.masking) {
      case SmithMasking::karis: {
        const double k = 0.5 * alpha_;
        const Number of_light = hn::MulAdd(mu, number(1.0 - k), number(k));
        return hn::Div(number(0.25 / (view_.z * (1.0 - k) + k)), of_light);
      }
      case SmithMasking::separable:
        return hn::Div(number(1.0 / (view_.z + view_length_)), hn::Add(mu, stretched_length(mu)));
      case SmithMasking::height_correlated:
        break;
    }
    const Number of_light = hn::Mul(number(view_.z), stretched_length(mu));
    return hn::Div(number(0.5), hn::MulAdd(mu, number(view_length_), of_light));
  }

  /// Given D of the half vector or of its opposite.
  HWY_INLINE Number pdf(const HalfVectors& half, Number d) const {
    if (material_.sampling == MicrofacetSampling::normals) {
      const Number jacobian = hn::Mul(number(4.0), half.cosine);
      return hn::Div(hn::Mul(d, hn::Abs(half.normal.z)), jacobian);
    }
    auto may_be_drawn = hn::Ge(half.normal.z, hn::Zero(Numbers()));
    if (material_.sampling == MicrofacetSampling::bounded_caps) {
      const Number above = hn::Mul(hn::Add(half.cosine, half.cosine), half.normal.z);
      may_be_drawn = hn::And(may_be_drawn, hn::Or(hn::Ge(above, number(view_.z)), is_in_cap(half)));
    }
    return hn::IfThenElseZero(may_be_drawn,
                              hn::Mul(d, number(0.5 / (bound_ * view_.z + view_length_))));
  }

  HWY_INLINE hn::Mask<Numbers> is_in_cap(const HalfVectors& half) const {
    const Directions& h = half.normal;
    const Number inverse = number(1.0 / alpha_);
    const Directions m = normalised({hn::Mul(h.x, inverse), hn::Mul(h.y, inverse), h.z});
    const Number twice = hn::Mul(number(2.0), dot(on_hemisphere_, m));
    const Number height = hn::MulSub(twice, m.z, number(on_hemisphere_.z));
    const Number rounding = hn::Div(number(0x1p-50 / alpha_), half.cosine);
    return hn::Ge(height, hn::Sub(number(-bound_ * on_hemisphere_.z), rounding));
  }

  HWY_INLINE Directions normal(Number s, Number t) const {
    switch (material_.sampling) {
      case MicrofacetSampling::normals: {
        const Number left = hn::Sub(number(1.0), t);
        const Number whole = hn::MulAdd(number(alpha_ * alpha_), t, left);
        return on_ring(hn::Mul(number(alpha_), hn::Sqrt(hn::Div(t, whole))),
                       hn::Sqrt(hn::Div(left, whole)), s);
      }
      case MicrofacetSampling::visible_normals:
        return from_hemisphere(of_projection(s, t));
      case MicrofacetSampling::spherical_caps:
      case MicrofacetSampling::bounded_caps:
        break;
    }
    return from_hemisphere(of_cap(s, t));
  }

  HWY_INLINE Directions from_hemisphere(const Directions& h) const {
    const Number alpha = number(alpha_);
    return normalised({hn::Mul(h.x, alpha), hn::Mul(h.y, alpha), h.z});
  }

  HWY_INLINE Directions of_projection(Number s, Number t) const {
    const Number zero = hn::Zero(Numbers());
    const Direction x = across(on_hemisphere_);
    const Direction y = glm::cross(on_hemisphere_, x);
    const Number left = hn::Sub(number(1.0), t);
    const Directions in_disc = on_ring(hn::Sqrt(t), zero, s);
    const Number half_chord = hn::Sqrt(hn::MulAdd(in_disc.y, in_disc.y, left));
    const Number sum = hn::Add(half_chord, in_disc.y);
    const Number difference = hn::Sub(half_chord, in_disc.y);
    const Number above = hn::IfThenElse(hn::Gt(in_disc.y, zero), hn::Div(left, sum), difference);
    const Number below = hn::IfThenElse(hn::Lt(in_disc.y, zero), hn::Div(left, difference), sum);
    const double share = 0.5 * (1.0 + on_hemisphere_.z);
    const Number along_y =
        hn::MulAdd(number(1.0 - share), half_chord, hn::Mul(number(share), in_disc.y));
    const Number height = hn::Sqrt(hn::Mul(
        hn::Mul(number(share), above),
        hn::MulAdd(number(2.0 * (1.0 - share)), half_chord, hn::Mul(number(share), below))));
    const Directions local = {in_disc.x, along_y, height};
    const Directions h = to_world({x, y, on_hemisphere_}, local);
    return {h.x, h.y, hn::Max(zero, h.z)};
  }

  HWY_INLINE Directions of_cap(Number s, Number t) const {
    const Direction& v = on_hemisphere_;
    const double depth = bound_ * v.z;
    const Number from_edge = hn::Mul(hn::Sub(number(1.0), t), number(1.0 + depth));
    const Number z = hn::Sub(from_edge, number(depth));
    const Directions light = around_z(z, s);
    const Directions h = {hn::Add(number(v.x), light.x), hn::Add(number(v.y), light.y),
                          hn::Add(from_edge, number(v.z - depth))};
    const Direction aside = across(v) + 1e-7 * v;
    const auto opposite = hn::Lt(length_squared(h), number(1e-16));
    return {hn::IfThenElse(opposite, number(aside.x), h.x),
            hn::IfThenElse(opposite, number(aside.y), h.y),
            hn::IfThenElse(opposite, number(aside.z), h.z)};
  }

  Ggx material_;
  double alpha_;
  Frame frame_;
  Direction view_;  ///< local
  double view_length_;
  Direction on_hemisphere_;  ///< the view
  double bound_;             ///< of the cap; 1 where it is that of all visible normals
};

class BlinnKernel {
 public:
  BlinnKernel(const BlinnMicrofacet& material, const ShadingPoint& at)
      : normal_reflectance_(material.normal_reflectance),
        shininess_(blinn_shininess(material.roughness)),
        frame_(at.frame),
        view_(at.frame.to_local(at.view)) {}

  HWY_INLINE Scatterings evaluate(const Directions& world) const {
    const Number zero = hn::Zero(Numbers());
    const Directions light = to_local(frame_, world);
    const HalfVectors half = half_vectors(view_, light);
    const Number z = hn::Abs(half.normal.z);
    const Number d = hn::Mul(number((shininess_ + 2.0) / (2.0 * kPi)), to_shininess(half.normal));
    const Number lower = hn::Min(light.z, number(view_.z));
    const Number groove = hn::Div(hn::Mul(hn::Add(z, z), lower), half.cosine);
    const Number masking = hn::Mul(hn::Min(number(1.0), groove), number(0.25 / view_.z));
    const Number reflected =
        hn::Mul(hn::Mul(schlick_fresnels(normal_reflectance_, half.cosine), d), masking);
    const Number pdf = hn::Div(hn::Mul(d, z), hn::Mul(number(4.0), half.cosine));
    return {hn::IfThenElseZero(hn::Gt(light.z, zero), reflected), pdf};
  }

  HWY_INLINE Directions draw(Number s, Number t) const {
    const Numbers n;
    const Number log_cosine = hn::Mul(hn::Log1p(n, hn::Neg(t)), number(1.0 / (shininess_ + 2.0)));
    const Number sine = hn::Sqrt(hn::Neg(hn::Expm1(n, hn::Add(log_cosine, log_cosine))));
    const Directions h = on_ring(sine, hn::Exp(n, log_cosine), s);
    return to_world(frame_, mirrored_at(view_, h));
  }

 private:
  /// |n.h|^S; 0 to the power of 0 is 0, for a normal in the surface, whose density is 0.
  HWY_INLINE Number to_shininess(const Directions& h) const {
    const Numbers n;
    const Number aside = hn::MulAdd(h.x, h.x, square(h.y));
    const Number log_square = hn::IfThenElse(hn::Lt(aside, number(0.5)),
                                             hn::Log1p(n, hn::Neg(aside)), hn::Log(n, square(h.z)));
    return hn::Exp(n, hn::Mul(number(0.5 * shininess_), log_square));
  }

  double normal_reflectance_;
  double shininess_;
  Frame frame_;
  Direction view_;  ///< local
};

HWY_INLINE GgxKernel kernel_of(const Ggx& material, const ShadingPoint& at) {
  return {material, at};
}
HWY_INLINE BlinnKernel kernel_of(const BlinnMicrofacet& material, const ShadingPoint& at) {
  return {material, at};
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
