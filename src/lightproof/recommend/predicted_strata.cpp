#include "lightproof/recommend/predicted_strata.h"

#include "lightproof/estimators/cell_cdf.h"
#include "lightproof/materials/material_batch.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/warp/lat_long.h"
#include "lightproof/warp/sphere_batch.h"

namespace lightproof {

PredictedStrata::PredictedStrata(const MapSummary& summary, const Material& material)
    : summary_(&summary),
      material_(material),
      s_(kStrataPoints),
      t_(kStrataPoints),
      map_x_(kStrataPoints),
      map_y_(kStrataPoints),
      map_z_(kStrataPoints) {
  const std::vector<SquarePoint> points = strata_points();
  const Grid<float>& map = summary.finest;
  const auto [width, height] = map.extent();
  std::vector<double> rows;
  double sum = 0.0;
  for (int y = 0; y < height; ++y) {
    double row = 0.0;
    for (const float luminance : map.row(y)) row += static_cast<double>(luminance);
    rows.push_back(sum += row * texel_solid_angle(map.extent(), y));
  }
  std::vector<double> columns(static_cast<std::size_t>(width));
  for (std::size_t i = 0; i < points.size(); ++i) {
    s_[i] = points[i].s;
    t_[i] = points[i].t;
    const FoundCell row = find_cell(rows, 0.0, points[i].t);
    if (i % kStrataSide == 0) {
      double before = 0.0;
      for (int x = 0; x < width; ++x) {
        columns[static_cast<std::size_t>(x)] = before +=
            static_cast<double>(map(x, static_cast<int>(row.index)));
      }
    }
    const FoundCell column = find_cell(columns, 0.0, points[i].s);
    const Direction d =
        direction_from_square({(static_cast<double>(column.index) + column.rest) / width,
                               (static_cast<double>(row.index) + row.rest) / height});
    map_x_[i] = d.x;
    map_y_[i] = d.y;
    map_z_[i] = d.z;
  }
}

StrataVariances PredictedStrata::of_map(const ShadingPoint& at) const {
  std::vector<double> values(kStrataPoints);
  reflected_cosines(material_, at, {map_x_, map_y_, map_z_}, values);
  for (double& value : values) value *= summary_->light;
  return variances_inside(values);
}

StrataVariances PredictedStrata::of_lobes(const ShadingPoint& at) const {
  std::vector<double> x(kStrataPoints);
  std::vector<double> y(kStrataPoints);
  std::vector<double> z(kStrataPoints);
  std::vector<double> pdf(kStrataPoints);
  std::vector<double> values(kStrataPoints);
  sample_material(material_, at, s_, t_, {x, y, z, pdf, values});
  std::vector<double> s(kStrataPoints);
  std::vector<double> t(kStrataPoints);
  approximate_positions(x, y, z, {s, t});
  const Extent extent = summary_->finest.extent();
  for (std::size_t i = 0; i < kStrataPoints; ++i) {
    const auto luminance = static_cast<double>(
        summary_->finest(cell_of(s[i], extent.width), cell_of(t[i], extent.height)));
    values[i] = pdf[i] > 0.0 ? values[i] * luminance / pdf[i] : 0.0;
  }
  return variances_inside(values);
}

}  // namespace lightproof
