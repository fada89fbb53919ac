#include "reference/mapped_texels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lightproof/core/gauss_rule.h"
#include "lightproof/core/parallel.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof::reference {
namespace {

constexpr int kFaces = 6;

/// The t of Lightproof's frame of the edge below row y of rows around nodes.
double node_edge(int rows, double y) {
  const double at = (y - 0.5) / (rows - 1.0);
  return std::clamp(at, 0.0, 1.0);
}

/// The t of Lightproof's frame at a t of the square, in rows around nodes.
double node_height(int rows, double t) {
  const int row = std::clamp(static_cast<int>(t * rows), 0, rows - 1);
  const double low = node_edge(rows, row);
  return low + (t * rows - row) * (node_edge(rows, row + 1.0) - low);
}

/// Solid angle over a rectangle of the plane at distance 1 between the origin and (a, b).
double corner(double a, double b) { return std::atan2(a * b, std::sqrt(1.0 + a * a + b * b)); }

/// Solid angle between two t per unit of azimuth.
double band(double low, double high) {
  return 2.0 * sin_theta(0.5 * (low + high)) * std::sin(0.5 * kPi * (high - low));
}

double angle_between(Direction a, Direction b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// A point of a cell, moved towards its centre: its right edge may be another face's left one.
SquarePoint inside(const SquareCell& cell, SquarePoint at) {
  const auto [s, t] = cell.centre();
  return {s + (at.s - s) * (1.0 - 0x1p-40), t + (at.t - t) * (1.0 - 0x1p-40)};
}

/// A cap that covers a cell.
struct Cap {
  Direction centre;
  double radius;  ///< in radians
};

/// Edges of cells bend: what lies between a corner and the middle of an edge is nearer than both,
/// or farther by less than this factor, as is the inside of a cell that holds a pole.
constexpr double kBend = 1.25;

Cap cap_of(const Mapping& mapping, const SquareCell& cell) {
  const auto [s, t] = cell.centre();
  const Direction centre = direction_at(mapping, cell.centre());
  double radius = 0.0;
  for (const double u : {cell.left, s, cell.right}) {
    for (const double v : {cell.bottom, t, cell.top}) {
      const Direction d = direction_at(mapping, inside(cell, {u, v}));
      radius = std::max(radius, angle_between(centre, d));
    }
  }
  return {centre, kBend * radius};
}

int index_of(double coordinate, int count) {
  return std::clamp(static_cast<int>(coordinate * count), 0, count - 1);
}

struct Bin {
  int column;
  int row;
};

Bin bin_of(SquarePoint at, Extent bins) {
  return {index_of(at.s, bins.width), index_of(at.t, bins.height)};
}

/// Whether a cap lies in the bin of its centre, which is at `at`.
bool lies_in_one_bin(const Cap& cap, SquarePoint at, Extent bins) {
  constexpr double kLargest = 0.5;
  constexpr double kNever = 4.0;  // no cap is so large
  if (!(cap.radius < kLargest)) return false;
  const auto [column, row] = bin_of(at, bins);
  const double below = row == 0 ? kNever : at.t - static_cast<double>(row) / bins.height;
  const double above = row + 1 == bins.height ? kNever : (row + 1.0) / bins.height - at.t;
  if (kPi * std::min(below, above) <= cap.radius) return false;
  if (bins.width == 1) return true;
  const double sine = std::hypot(cap.centre.x, cap.centre.y);
  if (sine <= std::sin(cap.radius)) return false;
  const double aside = std::asin(std::sin(cap.radius) / sine);
  const double left = at.s - static_cast<double>(column) / bins.width;
  const double right = (column + 1.0) / bins.width - at.s;
  return 2.0 * kPi * std::min(left, right) > aside;
}

/// A cell divided into columns x rows equal ones.
template <class Visit>
void divide(const SquareCell& cell, int parts, const Visit& visit) {
  const double width = (cell.right - cell.left) / parts;
  const double height = (cell.top - cell.bottom) / parts;
  for (int j = 0; j < parts; ++j) {
    for (int i = 0; i < parts; ++i) {
      visit(SquareCell{cell.left + i * width, cell.left + (i + 1) * width, cell.bottom + j * height,
                       cell.bottom + (j + 1) * height});
    }
  }
}

/// A quadrilateral of the square as the image of a unit square, p from the edge (a0, a1) to the
/// edge (b0, b1), q along both. Where a0 = a1 it is a triangle.
struct Patch {
  SquarePoint a0;
  SquarePoint a1;
  SquarePoint b0;
  SquarePoint b1;
};

SquarePoint mix(SquarePoint a, SquarePoint b, double share) {
  return {a.s + (b.s - a.s) * share, a.t + (b.t - a.t) * share};
}

double cross(SquarePoint a, SquarePoint b) { return a.s * b.t - a.t * b.s; }

SquarePoint minus(SquarePoint a, SquarePoint b) { return {a.s - b.s, a.t - b.t}; }

/// Convex, its corners in order.
using Polygon = std::vector<SquarePoint>;

/// The part of a polygon to the left of the line from a to b.
Polygon left_of(const Polygon& polygon, SquarePoint a, SquarePoint b) {
  Polygon kept;
  const auto side = [&](SquarePoint p) { return cross(minus(b, a), minus(p, a)); };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const SquarePoint from = polygon[i];
    const SquarePoint to = polygon[(i + 1) % polygon.size()];
    const double first = side(from);
    const double second = side(to);
    if (first >= 0.0) kept.push_back(from);
    if ((first > 0.0 && second < 0.0) || (first < 0.0 && second > 0.0)) {
      kept.push_back(mix(from, to, first / (first - second)));
    }
  }
  return kept;
}

/// The eight triangles of an octahedral map in which it is smooth, the pole first.
std::vector<std::array<SquarePoint, 3>> octahedral_triangles() {
  std::vector<std::array<SquarePoint, 3>> triangles;
  for (const double s : {0.0, 1.0}) {
    for (const double t : {0.0, 1.0}) {
      const SquarePoint across = {s, 0.5};
      const SquarePoint along = {0.5, t};
      const bool turns_left = (s > 0.5) == (t > 0.5);
      const SquarePoint first = turns_left ? across : along;
      const SquarePoint second = turns_left ? along : across;
      triangles.push_back({SquarePoint{0.5, 0.5}, first, second});
      triangles.push_back({SquarePoint{s, t}, second, first});
    }
  }
  return triangles;
}

bool is_near(SquarePoint a, SquarePoint b) {
  return std::abs(a.s - b.s) < 1e-12 && std::abs(a.t - b.t) < 1e-12;
}

/// Triangles from one corner of a polygon: from this point, if it is one.
void add_fan(std::vector<Patch>& patches, Polygon polygon, SquarePoint preferred) {
  if (polygon.size() < 3) return;
  const auto found = std::find_if(polygon.begin(), polygon.end(),
                                  [&](SquarePoint p) { return is_near(p, preferred); });
  if (found != polygon.end()) std::rotate(polygon.begin(), found, polygon.end());
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    patches.push_back({polygon[0], polygon[0], polygon[i], polygon[i + 1]});
  }
}

