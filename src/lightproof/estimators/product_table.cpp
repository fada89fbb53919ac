#include "lightproof/estimators/product_table.h"

#include "lightproof/estimators/cell_cdf.h"
#include "lightproof/estimators/tabulated_source.h"
#include "lightproof/estimators/texel_directions.h"
#include "lightproof/samplers/texel_positions.h"
#include "lightproof/samplers/texel_weights.h"

namespace lightproof {
namespace {

/// What is kept of the map.
struct Light {
  explicit Light(const EnvironmentMap& map)
      : weights(texel_weights(map, on_map({DensitySpace::solid_angle}, map))),
        positions(weights.extent(), DensitySpace::solid_angle),
        centres(cell_size(weights.extent()), 0.5, weights.extent()),
        corners(cell_size(weights.extent()), 0.0,
                {weights.extent().width + 1, weights.extent().height + 1}) {
    for (const double weight : weights.values()) sum += weight;
  }
  std::size_t bytes() const {
    return weights.values().size_bytes() + positions.bytes() + centres.bytes() + corners.bytes();
  }

  Grid<double> weights;  ///< luminance times solid angle
  double sum = 0.0;
  TexelPositions positions;
  TexelDirections centres;
  TexelDirections corners;
};

/// The mean of k over each texel, half by its centre and half by its corners.
Grid<double> means_of_k(const Light& light, const Material& material, const ShadingPoint& at) {
  const Extent extent = light.weights.extent();
  const auto width = static_cast<std::size_t>(extent.width);
  Grid<double> k = Grid<double>::without_values(extent);
  std::vector<double> below(width + 1);
  std::vector<double> above(width + 1);
  light.corners.reflected(material, at, 0, below);
  for (int y = 0; y < extent.height; ++y) {
    light.centres.reflected(material, at, y, k.row(y));
    light.corners.reflected(material, at, y + 1, above);
    const std::span<double> row = k.row(y);
    for (std::size_t x = 0; x < width; ++x) {
      const double corners = below[x] + below[x + 1] + above[x] + above[x + 1];
      row[x] = 0.5 * row[x] + 0.125 * corners;
    }
    std::swap(below, above);
  }
  return k;
}

CellCdf product_of(const Light& light, const Material& material, const ShadingPoint& at) {
  Grid<double> product = means_of_k(light, material, at);
  const std::span<double> values = product.values();
  const std::span<const double> weights = light.weights.values();
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += values[i] * weights[i];
  const double least = sum > 0.0 ? kProductTableShare * sum / light.sum : 1.0;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = (values[i] + least) * weights[i];
  return CellCdf(std::move(product));
}

/// What is kept of the map, and the tables of points.
class Product {
 public:
  explicit Product(const EnvironmentMap& map) : light_(map) {}

  std::size_t bytes() const { return light_.bytes(); }
  CellCdf table(const Material& material, const ShadingPoint& at) const {
    return product_of(light_, material, at);
  }
  LightSample sample(const CellCdf& table, SquarePoint u) const {
    return light_.positions.direction(table.draw(u));
  }

 private:
  Light light_;
};

}  // namespace

PreparedSource product_table_source(const EnvironmentMap& map) {
  return tabulated_source<Product>(map);
}

}  // namespace lightproof
