// Orthonormal frames around a unit normal n, by the constructions that renderers use, in single or
// double precision. All of them turn +z into n and are right-handed; they differ in the tangents
// and in what becomes of normals near the poles (0, 0, +-1), where a division by 1 + n.z or by the
// distance from the pole loses digits. core/direction.h's frame_around, by Duff et al., is the one
// to use; the others are here to be compared with it.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "lightproof/core/direction.h"

namespace lightproof {

template <class T>
using UnitVector = glm::vec<3, T>;

/// A frame in the precision T; core/direction.h's Frame is the one of doubles.
template <class T>
struct FrameOf {
  UnitVector<T> tangent;
  UnitVector<T> bitangent;
  UnitVector<T> normal;
};

inline Frame to_frame(const FrameOf<double>& frame) {
  return {frame.tangent, frame.bitangent, frame.normal};
}

/// Frisvad 2012, "Building an Orthonormal Basis from a 3D Unit Vector Without Normalization",
/// listing 2, with its own exception for n.z < -0.9999999. The entries divide by 1 + n.z: at a
/// distance d from the pole -z their error is some epsilon / d^2, and what the exception returns is
/// as far from orthogonal as n is from the pole, up to 4.5e-4.
template <class T>
FrameOf<T> frisvad_frame(UnitVector<T> n) {
  if (n.z < T(-0.9999999)) return {{0, -1, 0}, {-1, 0, 0}, n};
  const T a = T(1) / (T(1) + n.z);
  const T b = -n.x * n.y * a;
  return {{T(1) - n.x * n.x * a, b, -n.x}, {b, T(1) - n.y * n.y * a, -n.y}, n};
}

/// Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3: Frisvad's frame above
/// the horizon, its mirror image below, so that the divisor 1 + |n.z| is at least 1.
template <class T>
FrameOf<T> duff_frame(UnitVector<T> n) {
  const T sign = std::copysign(T(1), n.z);
  const T a = T(-1) / (sign + n.z);
  const T b = n.x * n.y * a;
  return {{T(1) + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

/// The reflection I - 2 w w^T that takes +z to -sign(n.z) n, w halfway between them (Householder
/// 1958); the sign is the one that cancels nothing. Its images of x and y span the plane across n.
template <class T>
FrameOf<T> householder_frame(UnitVector<T> n) {
  const T sign = std::copysign(T(1), n.z);
  const UnitVector<T> w = glm::normalize(UnitVector<T>(n.x, n.y, n.z + sign));
  const UnitVector<T> tangent = UnitVector<T>(1, 0, 0) - T(2) * w.x * w;
  const UnitVector<T> bitangent = UnitVector<T>(0, 1, 0) - T(2) * w.y * w;
  return {tangent, sign * bitangent, n};
}

/// The tangent z x n, normalised, and the bitangent n x tangent: the bare formula, not a number at
/// the poles.
template <class T>
FrameOf<T> bare_tangent_frame(UnitVector<T> n) {
  const T distance = std::hypot(n.x, n.y);
  const UnitVector<T> tangent = {-n.y / distance, n.x / distance, 0};
  return {tangent, glm::cross(n, tangent), n};
}

/// The frame of the tangent across z and n, n being a unit vector, with the tangent x at the poles.
template <class T>
FrameOf<T> tangent_frame(UnitVector<T> n) {
  if (n.x == T(0) && n.y == T(0)) return {{1, 0, 0}, {0, n.z, 0}, n};
  return bare_tangent_frame(n);
}

/// A rotation as a unit quaternion whose axis lies in the plane z = 0.
template <class T>
struct HorizontalQuaternion {
  T w;
  T x;
  T y;
};

/// The rotation of +z to n by the angle alpha around (-n.y, n.x, 0), cos(alpha) = n.z, as
/// (cos(alpha/2), axis sin(alpha/2)): the bare formula, not a number at the poles, where there is
/// no such axis.
template <class T>
HorizontalQuaternion<T> quaternion_from_z(UnitVector<T> n) {
  const T distance = std::hypot(n.x, n.y);
  const T sine = std::sqrt((T(1) - n.z) / T(2));
  return {std::sqrt((T(1) + n.z) / T(2)), -n.y / distance * sine, n.x / distance * sine};
}

/// The images of x and y under q v q^-1 (Hamilton).
template <class T>
FrameOf<T> bare_quaternion_frame(UnitVector<T> n) {
  const auto [w, x, y] = quaternion_from_z(n);
  return {{T(1) - T(2) * y * y, T(2) * x * y, T(-2) * w * y},
          {T(2) * x * y, T(1) - T(2) * x * x, T(2) * w * x},
          n};
}

/// The rotation of rotation_frame() written out as a matrix in n, which divides by 1 + n.z: the
/// axis is gone from it, and with it the exception at +z. Not a number at -z.
template <class T>
FrameOf<T> bare_rotation_frame(UnitVector<T> n) {
  const T d = T(1) + n.z;
  const T b = -n.x * n.y / d;
  return {{T(1) - n.x * n.x / d, b, -n.x}, {b, T(1) - n.y * n.y / d, -n.y}, n};
}

/// A frame by the matrix of a quaternion as published: the poles treated apart, the matrix
/// everywhere else, whose error near -z is some epsilon / d^2 at a distance d.
template <class T>
FrameOf<T> published_quaternion_frame(UnitVector<T> n) {
  if (n.x == T(0) && n.y == T(0)) return {{1, 0, 0}, {0, n.z, 0}, n};
  return bare_rotation_frame(n);
}

/// Corrected: below the horizon -n is rotated to, and then turned over by half a turn around x; the
/// divisor is 1 + |n.z|, and no normal is an exception.
template <class T>
FrameOf<T> quaternion_frame(UnitVector<T> n) {
  const bool turned = std::signbit(n.z);
  const FrameOf<T> upper = bare_rotation_frame(turned ? -n : n);
  return {upper.tangent, turned ? -upper.bitangent : upper.bitangent, n};
}

}  // namespace lightproof
