#include "lightproof/samplers/linear_scan_published.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "lightproof/samplers/texel_weights.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

using Stop = LinearScanPublished::Stop;

/// How far a random number lies between the sums around it.
float fraction_between(float previous, float u, float sum) {
  return (u - previous) / (sum - previous);
}

template <class Probability>
Stop scan(int count, float u, const Probability& probability) {
  float sum = 0.0F;
  float previous = 0.0F;
  int index = 0;
  for (; index < count; ++index) {
    sum += probability(index) / static_cast<float>(count);
    if (sum >= u) break;
    previous = sum;
  }
  return {index, fraction_between(previous, u, sum)};
}

/// All sums of such a scan; none if they do not rise to the end, as where one is not a number.
template <class Probability>
std::vector<float> running_sums(int count, const Probability& probability) {
  std::vector<float> sums;
  sums.reserve(static_cast<std::size_t>(count));
  float sum = 0.0F;
  for (int index = 0; index < count; ++index) {
    sum += probability(index) / static_cast<float>(count);
    sums.push_back(sum);
  }
  const bool rises = std::ranges::is_sorted(sums) && std::isfinite(sum);
  return rises ? sums : std::vector<float>();
}

/// Where a scan stops, by its sums.
Stop stop_among(const std::vector<float>& sums, float u) {
  const auto at = std::ranges::lower_bound(sums, u);
  const float previous = at == sums.begin() ? 0.0F : *(at - 1);
  const auto index = static_cast<int>(at - sums.begin());
  return {index, at == sums.end() ? fraction_between(previous, u, previous)
                                  : fraction_between(previous, u, *at)};
}

/// The shader's random numbers are floats in [0,1): drop the bits that do not fit.
float to_shader_random(double u) { return static_cast<float>(std::floor(u * 0x1p24) * 0x1p-24); }

}  // namespace

LinearScanPublished::LinearScanPublished(const EnvironmentMap& map, TargetDensity target)
    : LinearScanPublished(map, target, AsListed{}) {
  const bool is_possible = std::ranges::all_of(map.radiance.values(), [&](const Rgb& rgb) {
    const float weight = glm::dot(weights_, rgb);
    return weight >= 0.0F && std::isfinite(weight);
  });
  if (!is_possible) refuse_impossible(map);
  if (!(total_average_ > 0.0F)) refuse_black(map);
}

LinearScanPublished::LinearScanPublished(const EnvironmentMap& map, TargetDensity target,
                                         AsListed /*unguarded*/)
    : map_(&map),
      position_measure_(position_measure(target.density_space, map.mapping)),
      solid_angle_rows_(map.radiance.extent()),
      weights_(target.weights.red, target.weights.green, target.weights.blue),
      weighs_each_texel_(texel_measure(target.density_space, map.mapping) ==
                             MapMeasure::solid_angle &&
                         !rows_are_parallels(map.mapping)) {
  const Extent extent = map.radiance.extent();
  const auto columns = static_cast<float>(extent.width);
  float total = 0.0F;
  for (int y = 0; y < extent.height; ++y) {
    const bool is_one = weighs_each_texel_ ||
                        texel_measure(target.density_space, map.mapping) == MapMeasure::square;
    row_factor_.push_back(
        is_one ? 1.0F : static_cast<float>(texel_solid_angle(map.mapping, extent, 0, y)));
    float sum = 0.0F;
    for (int x = 0; x < extent.width; ++x) sum += weight(x, y);
    row_average_.push_back(sum / columns);
    total += row_average_.back();
  }
  total_average_ = total / static_cast<float>(extent.height);
}

float LinearScanPublished::weight(int x, int y) const {
  const float factor =
      weighs_each_texel_
          ? static_cast<float>(texel_solid_angle(map_->mapping, map_->radiance.extent(), x, y))
          : row_factor_[static_cast<std::size_t>(y)];
  return glm::dot(weights_, map_->radiance(x, y)) * factor;
}

float LinearScanPublished::average_of(int y) const {
  // After a scan that ran off the end the shader still holds the last row's average.
  const auto last = row_average_.size() - 1;
  return row_average_[std::min(static_cast<std::size_t>(y), last)];
}