/// The parts of a cell in which the mapping is smooth, and for each the pole whose rays are
/// straight in it, if there is one.
struct SmoothPart {
  Polygon polygon;
  SquarePoint pole;
};

std::vector<SmoothPart> smooth_parts(const Mapping& mapping, const SquareCell& cell) {
  const Polygon whole = {{cell.left, cell.bottom},
                         {cell.right, cell.bottom},
                         {cell.right, cell.top},
                         {cell.left, cell.top}};
  constexpr SquarePoint kNone = {-1.0, -1.0};
  if (mapping.kind != MappingKind::octahedral) return {{whole, kNone}};
  static const std::vector<std::array<SquarePoint, 3>> triangles = octahedral_triangles();
  std::vector<SmoothPart> parts;
  for (const auto& [pole, second, third] : triangles) {
    Polygon part = left_of(whole, pole, second);
    part = left_of(part, second, third);
    part = left_of(part, third, pole);
    if (part.size() >= 3) parts.push_back({std::move(part), pole});
  }
  return parts;
}

std::vector<Polygon> smooth_polygons(const Mapping& mapping, const SquareCell& cell) {
  std::vector<Polygon> polygons;
  for (SmoothPart& part : smooth_parts(mapping, cell)) polygons.push_back(std::move(part.polygon));
  return polygons;
}

