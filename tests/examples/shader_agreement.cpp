// Does a shader draw what linear_scan_published does at the same random numbers?
// Usage: shader_agreement write MAP WxH COUNT FOLDER
//        shader_agreement compare MAP WxH RANDOM.f32 SAMPLES.f32
//
// `write` makes map.f32 (three floats a texel, from the lowest row up) and random.f32 (two floats
// in [0,1) a sample): the edges of the sums first, then random ones. `compare` reads what a shader
// drew at them: s, t, pdf, y (W + 1) + x of the texel.
//
// Both may round otherwise. GLSL ES (3.20, 4.7.1) rounds sums and products by at most one unit in
// the last place, quotients by two and a half. A sum of n terms of two quotients of a sum of three
// products is then off by at most n + 8 units, whoever computes it: where exact sums, of the
// averages that both are given, are farther than that from a random number, its texel is certain.
// Exit status 1 if any sample lies in another one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "lightproof/core/error.h"
#include "lightproof/core/random.h"
#include "lightproof/image/reader.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/samplers/linear_scan_published.h"

namespace lightproof {
namespace {

constexpr TargetDensity kPublished = {DensitySpace::texture, kPublishedLuminance};
/// The largest relative error of one rounding that GLSL ES allows to sums and products.
constexpr double kRounding = 0x1p-23;
const glm::vec3 kWeights(kPublishedLuminance.red, kPublishedLuminance.green,
                         kPublishedLuminance.blue);
/// Roundings of a term: two quotients of two and a half each, three of the luminance.
constexpr double kRoundingsOfTerm = 8.0;

EnvironmentMap map_named(const std::string& name, const std::string& size) {
  const Extent extent = {std::stoi(size), std::stoi(size.substr(size.find('x') + 1))};
  for (const SyntheticMap& known : synthetic_maps()) {
    if (known.name == name) return known.make(extent);
  }
  return read_environment_map(name, {.repair = Repair::zero});
}

std::vector<float> read_floats(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file + ": cannot be read");
  const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
  std::vector<float> numbers(bytes.size() / sizeof(float));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(float));
  return numbers;
}

void write_floats(const std::string& file, std::span<const float> numbers) {
  std::ofstream stream(file, std::ios::binary);
  const auto bytes = std::as_bytes(numbers);
  stream.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  if (!stream.flush()) throw InputError(file + ": cannot be written");
}

/// Where the sums of a scan lie, exactly, and which cells roundings may turn a random number to.
class Sums {
 public:
  explicit Sums(std::span<const double> masses) : before_{0.0} {
    for (const double mass : masses) before_.push_back(before_.back() + mass);
  }

  int count() const { return static_cast<int>(before_.size()) - 1; }
  double before(int cell) const { return before_[static_cast<std::size_t>(cell)]; }
  double mass(int cell) const { return before(cell + 1) - before(cell); }

  /// By how much, relative, the sum of the cells before this one may be off.
  static double error(int cell) { return kRounding * (cell + kRoundingsOfTerm); }

  /// Whether a scan may stop at the cell; count() means that it runs off.
  bool may_stop(int cell, double u) const {
    const bool reaches_it = cell == 0 || u > before(cell) * (1.0 - error(cell));
    if (cell == count()) return reaches_it;
    if (!(mass(cell) > 0.0)) return cell == 0 && u == 0.0;
    return reaches_it && u <= before(cell + 1) * (1.0 + error(cell + 1));
  }

  /// How far positions inside the cell may lie apart, in cells.
  double position_error(int cell) const {
    const double of_sums = before(cell + 1) * error(cell + 1) / mass(cell);
    return 4.0 * of_sums + 8.0 * kRounding * (1.0 + cell);
  }

 private:
  std::vector<double> before_;
};

/// The sums of rows, and of the columns of each, from the averages that a host program computes in
/// float.
struct MapSums {
  explicit MapSums(const EnvironmentMap& map) : rows({}) {
    const Extent extent = map.radiance.extent();
    float total = 0.0F;
    for (int y = 0; y < extent.height; ++y) {
      float sum = 0.0F;
      for (const Rgb& rgb : map.radiance.row(y)) sum += glm::dot(kWeights, rgb);
      row_averages.push_back(sum / static_cast<float>(extent.width));
      total += row_averages.back();
    }
    average = total / static_cast<float>(extent.height);
    std::vector<double> masses;
    for (int y = 0; y < extent.height; ++y) {
      const double row_average = static_cast<double>(row_averages[static_cast<std::size_t>(y)]);
      masses.push_back(row_average / static_cast<double>(average) / extent.height);
      std::vector<double> in_row;
      for (const Rgb& rgb : map.radiance.row(y)) {
        in_row.push_back(glm::dot(glm::dvec3(kWeights), glm::dvec3(rgb)) / row_average /
                         extent.width);
      }
      columns.emplace_back(in_row);
    }
    rows = Sums(masses);
  }