float LinearScanPublished::row_probability(int y) const { return average_of(y) / total_average_; }

float LinearScanPublished::column_probability(int x, int y) const {
  const bool fetch_is_inside = y < map_->radiance.extent().height;
  return (fetch_is_inside ? weight(x, y) : 0.0F) / average_of(y);
}

TexelSample LinearScanPublished::sample(SquarePoint u) const {
  const Extent extent = map_->radiance.extent();
  const Stop row =
      scan(extent.height, to_shader_random(u.t), [this](int y) { return row_probability(y); });
  const Stop column = scan(extent.width, to_shader_random(u.s),
                           [&](int x) { return column_probability(x, row.index); });
  return sample_at(row, column);
}

TexelSample LinearScanPublished::sample_at(Stop row, Stop column) const {
  const Extent extent = map_->radiance.extent();
  const float s =
      (static_cast<float>(column.index) + column.fraction) / static_cast<float>(extent.width);
  const float t =
      (static_cast<float>(row.index) + row.fraction) / static_cast<float>(extent.height);
  SquarePoint at = {static_cast<double>(s), static_cast<double>(t)};
  const bool on_map = column.index < extent.width && row.index < extent.height && at.s >= 0.0 &&
                      at.s < 1.0 && at.t >= 0.0 && at.t < 1.0;
  if (!on_map) return {at, column.index, row.index, PerSquare{0.0}};
  if (position_measure_ == MapMeasure::solid_angle) {
    at.t = solid_angle_rows_.position(row.index, static_cast<double>(row.fraction)).t;
  }
  return {at, column.index, row.index, pdf_in(column.index, row.index, at)};
}

PerSquare LinearScanPublished::pdf(SquarePoint at) const {
  const Extent extent = map_->radiance.extent();
  return pdf_in(cell_of(at.s, extent.width), cell_of(at.t, extent.height), at);
}

PerSquare LinearScanPublished::pdf_in(int x, int y, SquarePoint at) const {
  if (position_measure_ == MapMeasure::square) {
    return {static_cast<double>(weight(x, y) / total_average_)};
  }
  const double mass = static_cast<double>(weight(x, y) / total_average_) /
                      static_cast<double>(map_->radiance.extent().count());
  return to_square(PerSteradian{mass / texel_solid_angle(map_->radiance.extent(), y)}, at);
}

std::size_t LinearScanPublished::table_bytes() const {
  return map_->radiance.extent().count() * sizeof(Rgb) + row_average_.size() * sizeof(float);
}

/// The sums of the columns of each row, once a sample has needed them.
struct CachedScan::Sums {
  struct Row {
    std::once_flag summed;
    std::vector<float> sums;
  };

  explicit Sums(int height) : of_columns(static_cast<std::size_t>(height)) {}

  std::vector<float> of_rows;
  std::vector<Row> of_columns;
};

CachedScan::CachedScan(LinearScanPublished scan)
    : scan_(std::move(scan)), sums_(std::make_unique<Sums>(scan_.extent().height)) {
  sums_->of_rows =
      running_sums(scan_.extent().height, [this](int y) { return scan_.row_probability(y); });
}

CachedScan::CachedScan(CachedScan&&) noexcept = default;
CachedScan::~CachedScan() = default;

TexelSample CachedScan::sample(SquarePoint u) const {
  const Extent extent = scan_.extent();
  if (sums_->of_rows.empty()) return scan_.sample(u);
  const Stop row = stop_among(sums_->of_rows, to_shader_random(u.t));
  if (row.index == extent.height) return scan_.sample(u);
  Sums::Row& columns = sums_->of_columns[static_cast<std::size_t>(row.index)];
  std::call_once(columns.summed, [&] {
    columns.sums =
        running_sums(extent.width, [&](int x) { return scan_.column_probability(x, row.index); });
  });
  if (columns.sums.empty()) return scan_.sample(u);
  return scan_.sample_at(row, stop_among(columns.sums, to_shader_random(u.s)));
}

static_assert(EnvSampler<LinearScanPublished>);
static_assert(EnvSampler<CachedScan>);

}  // namespace lightproof