std::vector<Patch> smooth_patches(const Mapping& mapping, const SquareCell& cell) {
  if (mapping.kind != MappingKind::octahedral) {
    return {{{cell.left, cell.bottom},
             {cell.left, cell.top},
             {cell.right, cell.bottom},
             {cell.right, cell.top}}};
  }
  std::vector<Patch> patches;
  for (SmoothPart& part : smooth_parts(mapping, cell)) {
    add_fan(patches, std::move(part.polygon), part.pole);
  }
  return patches;
}

struct CentreAndArea {
  SquarePoint centre;
  double area;
};

CentreAndArea centre_and_area(const Polygon& polygon) {
  double area = 0.0;
  SquarePoint moment = {0.0, 0.0};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const SquarePoint a = polygon[0];
    const SquarePoint b = polygon[i];
    const SquarePoint c = polygon[i + 1];
    const double part = 0.5 * std::abs(cross(minus(b, a), minus(c, a)));
    area += part;
    moment.s += part * (a.s + b.s + c.s) / 3.0;
    moment.t += part * (a.t + b.t + c.t) / 3.0;
  }
  return {{moment.s / area, moment.t / area}, area};
}

/// The place between a and b at which a function that has another sign at either becomes 0.
template <class Function>
SquarePoint crossing(SquarePoint a, SquarePoint b, double at_a, double at_b, const Function& f) {
  // Illinois' regula falsi: a few steps for a function that is all but linear.
  double low = 0.0;
  double high = 1.0;
  double share = 0.5;
  int kept = 0;  // the end that stayed in the last step
  for (int i = 0; i < 100; ++i) {
    share = (low * at_b - high * at_a) / (at_b - at_a);
    const double value = f(mix(a, b, share));
    if (std::abs(value) < 1e-15) break;
    if ((value > 0.0) == (at_b > 0.0)) {
      high = share;
      at_b = value;
      if (kept == -1) at_a *= 0.5;
      kept = -1;
    } else {
      low = share;
      at_a = value;
      if (kept == 1) at_b *= 0.5;
      kept = 1;
    }
    if (high - low < 1e-14) break;
  }
  return mix(a, b, share);
}

/// Cuts a polygon along the line on which a function is 0.
template <class Function>
void cut(std::vector<Polygon>& parts, const Polygon& polygon, const Function& f) {
  std::vector<double> values;
  for (const SquarePoint at : polygon) {
    const double value = f(at);
    values.push_back(std::abs(value) < 1e-13 ? 0.0 : value);
  }
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  if (*least >= 0.0 || *largest <= 0.0) {
    parts.push_back(polygon);
    return;
  }
  Polygon below;
  Polygon above;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = (i + 1) % polygon.size();
    if (values[i] <= 0.0) below.push_back(polygon[i]);
    if (values[i] >= 0.0) above.push_back(polygon[i]);
    if (values[i] * values[next] < 0.0) {
      const SquarePoint at = crossing(polygon[i], polygon[next], values[i], values[next], f);
      below.push_back(at);
      above.push_back(at);
    }
  }
  for (Polygon* part : {&below, &above}) {
    if (part->size() >= 3) parts.push_back(std::move(*part));
  }
}

