// Predicted errors against exact moments by quadrature, and, where there are none, against the
// estimators themselves.
#include "lightproof/recommend/prediction.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "lightproof/accuracy/exact_light.h"
#include "lightproof/core/moments.h"
#include "lightproof/core/parallel.h"
#include "lightproof/estimators/reduced_table.h"
#include "lightproof/estimators/registry.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/render/receiver.h"
#include "lightproof/samplers/sampler.h"
#include "lightproof/warp/lat_long.h"
#include "maps.h"

namespace lightproof {
namespace {

/// Points of a sphere, from the middle of it to its rim.
struct Stage {
  explicit Stage(Extent picture = {4, 2})
      : receiver(receiver_by_name("sphere")),
        scene(receiver.content),
        pixels(visible_pixels(receiver, scene, picture)) {
    for (const Pixel& pixel : pixels) points.push_back(pixel.point);
  }
  double count() const { return static_cast<double>(points.size()); }

  const ReceiverInfo& receiver;
  Scene scene;
  std::vector<Pixel> pixels;
  std::vector<ShadingPoint> points;
};

std::vector<EnvironmentMap> maps_of(Extent extent) {
  std::vector<EnvironmentMap> maps;
  for (const std::string_view name :
       {"constant", "one-texel", "gradient", "step", "sun-sky", "checker"}) {
    maps.push_back(make_synthetic_map(name, extent));
  }
  maps.push_back(random_map(extent, 3.0));
  maps.push_back(random_map(extent, 0.5));
  return maps;
}

/// A grid in which every cell is many: the same function of direction, whose quadrature is finer.
Grid<double> divided(const Grid<double>& cells, int parts) {
  Grid<double> finer({cells.extent().width * parts, cells.extent().height * parts});
  for (int y = 0; y < finer.extent().height; ++y) {
    for (int x = 0; x < finer.extent().width; ++x) finer(x, y) = cells(x / parts, y / parts);
  }
  return finer;
}

/// Sums over points: the mean, and variances by estimators' names.
struct Exact {
  double mean = 0.0;
  std::map<std::string, double, std::less<>> variance;
};

/// What is exact on every map, averaged over the points.
std::vector<Exact> exact_of(const Stage& stage, const Material& material,
                            std::span<const EnvironmentMap> maps, int parts) {
  std::vector<Grid<double>> luminances;
  for (const EnvironmentMap& map : maps) luminances.push_back(divided(luminance_of(map), parts));
  std::vector<std::string> names;
  std::vector<reference::CombinedSampling> samplings;
  for (const EstimatorInfo& info : estimators()) {
    if (!info.combined) continue;
    names.emplace_back(info.name);
    samplings.push_back(*info.combined);
  }
  std::vector<Exact> exact(maps.size());
  for (const Pixel& pixel : stage.pixels) {
    const auto kernel = kernel_at(stage.receiver, stage.scene, material, pixel.point);
    const auto add = [&](std::size_t map, std::string_view name, double variance) {
      exact[map].variance[std::string(name)] += variance / stage.count();
    };
    const auto light = reference::light_moments(kernel, luminances);
    const std::array<reference::DensityAtNode, 2> densities = {
        [](const reference::Node& /*node*/) { return 0.5 / kPi; },
        [normal = pixel.point.frame.normal](const reference::Node& node) {
          return glm::dot(normal, node.direction) / kPi;
        }};
    const auto [combined, of_densities] = reference::sampling_moments(
        kernel, luminances, samplings, densities, reference::CellRule::gauss);
    for (std::size_t map = 0; map < maps.size(); ++map) {
      exact[map].mean += light[map][reference::SampledDensity::uniform].mean() / stage.count();
      for (const EstimatorInfo& info : estimators()) {
        if (info.density) add(map, info.name, light[map][*info.density].variance());
      }
      for (std::size_t i = 0; i < names.size(); ++i) add(map, names[i], combined[i][map].variance);
      add(map, "hemisphere", of_densities[0][map].variance);
      add(map, "cosine", of_densities[1][map].variance);
      for (const int factor : {2, 8}) {
        const auto reduced = reference::density_moments(
            kernel, std::span(&luminances[map], 1),
            [pdf = reduced_table_pdf(maps[map], factor)](const reference::Node& node) {
              return pdf(node.at).value;
            });
        add(map, fmt::format("environment B alias 1/{}", factor), reduced.front().variance);
      }
    }
  }
  return exact;
}

/// The error of one sample is predicted to 5 %, and to 1 % of the mean where it is small.
constexpr double kRelative = 0.05;
constexpr double kOfMean = 0.01;

void expect_predicted(const Stage& stage, std::string_view material_name,
                      std::span<const EnvironmentMap> maps, int parts) {
  const Material material = material_of(material_name);
  const std::vector<Exact> exact = exact_of(stage, material, maps, parts);
  for (std::size_t map = 0; map < maps.size(); ++map) {
    const Prediction prediction = predict(summarise(maps[map]), material, stage.points);
    EXPECT_NEAR(prediction.mean / exact[map].mean, 1.0, 0.01)
        << material_name << " " << maps[map].name;
    for (const auto& [name, variance] : exact[map].variance) {
      const EstimatorPrediction* row = prediction.find(name);
      ASSERT_NE(row, nullptr) << name;
      ASSERT_TRUE(row->error) << name;
      EXPECT_EQ(row->error->model, ErrorModel::independent) << name;
      const double error = std::sqrt(variance) / exact[map].mean;
      EXPECT_NEAR(row->error->at(1), error, kRelative * error + kOfMean)
          << material_name << " " << maps[map].name << " " << name;
    }
  }
}

class Variance : public testing::TestWithParam<std::string_view> {};

TEST_P(Variance, OfOneSampleIsPredicted) {
  expect_predicted(Stage(), GetParam(), maps_of({320, 160}), 1);
}

// The quadrature's cells are no smaller than texels: these lobes need smaller ones.
class NarrowLobes : public testing::TestWithParam<std::string_view> {};

TEST_P(NarrowLobes, ArePredicted) {
  const std::vector<EnvironmentMap> maps = {make_synthetic_map("gradient", {80, 40}),
                                            make_synthetic_map("sun-sky", {80, 40}),
                                            random_map({80, 40}, 3.0)};
  expect_predicted(Stage(), GetParam(), maps, 8);
}

std::string test_name(const testing::TestParamInfo<std::string_view>& test) {
  std::string name(test.param);
  for (char& letter : name)
    letter = std::isalnum(static_cast<unsigned char>(letter)) ? letter : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Materials, Variance,
                         testing::Values("lambert", "phong:5", "phong:50", "ggx:0.4", "ggx:0.8"),
                         test_name);
INSTANTIATE_TEST_SUITE_P(Materials, NarrowLobes, testing::Values("phong:1000", "ggx:0.1"),
                         test_name);

/// The error of an estimator, over many estimates at each point, and its standard error.
struct Measured {
  double error = 0.0;
  double uncertainty = 0.0;
};

Measured measured_error(const Stage& stage, const EnvironmentMap& map, const Material& material,
                        std::string_view name, double mean, std::size_t samples) {
  const BoundEstimator bound = estimator_by_name(name).prepare(map).bind(stage.scene, material);
  double variance = 0.0;
  double uncertainty = 0.0;
  for (std::size_t i = 0; i < stage.points.size(); ++i) {
    Moments moments;
    bound.integrate(stage.points[i], RandomStream(fmt::format("prediction/{}/{}", name, i), 1),
                    {0, samples}, [&](std::span<const Rgb> estimates) {
                      for (const Rgb rgb : estimates) moments.add(luminance_of(rgb, map.weights));
                    });
    const double v = moments.variance();
    variance += v / stage.count();
    uncertainty += (moments.fourth_central() - v * v) / static_cast<double>(moments.count()) /
                   (stage.count() * stage.count());
  }
  const double error = std::sqrt(variance) / mean;
  return {error, error > 0.0 ? 0.5 * std::sqrt(uncertainty) / (mean * mean) / error : 0.0};
}

// Those whose moments no quadrature knows, by 2^15 samples a point; z = 6.
TEST(Prediction, OfProductsAndResamplingIsWhatIsMeasured) {
  const Stage stage({4, 2});
  for (const std::string_view map_name : {"gradient", "sun-sky", "checker"}) {
    const EnvironmentMap map = make_synthetic_map(map_name, {256, 128});
    for (const std::string_view material_name : {"lambert", "phong:20", "ggx:0.5"}) {
      const Material material = material_of(material_name);
      const Prediction prediction = predict(summarise(map), material, stage.points);
      for (const std::string_view name :
           {"product two-level", "product hierarchical", "ris 4", "ris 16", "environment B half",
            "environment B 8-bit", "environment B alias 1/4", "environment B alias 1/16",
            "ggx normals", "ggx visible normals", "ggx spherical caps", "ggx bounded caps"}) {
        if (!estimator_by_name(name).serves(material)) continue;
        const Measured measured =
            measured_error(stage, map, material, name, prediction.mean, std::size_t{1} << 15U);
        const EstimatorPrediction* row = prediction.find(name);
        ASSERT_TRUE(row != nullptr && row->error) << name;
        EXPECT_NEAR(row->error->at(1), measured.error,
                    0.08 * measured.error + 0.01 + 6.0 * measured.uncertainty)
            << map_name << " " << material_name << " " << name;
      }
    }
  }
}

/// The exact mean at every point.
std::vector<double> exact_means(const Stage& stage, const EnvironmentMap& map,
                                const Material& material) {
  const Grid<double> luminance = luminance_of(map);
  std::vector<double> means;
  const auto exact =
      exact_light({&luminance, 1}, stage.receiver, stage.scene, material, stage.pixels);
  for (const auto& moments : exact.front()) {
    means.push_back(moments[reference::SampledDensity::uniform].mean());
  }
  return means;
}

// Biased ones have one estimate, which is compared with quadrature as a prediction says it is.
TEST(Prediction, OfBiasedEstimatorsIsTheirError) {
  const Stage stage({8, 6});
  for (const std::string_view map_name : {"gradient", "sun-sky", "checker", "step"}) {
    const EnvironmentMap map = make_synthetic_map(map_name, {256, 128});
    const MapSummary summary = summarise(map);
    for (const std::string_view material_name : {"lambert", "phong:20", "ggx:0.3", "ggx:0.7"}) {
      const Material material = material_of(material_name);
      const std::vector<double> exact = exact_means(stage, map, material);
      double mean = 0.0;
      for (const double each : exact) mean += each / stage.count();
      const Prediction prediction = predict(summary, material, stage.points);
      for (const EstimatorPrediction& row : prediction.estimators) {
        if (!row.error || row.error->model != ErrorModel::constant) continue;
        const BoundEstimator bound =
            estimator_by_name(row.estimator).prepare(map).bind(stage.scene, material);
        double square = 0.0;
        for (std::size_t i = 0; i < exact.size(); ++i) {
          const Rgb rgb = bound.integrate(stage.points[i], RandomStream("bias", 1), {0, 1}, {});
          const double off = luminance_of(rgb, map.weights) - exact[i];
          square += off * off / stage.count();
        }
        const double error = std::sqrt(square) / mean;
        const std::string label = fmt::format("{} {} {}", map_name, material_name, row.estimator);
        EXPECT_GT(row.error->at(1), 0.9 * error - 0.005) << label;
        if (row.error->variance > 0.0) {  // a bound
          EXPECT_LT(row.error->bias, 1.1 * error + 0.005) << label;
        } else {
          EXPECT_LT(row.error->at(1), 1.1 * error + 0.005) << label;
        }
      }
    }
  }
}

/// The root mean square error of estimates of so many samples, relative to the mean; and how well
/// that is known, from estimates at each point that are taken for normal.
Measured measured_error_of_sets(const Stage& stage, const EnvironmentMap& map,
                                const Material& material, std::string_view name, double mean,
                                std::uint64_t samples) {
  constexpr std::size_t kEstimates = 512;
  const BoundEstimator bound = estimator_by_name(name).prepare(map).bind(stage.scene, material);
  double variance = 0.0;
  for (std::size_t i = 0; i < stage.points.size(); ++i) {
    const RandomStream stream(fmt::format("sets/{}/{}", name, i), 1);
    Moments moments;
    for (std::size_t j = 0; j < kEstimates; ++j) {
      const Rgb rgb = bound.integrate(stage.points[i], stream, {j * samples, samples}, {});
      moments.add(luminance_of(rgb, map.weights));
    }
    variance += moments.variance() / stage.count();
  }
  const double error = std::sqrt(variance) / mean;
  return {error, error / std::sqrt(2.0 * kEstimates)};
}

// Strata have the variance inside them; the other sets no more, as a rule.
TEST(Prediction, OfPointSetsIsThatInsideOfStrata) {
  const Stage stage;
  for (const std::string_view map_name : {"gradient", "checker"}) {
    const EnvironmentMap map = make_synthetic_map(map_name, {256, 128});
    for (const std::string_view material_name : {"lambert", "ggx:0.5"}) {
      const Material material = material_of(material_name);
      const Prediction prediction = predict(summarise(map), material, stage.points);
      for (const std::string_view base : {"environment B", "brdf"}) {
        for (const std::string_view set : {" stratified", " hammersley", " R2", " sobol"}) {
          const std::string name = std::string(base) + std::string(set);
          const EstimatorPrediction* row = prediction.find(name);
          ASSERT_TRUE(row != nullptr && row->error) << name;
          if (map_name == "gradient") {
            EXPECT_LT(row->error->variance_of(64), 0.6 * row->error->variance) << name;
          }
          for (const std::uint64_t samples : {16U, 256U}) {
            const Measured measured =
                measured_error_of_sets(stage, map, material, name, prediction.mean, samples);
            const double predicted = row->error->at(samples);
            const std::string label =
                fmt::format("{} {} {} {}", map_name, material_name, name, samples);
            EXPECT_LT(measured.error, 1.15 * predicted + 6.0 * measured.uncertainty) << label;
            if (set != " stratified") continue;
            EXPECT_GT(measured.error, 0.85 * predicted - 6.0 * measured.uncertainty) << label;
          }
        }
      }
    }
  }
}

TEST(Prediction, HasARowForEveryEstimatorWithAReasonIfThereIsNone) {
  const Stage stage;
  const MapSummary summary = summarise(make_synthetic_map("sun-sky", {64, 32}));
  for (const std::string_view name : {"lambert", "phong:50", "ggx:0.3"}) {
    const Material material = material_of(name);
    const Prediction prediction = predict(summary, material, stage.points);
    std::size_t row = 0;
    for (const EstimatorInfo& info : estimators()) {
      if (!info.serves(material)) continue;
      ASSERT_LT(row, prediction.estimators.size());
      const EstimatorPrediction& predicted = prediction.estimators[row++];
      EXPECT_EQ(predicted.estimator, info.name);
      EXPECT_EQ(predicted.error.has_value(), info.unpredicted.empty()) << info.name;
      EXPECT_EQ(predicted.reason, info.unpredicted) << info.name;
      if (!predicted.error) continue;
      EXPECT_TRUE(std::isfinite(predicted.error->at(1))) << info.name;
      EXPECT_EQ(predicted.error->model == ErrorModel::at_most,
                info.kind == EstimatorKind::point_set)
          << info.name;
      EXPECT_EQ(predicted.error->model == ErrorModel::constant, info.ignores_budget) << info.name;
    }
    EXPECT_EQ(row, prediction.estimators.size());
  }
}

TEST(Prediction, OfSamplesFallsAsTheRootOfTheirNumberDownToTheBias) {
  const PredictedError unbiased = {ErrorModel::independent, 4.0, 0.0};
  EXPECT_DOUBLE_EQ(unbiased.at(1), 2.0);
  EXPECT_DOUBLE_EQ(unbiased.at(16), 0.5);
  const PredictedError look_up = {ErrorModel::constant, 0.0009, 0.04};
  EXPECT_DOUBLE_EQ(look_up.at(1), 0.05);
  EXPECT_DOUBLE_EQ(look_up.at(1000), 0.05);
}

TEST(Prediction, OfABlackMapIsNone) {
  const Stage stage;
  const EnvironmentMap black{"black", Grid<Rgb>({16, 8})};
  for (const EstimatorPrediction& row :
       predict(summarise(black), material_of("ggx:0.3"), stage.points).estimators) {
    EXPECT_FALSE(row.error) << row.estimator;
    EXPECT_FALSE(row.reason.empty()) << row.estimator;
  }
}

TEST(Prediction, IsTheSameWithAnyNumberOfThreads) {
  const Stage stage;
  const EnvironmentMap map = random_map({100, 50}, 2.0);
  const auto predicted = [&](int threads) {
    const ThreadLimit limit(threads);
    std::vector<double> values;
    for (const auto& row :
         predict(summarise(map), material_of("ggx:0.3"), stage.points).estimators) {
      if (row.error) values.insert(values.end(), {row.error->variance, row.error->bias});
    }
    return values;
  };
  EXPECT_EQ(predicted(1), predicted(2));
}

}  // namespace
}  // namespace lightproof