  std::vector<float> row_averages;
  float average = 0.0F;
  Sums rows;
  std::vector<Sums> columns;  ///< those of a row without light are not numbers
};

/// The index at which a published scan over these terms stops.
template <class Term>
int stop_of(int count, float u, const Term& term) {
  float sum = 0.0F;
  for (int i = 0; i < count; ++i) {
    sum += term(i) / static_cast<float>(count);
    if (sum >= u) return i;
  }
  return count;
}

/// The texel of a published scan whose luminances are summed from blue to red, as some drivers do.
Extent texel_from_blue(const EnvironmentMap& map, const MapSums& sums, SquarePoint u) {
  const Extent extent = map.radiance.extent();
  const int y = stop_of(extent.height, static_cast<float>(u.t), [&](int row) {
    return sums.row_averages[static_cast<std::size_t>(row)] / sums.average;
  });
  const int held = std::min(y, extent.height - 1);
  const float row_average = sums.row_averages[static_cast<std::size_t>(held)];
  const int x = stop_of(extent.width, static_cast<float>(u.s), [&](int column) {
    if (y == extent.height) return 0.0F;
    const Rgb& rgb = map.radiance(column, y);
    return (kWeights.b * rgb.b + kWeights.g * rgb.g + kWeights.r * rgb.r) / row_average;
  });
  return {x, y};
}

float on_grid(double u) {
  const double below_one = std::clamp(u, 0.0, 1.0 - 0x1p-24);
  return static_cast<float>(std::floor(below_one * 0x1p24) * 0x1p-24);
}

/// Zero, the least and the largest number, and those around the sums.
std::vector<float> edges_of(const Sums& sums) {
  std::vector<float> edges = {0.0F, 0x1p-24F, 1.0F - 0x1p-24F};
  for (int cell = 1; cell <= sums.count(); ++cell) {
    for (const double step : {-0x1p-24, 0.0, 0x1p-24}) {
      edges.push_back(on_grid(sums.before(cell) + step));
    }
  }
  return edges;
}

std::vector<float> random_numbers(const MapSums& sums, std::size_t count) {
  std::vector<float> numbers;
  for (const float t : edges_of(sums.rows)) {
    for (const float s : {0.0F, 0x1p-24F, 0.5F, 1.0F - 0x1p-24F}) {
      numbers.insert(numbers.end(), {s, t});
    }
  }
  for (std::size_t y = 0; y < sums.columns.size(); ++y) {
    const int row = static_cast<int>(y);
    if (!(sums.rows.mass(row) > 0.0)) continue;
    const float t = on_grid(sums.rows.before(row) + 0.5 * sums.rows.mass(row));
    for (const float s : edges_of(sums.columns[y])) numbers.insert(numbers.end(), {s, t});
  }
  const RandomStream stream("shader agreement", 1);
  for (std::size_t i = 0; i < count; ++i) {
    const SquarePoint u = stream.point(i);
    numbers.insert(numbers.end(), {on_grid(u.s), on_grid(u.t)});
  }
  return numbers;
}

struct Counts {
  std::size_t samples = 0;
  std::size_t ours_beside = 0;
  std::size_t shaders_beside = 0;
  std::size_t both_beside = 0;
  std::size_t ours_not_numbers = 0;
  std::size_t shaders_not_numbers = 0;
  std::size_t same_texel = 0;
  std::size_t same_from_blue = 0;  ///< that of texel_from_blue()
  std::size_t same_position = 0;   ///< to the last bit
  std::size_t other_texel = 0;     ///< where roundings may choose either
  std::size_t wrong = 0;
  double worst_position = 0.0;  ///< over what roundings allow
};

/// One sample of the shader: s, t, pdf, texel.
struct Shaders {
  explicit Shaders(std::span<const float, 4> numbers, int width)
      : s(numbers[0]),
        t(numbers[1]),
        x(static_cast<int>(numbers[3]) % (width + 1)),
        y(static_cast<int>(numbers[3]) / (width + 1)) {}
  float s, t;
  int x, y;
};

bool is_number(double s, double t) { return !std::isnan(s) && !std::isnan(t); }

class Comparison {
 public:
  explicit Comparison(const EnvironmentMap& map)
      : map_(map), extent_(map.radiance.extent()), sampler_(map, kPublished), sums_(map) {}