/// The smooth parts of a cell, cut along the edges of bins.
std::vector<Polygon> cut_along_edges(const Mapping& mapping, const SquareCell& cell, Extent bins) {
  std::vector<Polygon> polygons = smooth_polygons(mapping, cell);
  std::vector<Polygon> parts;
  const auto cut_all = [&](const auto& f) {
    parts.clear();
    for (const Polygon& polygon : polygons) cut(parts, polygon, f);
    polygons.swap(parts);
  };
  for (int row = 1; row < bins.height; ++row) {
    const double edge = std::cos(kPi * row / bins.height);
    cut_all([&](SquarePoint at) { return direction_at(mapping, inside(cell, at)).z + edge; });
  }
  // The plane of an azimuth holds the opposite one as well: where it is no edge, what it cuts lies
  // in one bin all the same.
  for (int column = 0; column < bins.width; ++column) {
    if (bins.width % 2 == 0 && 2 * column >= bins.width) break;
    const double phi = kPi - 2.0 * kPi * column / bins.width;
    const double cosine = std::cos(phi);
    const double sine = std::sin(phi);
    cut_all([&](SquarePoint at) {
      // Where all of an edge is a pole its points have an azimuth nevertheless.
      const double t = rows_are_parallels(mapping) ? 0.5 : at.t;
      const Direction d = direction_at(mapping, inside(cell, {at.s, t}));
      return d.x * sine - d.y * cosine;
    });
  }
  return polygons;
}

const GaussRule<3>& rule() {
  static const GaussRule<3> gauss;
  return gauss;
}

/// How a texel is divided.
struct Division {
  int parts;       ///< of a texel's side
  int edge_parts;  ///< of the side of such a part where an edge may run
};

Division division_of(Extent map) {
  const auto side = [](Extent least, double cells) {
    return static_cast<int>(
        std::ceil(std::sqrt(static_cast<double>(least.count()) / cells) - 1e-9));
  };
  const auto texels = static_cast<double>(map.count());
  const int parts = std::max(1, side(SphereQuadrature::kLeastCells, texels));
  // An edge is a kink here, no jump: cells of 1/1024 leave 1e-6.
  constexpr Extent kLeastEdgeCells = {1024, 512};
  return {parts, std::max(1, side(kLeastEdgeCells, texels * parts * parts))};
}

}  // namespace

double cell_solid_angle(const Mapping& mapping, const SquareCell& cell) {
  switch (mapping.kind) {
    case MappingKind::octahedral:
      return kSphere * cell.area();
    case MappingKind::cube_strip: {
      const int face = index_of(cell.centre().s, kFaces);
      const auto offset = [](double u) { return 2.0 * u - 1.0; };
      const double a0 = offset(cell.left * kFaces - face);
      const double a1 = offset(cell.right * kFaces - face);
      const double b0 = offset(cell.bottom);
      const double b1 = offset(cell.top);
      return corner(a1, b1) - corner(a0, b1) - corner(a1, b0) + corner(a0, b0);
    }
    case MappingKind::node_rows:
      return 2.0 * kPi * (cell.right - cell.left) *
             band(node_height(mapping.rows, cell.bottom), node_height(mapping.rows, cell.top));
    case MappingKind::lat_long:
      break;
  }
  return 2.0 * kPi * (cell.right - cell.left) * band(cell.bottom, cell.top);
}

void visit_binned_parts(const Mapping& mapping, const SquareCell& texel, int depth, Extent bins,
                        const std::function<void(const BinnedPart&)>& visit) {
  const Cap cap = cap_of(mapping, texel);
  const SquarePoint at = square_from_direction(cap.centre);
  if (lies_in_one_bin(cap, at, bins)) {
    const auto [column, row] = bin_of(at, bins);
    visit({texel.centre(), texel.area(), column, row, true});
    return;
  }
  if (depth > 0) {
    divide(texel, 2, [&](const SquareCell& quarter) {
      visit_binned_parts(mapping, quarter, depth - 1, bins, visit);
    });
    return;
  }
  for (const Polygon& polygon : cut_along_edges(mapping, texel, bins)) {
    const auto [centre, area] = centre_and_area(polygon);
    if (!(area > 0.0)) continue;
    const auto [column, row] = bin_of(square_from_direction(direction_at(mapping, centre)), bins);
    visit({centre, area, column, row, false});
  }
}

