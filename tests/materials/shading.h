// Shading points and materials that the tests of the materials run over.
#pragma once

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "lightproof/materials/material.h"

namespace lightproof {

/// A point whose view is at this angle in radians from the normal, along no axis of its frame.
inline ShadingPoint shading_point(Direction normal, double view_angle) {
  const Frame frame = frame_around(normal);
  const Direction local = {0.6 * std::sin(view_angle), 0.8 * std::sin(view_angle),
                           std::cos(view_angle)};
  return {{0.0, 0.0, 0.0}, frame, frame.to_world(local)};
}

struct ShadingCase {
  std::string name;
  Material material;
  ShadingPoint at;
};

inline void PrintTo(const ShadingCase& value, std::ostream* out) { *out << value.name; }

/// Lambert, and the Phong model with exponents that are broad, middling and narrow and with either
/// lobe alone, at three angles of view over three normals.
inline std::vector<ShadingCase> shading_cases() {
  struct Named {
    std::string name;
    Material material;
  };
  const std::vector<Named> materials = {
      {"Lambert", Lambert{0.8}},
      {"Phong1", ModifiedPhong{0.3, 0.6, 1.0}},
      {"Phong10", ModifiedPhong{0.2, 0.3, 10.0}},
      {"Phong100", ModifiedPhong{0.3, 0.6, 100.0}},
      {"PhongSpecularOnly", ModifiedPhong{0.0, 0.7, 10.0}},
      {"PhongDiffuseOnly", ModifiedPhong{0.7, 0.0, 10.0}},
  };
  struct Normal {
    std::string name;
    Direction direction;
  };
  const std::vector<Normal> normals = {{"Up", {0, 0, 1}},
                                       {"Down", {0, 0, -1}},
                                       {"Oblique", glm::normalize(Direction(0.3, -0.5, 0.4))}};
  std::vector<ShadingCase> cases;
  for (const Named& material : materials) {
    for (const Normal& normal : normals) {
      for (const int degrees : {0, 45, 85}) {
        cases.push_back({material.name + normal.name + std::to_string(degrees), material.material,
                         shading_point(normal.direction, degrees * kPi / 180.0)});
      }
    }
  }
  return cases;
}

}  // namespace lightproof
