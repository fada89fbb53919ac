// How much of the light from all around a rough mirror reflects to one view, by adaptive quadrature
// over its normals.
#pragma once

#include "reference/uniform_chart.h"

namespace lightproof::reference {

/// The share of microfacets that is both seen and lit.
enum class Masking {
  smith_karis,              ///< GGX: product of mu / (mu (1 - k) + k), k = alpha/2 (Karis 2013)
  smith_separable,          ///< GGX: product of Smith's exact G1
  smith_height_correlated,  ///< GGX: 1 / (1 + Lambda(v) + Lambda(l)) (Heitz 2014, eq. 99)
  v_grooves,  ///< min(1, 2 (n.h)(n.v)/(v.h), 2 (n.h)(n.l)/(v.h)) (Cook & Torrance 1982)
};

struct RoughMirror {
  NormalDistribution normals;
  Masking masking;
};

/// ∫ f_r (n.l) dl = F0 scale + bias with Schlick's Fresnel factor; scale + bias is the white
/// furnace's, with the factor 1 (Karis 2013, eq. 8).
struct SplitSum {
  double scale;  ///< ∫ (1 - (1 - v.h)^5) D G / (4 (n.v)) dl
  double bias;   ///< ∫ (1 - v.h)^5 D G / (4 (n.v)) dl

  double white() const { return scale + bias; }
  double of(double normal_reflectance) const { return normal_reflectance * scale + bias; }
};

/// Scale and bias for a view of cosine `mu` in (0, 1] to the normal. Nested Gauss-Kronrod rules,
/// divided until they agree to 1e-7; with Smith's masking, which is smooth, errors are some 1e-8,
/// with the kinks of grooves up to 1e-5.
SplitSum split_sum(const RoughMirror& mirror, double mu);

}  // namespace lightproof::reference