int depth_of_parts(const Mapping& mapping, Extent texels) {
  if (mapping.kind != MappingKind::cube_strip) return 1;
  constexpr double kParts = 0x1p19;
  const double quarters = 0.5 * std::log2(kParts / static_cast<double>(texels.count()));
  return std::max(2, static_cast<int>(std::ceil(quarters)));
}

std::vector<BinnedPart> binned_parts(const Mapping& mapping, Extent texels, Extent bins) {
  const int depth = depth_of_parts(mapping, texels);
  std::vector<std::vector<BinnedPart>> rows(static_cast<std::size_t>(texels.height));
  parallel_for(rows.size(), [&](std::size_t row) {
    for (int x = 0; x < texels.width; ++x) {
      visit_binned_parts(mapping, texel_cell(texels, x, static_cast<int>(row)), depth, bins,
                         [&](const BinnedPart& part) { rows[row].push_back(part); });
    }
  });
  std::vector<BinnedPart> all;
  for (const std::vector<BinnedPart>& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

namespace {

/// Adds a part's share of a texel's mass, and where it may lie as well.
void add_part(BinnedMasses& binned, const BinnedPart& part, double share) {
  const Extent bins = binned.masses.extent();
  binned.masses(part.column, part.row) += share;
  if (part.is_whole) return;
  // It may lie in any of the neighbours as well.
  const bool at_pole = part.row == 0 || part.row + 1 == bins.height;
  for (int j = std::max(part.row - 1, 0); j <= std::min(part.row + 1, bins.height - 1); ++j) {
    for (int i = 0; i < bins.width; ++i) {
      const int apart = std::abs(i - part.column);
      if (at_pole || std::min(apart, bins.width - apart) <= 1) binned.bound(i, j) += share;
    }
  }
}

}  // namespace

BinnedMasses binned_masses(const Grid<double>& texel_masses, const Mapping& mapping, Extent bins) {
  const Extent extent = texel_masses.extent();
  const int depth = depth_of_parts(mapping, extent);
  std::vector<BinnedMasses> rows(static_cast<std::size_t>(extent.height),
                                 {Grid<double>(bins), Grid<double>(bins)});
  parallel_for(rows.size(), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < extent.width; ++x) {
      const double mass = texel_masses(x, y);
      if (mass == 0.0) continue;
      const SquareCell texel = texel_cell(extent, x, y);
      const double density = mass / texel.area();
      visit_binned_parts(mapping, texel, depth, bins, [&](const BinnedPart& part) {
        add_part(rows[row], part, density * part.area);
      });
    }
  });
  BinnedMasses all{Grid<double>(bins), Grid<double>(bins)};
  for (const BinnedMasses& row : rows) {
    for (std::size_t i = 0; i < bins.count(); ++i) {
      all.masses.values()[i] += row.masses.values()[i];
      all.bound.values()[i] += row.bound.values()[i];
    }
  }
  return all;
}

std::vector<BinShares::Share> BinShares::shares_of(const Mapping& mapping, const SquareCell& cell,
                                                   int depth, std::size_t texel) const {
  std::vector<Share> shares;
  visit_binned_parts(mapping, cell, depth, bins_, [&](const BinnedPart& part) {
    const auto bin = static_cast<std::size_t>(part.row * bins_.width + part.column);
    const auto found = std::find_if(shares.begin(), shares.end(),
                                    [&](const Share& share) { return share.bin == bin; });
    if (found == shares.end()) {
      shares.push_back({texel, bin, part.area / cell.area()});
    } else {
      found->share += part.area / cell.area();
    }
  });
  return shares;
}