  void add(SquarePoint u, const Shaders& shaders) {
    const TexelSample ours = sampler_.sample(u);
    const bool ours_is_beside = !is_on_map(ours.x, ours.y);
    const bool shaders_is_beside = !is_on_map(shaders.x, shaders.y);
    ++counts_.samples;
    counts_.ours_beside += ours_is_beside;
    counts_.shaders_beside += shaders_is_beside;
    counts_.both_beside += ours_is_beside && shaders_is_beside;
    counts_.ours_not_numbers += !is_number(ours.at.s, ours.at.t);
    counts_.shaders_not_numbers += !is_number(shaders.s, shaders.t);
    counts_.same_texel += ours.x == shaders.x && ours.y == shaders.y;
    counts_.same_from_blue += texel_from_blue(map_, sums_, u) == Extent{shaders.x, shaders.y};
    counts_.other_texel += ours.x != shaders.x || ours.y != shaders.y;
    if (!is_right(u, shaders.x, shaders.y) || !is_right(u, ours.x, ours.y)) {
      if (++counts_.wrong <= 10) {
        fmt::print("wrong: u = ({:.9g}, {:.9g}): ours ({}, {}), the shader's ({}, {})\n", u.s, u.t,
                   ours.x, ours.y, shaders.x, shaders.y);
      }
    } else if (!ours_is_beside && ours.x == shaders.x && ours.y == shaders.y) {
      add_positions(ours, shaders);
    }
  }

  const Counts& counts() const { return counts_; }

 private:
  bool is_on_map(int x, int y) const {
    return x >= 0 && x < extent_.width && y >= 0 && y < extent_.height;
  }

  bool is_right(SquarePoint u, int x, int y) const {
    if (y < 0 || y > extent_.height || !sums_.rows.may_stop(y, u.t)) return false;
    const bool has_light = y < extent_.height && sums_.rows.mass(y) > 0.0;
    if (!has_light) return true;  // quotients by 0, or texels beside the map: the driver's affair
    const Sums& columns = sums_.columns[static_cast<std::size_t>(y)];
    return x >= 0 && x <= extent_.width && columns.may_stop(x, u.s);
  }

  void add_positions(const TexelSample& ours, const Shaders& shaders) {
    const double s = static_cast<double>(shaders.s);
    const double t = static_cast<double>(shaders.t);
    counts_.same_position += ours.at.s == s && ours.at.t == t;
    const Sums& columns = sums_.columns[static_cast<std::size_t>(ours.y)];
    const double of_s = std::abs(ours.at.s - s) * extent_.width / columns.position_error(ours.x);
    const double of_t =
        std::abs(ours.at.t - t) * extent_.height / sums_.rows.position_error(ours.y);
    if (!(ours.x == 0 && columns.mass(0) == 0.0)) {
      counts_.worst_position = std::max({counts_.worst_position, of_s, of_t});
    }
  }

  const EnvironmentMap& map_;
  Extent extent_;
  LinearScanPublished sampler_;
  MapSums sums_;
  Counts counts_;
};

void print(const Counts& counts) {
  fmt::print(
      "samples {}: same texel {} (of these the same position to the last bit {}), another texel {} "
      "as roundings allow\n"
      "with luminances summed from blue to red: same texel {}\n"
      "beside the map: ours {}, the shader's {}, both {}; not numbers: ours {}, the shader's {}\n"
      "largest difference of positions inside a texel, over what roundings allow: {:.3g}; wrong: "
      "{}\n",
      counts.samples, counts.same_texel, counts.same_position, counts.other_texel,
      counts.same_from_blue, counts.ours_beside, counts.shaders_beside, counts.both_beside,
      counts.ours_not_numbers, counts.shaders_not_numbers, counts.worst_position, counts.wrong);
}

int write_inputs(const EnvironmentMap& map, std::size_t count, const std::string& folder) {
  write_floats(folder + "/random.f32", random_numbers(MapSums(map), count));
  const auto texels = map.radiance.values();
  write_floats(folder + "/map.f32", {&texels.data()->x, 3 * texels.size()});
  return 0;
}

int compare(const EnvironmentMap& map, std::span<const float> random,
            std::span<const float> samples) {
  if (samples.size() != 2 * random.size()) {
    throw InputError(fmt::format("{} samples at {} pairs of random numbers", samples.size() / 4,
                                 random.size() / 2));
  }
  Comparison comparison(map);
  for (std::size_t i = 0; 2 * i < random.size(); ++i) {
    comparison.add({static_cast<double>(random[2 * i]), static_cast<double>(random[2 * i + 1])},
                   Shaders(samples.subspan(4 * i).first<4>(), map.radiance.extent().width));
  }
  print(comparison.counts());
  return comparison.counts().wrong == 0 && comparison.counts().worst_position <= 1.0 ? 0 : 1;
}

int run(const std::vector<std::string>& words) {
  if (words.size() == 5 && words[0] == "write") {
    return write_inputs(map_named(words[1], words[2]), std::stoull(words[3]), words[4]);
  }
  if (words.size() == 5 && words[0] == "compare") {
    return compare(map_named(words[1], words[2]), read_floats(words[3]), read_floats(words[4]));
  }
  throw InputError("write MAP WxH COUNT FOLDER, or compare MAP WxH RANDOM.f32 SAMPLES.f32");
}

}  // namespace
}  // namespace lightproof

int main(int argc, char** argv) {
  try {
    return lightproof::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "shader_agreement: {}\n", error.what());
    return 2;
  }
}