BinShares::BinShares(const Mapping& mapping, Extent texels, Extent bins)
    : bins_(bins), bin_of_texel_(texels.count(), -1) {
  const int depth = depth_of_parts(mapping, texels);
  std::vector<std::vector<Share>> rows(static_cast<std::size_t>(texels.height));
  parallel_for(rows.size(), [&](std::size_t row) {
    for (int x = 0; x < texels.width; ++x) {
      const std::size_t texel =
          row * static_cast<std::size_t>(texels.width) + static_cast<std::size_t>(x);
      const SquareCell cell = texel_cell(texels, x, static_cast<int>(row));
      const std::vector<Share> shares = shares_of(mapping, cell, depth, texel);
      if (shares.size() == 1) {
        bin_of_texel_[texel] = static_cast<std::int32_t>(shares.front().bin);
      } else {
        rows[row].insert(rows[row].end(), shares.begin(), shares.end());
      }
    }
  });
  for (const std::vector<Share>& row : rows) shares_.insert(shares_.end(), row.begin(), row.end());
}

Grid<double> BinShares::masses(const Grid<double>& texel_masses) const {
  Grid<double> masses(bins_);
  const auto texels = texel_masses.values();
  for (std::size_t i = 0; i < texels.size(); ++i) {
    if (bin_of_texel_[i] >= 0) {
      masses.values()[static_cast<std::size_t>(bin_of_texel_[i])] += texels[i];
    }
  }
  for (const Share& share : shares_) {
    masses.values()[share.bin] += share.share * texels[share.texel];
  }
  return masses;
}

void visit_nodes(const Mapping& mapping, const SquareCell& cell,
                 const std::function<void(const Node&)>& visit) {
  std::vector<Node> nodes;
  double sum = 0.0;
  for (const Patch& patch : smooth_patches(mapping, cell)) {
    for (const GaussNode& p : rule().nodes()) {
      const SquarePoint left = mix(patch.a0, patch.b0, p.at);
      const SquarePoint right = mix(patch.a1, patch.b1, p.at);
      for (const GaussNode& q : rule().nodes()) {
        const SquarePoint at = mix(left, right, q.at);
        const SquarePoint along_p = mix(minus(patch.b0, patch.a0), minus(patch.b1, patch.a1), q.at);
        const double area = p.weight * q.weight * std::abs(cross(along_p, minus(right, left)));
        const double jacobian = solid_angle_per_square(mapping, at);
        nodes.push_back(
            {direction_at(mapping, at), jacobian / (2.0 * kPi * kPi), area * jacobian, at});
        sum += area * jacobian;
      }
    }
  }
  const double scale = cell_solid_angle(mapping, cell) / sum;
  for (Node& node : nodes) {
    node.solid_angle *= scale;
    visit(node);
  }
}

void visit_kernel(const Kernel& kernel, const Mapping& mapping, Extent map, const SquareCell& texel,
                  const std::function<void(const Node&, const KernelValue&)>& add) {
  const Division division = division_of(map);
  divide(texel, division.parts, [&](const SquareCell& part) {
    const Cap cap = cap_of(mapping, part);
    const bool split = kernel.straddles(cap.centre, cap.radius);
    if (!split && kernel.is_lit && !kernel.is_lit(cap.centre)) return;
    divide(part, split ? division.edge_parts : 1, [&](const SquareCell& cell) {
      visit_nodes(mapping, cell, [&](const Node& node) {
        if (split && kernel.is_lit && !kernel.is_lit(node.direction)) return;
        const KernelValue value = kernel.at(node.direction);
        if (value.k > 0.0) add(node, value);
      });
    });
  });
}

double jacobian_integral(const Mapping& mapping, Extent map, const SquareCell& texel) {
  double sum = 0.0;
  divide(texel, division_of(map).parts, [&](const SquareCell& part) {
    visit_nodes(mapping, part, [&](const Node& node) {
      sum += node.solid_angle * node.sin_theta * 2.0 * kPi * kPi;
    });
  });
  return sum;
}

double largest_jacobian(const Mapping& mapping, Extent map, const SquareCell& texel) {
  double largest = 0.0;
  divide(texel, division_of(map).parts, [&](const SquareCell& part) {
    visit_nodes(mapping, part, [&](const Node& node) {
      largest = std::max(largest, node.sin_theta * 2.0 * kPi * kPi);
    });
  });
  return largest;
}

}  // namespace lightproof::reference
