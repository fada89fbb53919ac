#include "lightproof/estimators/registry.h"

#include <algorithm>
#include <array>
#include <string>

#include "lightproof/core/error.h"
#include "lightproof/estimators/diffuse_tables.h"
#include "lightproof/estimators/environment.h"
#include "lightproof/estimators/filtered_sampling.h"
#include "lightproof/estimators/hierarchical_product.h"
#include "lightproof/estimators/light_sets.h"
#include "lightproof/estimators/lobes.h"
#include "lightproof/estimators/median_cut.h"
#include "lightproof/estimators/multiple_importance.h"
#include "lightproof/estimators/one_sample.h"
#include "lightproof/estimators/outgoing_table.h"
#include "lightproof/estimators/point_set.h"
#include "lightproof/estimators/product_table.h"
#include "lightproof/estimators/reduced_table.h"
#include "lightproof/estimators/resampled.h"
#include "lightproof/estimators/riemann_sum.h"
#include "lightproof/estimators/rounded_table.h"
#include "lightproof/estimators/sampled.h"
#include "lightproof/estimators/specular_tables.h"
#include "lightproof/estimators/two_level_product.h"

namespace lightproof {
namespace {

using reference::CombinedSampling;
using reference::Heuristic;
using reference::SampledDensity;

/// Names of point sets.
constexpr std::string_view kHammersley = "hammersley";
constexpr std::string_view kR2 = "R2";
constexpr std::string_view kSobol = "sobol";
constexpr std::string_view kStratified = "stratified";

template <int kFactor>
std::function<PerSteradian(SquarePoint)> pdf_of_reduced(const EnvironmentMap& map) {
  return reduced_table_pdf(map, kFactor);
}

template <MassForm kForm>
std::function<PerSteradian(SquarePoint)> pdf_of_rounded(const EnvironmentMap& map) {
  return rounded_table_pdf(map, kForm);
}

template <const std::string_view& kPointSet>
PreparedEstimator from_map_at(const EnvironmentMap& map) {
  return prepare_point_set(map, MapDensity{DensitySpace::solid_angle}, kPointSet);
}

template <const std::string_view& kPointSet>
PreparedEstimator from_lobes_at(const EnvironmentMap& map) {
  return prepare_point_set(map, MaterialLobes{}, kPointSet);
}

template <const std::string_view& kPointSet>
PreparedEstimator from_alias_at(const EnvironmentMap& map) {
  return samples_at_points(alias_source(map, DensitySpace::solid_angle), kPointSet);
}

template <MicrofacetSampling kSampling>
double pdf_of_ggx(const Material& material, const ShadingPoint& at, Direction direction) {
  return ggx_pdf(kSampling, material, at, direction);
}

template <std::size_t kCandidates>
PreparedEstimator resampled_of(const EnvironmentMap& map) {
  return resampled(one_sample_mixture(map, DensitySpace::solid_angle, 0.0), kCandidates);
}

template <int kFactor>
PreparedEstimator from_reduced_table(const EnvironmentMap& map) {
  return independent_samples(reduced_table_source(map, kFactor));
}

template <MassForm kForm>
PreparedEstimator from_rounded_table(const EnvironmentMap& map) {
  return independent_samples(rounded_table_source(map, kForm));
}

template <int kCuts>
PreparedEstimator median_cut_of(const EnvironmentMap& map) {
  return median_cut_lights(map, kCuts);
}

constexpr std::array kEstimators = {
    EstimatorInfo{
        .name = "uniform",
        .description = "uniform over the sphere, density 1/4pi",
        .source = "Kajiya 1986",
        .density = SampledDensity::uniform,
        .is_studied = true,
        .is_representative = true,
        .make = [](const EnvironmentMap& map) { return prepare_one_sample(map, UniformSphere{}); }},
    EstimatorInfo{
        .name = "hemisphere",
        .description = "uniform over the hemisphere above the surface, density 1/2pi",
        .source = "Kajiya 1986",
        .pdf = hemisphere_pdf,
        .make =
            [](const EnvironmentMap& map) { return independent_samples(hemisphere_source(map)); }},
    EstimatorInfo{
        .name = "cosine",
        .description = "the cosine to the normal, density cos/pi",
        .source = "Shirley and Chiu 1997; the lecture, whatever the material",
        .family = EstimatorFamily::lobes,
        .pdf = cosine_pdf,
        .make = [](const EnvironmentMap& map) { return independent_samples(cosine_source(map)); }},
    EstimatorInfo{
        .name = "brdf",
        .description = "the material's own lobes",
        .source = "Lafortune and Willems 1994",
        .family = EstimatorFamily::lobes,
        .density = SampledDensity::material,
        .is_studied = true,
        .is_representative = true,
        .make = [](const EnvironmentMap& map) { return prepare_one_sample(map, MaterialLobes{}); }},
    EstimatorInfo{.name = "ggx normals",
                  .description = "GGX's normals, whatever the view",
                  .source = "Walter et al. 2007, eq. 35 and 36",
                  .family = EstimatorFamily::lobes,
                  .pdf = pdf_of_ggx<MicrofacetSampling::normals>,
                  .microfacets = MicrofacetSampling::normals,
                  .serves = is_ggx,
                  .make =
                      [](const EnvironmentMap& map) {
                        return independent_samples(ggx_source(map, MicrofacetSampling::normals));
                      }},
    EstimatorInfo{.name = "ggx visible normals",
                  .description = "GGX's visible normals, by projecting a hemisphere",
                  .source = "Heitz 2018",
                  .family = EstimatorFamily::lobes,
                  .pdf = pdf_of_ggx<MicrofacetSampling::visible_normals>,
                  .microfacets = MicrofacetSampling::visible_normals,
                  .serves = is_ggx,
                  .make =
                      [](const EnvironmentMap& map) {
                        return independent_samples(
                            ggx_source(map, MicrofacetSampling::visible_normals));
                      }},
    EstimatorInfo{.name = "ggx spherical caps",
                  .description = "GGX's visible normals, by a spherical cap",
                  .source = "Dupuy and Benyoub 2023",
                  .family = EstimatorFamily::lobes,
                  .pdf = pdf_of_ggx<MicrofacetSampling::spherical_caps>,
                  .microfacets = MicrofacetSampling::spherical_caps,
                  .serves = is_ggx,
                  .make =
                      [](const EnvironmentMap& map) {
                        return independent_samples(
                            ggx_source(map, MicrofacetSampling::spherical_caps));
                      }},
    EstimatorInfo{
        .name = "ggx bounded caps",
        .description = "GGX's visible normals that reflect above the surface, by a smaller cap",
        .source = "Tokuyoshi and Eto 2023",
        .family = EstimatorFamily::lobes,
        .pdf = pdf_of_ggx<MicrofacetSampling::bounded_caps>,
        .microfacets = MicrofacetSampling::bounded_caps,
        .serves = is_ggx,
        .make =
            [](const EnvironmentMap& map) {
              return independent_samples(ggx_source(map, MicrofacetSampling::bounded_caps));
            }},
    EstimatorInfo{.name = "environment A",
                  .description = "the map, density over (s,t) proportional to luminance",
                  .source = "the lecture: weights 2 pi^2 sin(theta) / p(s,t)",
                  .family = EstimatorFamily::environment,
                  .density = SampledDensity::texture_space,
                  .is_studied = true,
                  .make =
                      [](const EnvironmentMap& map) {
                        return prepare_one_sample(map, MapDensity{DensitySpace::texture});
                      }},
    EstimatorInfo{.name = "environment B",
                  .description = "the map, density over directions proportional to luminance",
                  .source = "Pharr, Jakob and Humphreys, Physically Based Rendering, 12.5",
                  .family = EstimatorFamily::environment,
                  .density = SampledDensity::solid_angle,
                  .is_studied = true,
                  .is_representative = true,
                  .make =
                      [](const EnvironmentMap& map) {
                        return prepare_one_sample(map, MapDensity{DensitySpace::solid_angle});
                      }},
    EstimatorInfo{.name = "environment C",
                  .description = "the map, texels in proportion to luminance times solid angle, "
                                 "positions uniform in (s,t)",
                  .source = "pbrt-v3's InfiniteAreaLight, Mitsuba's envmap, Cycles",
                  .family = EstimatorFamily::environment,
                  .density = SampledDensity::sine_weighted,
                  .is_studied = true,
                  .make =
                      [](const EnvironmentMap& map) {
                        return prepare_one_sample(map, MapDensity{DensitySpace::sine_weighted});
                      }},
    EstimatorInfo{.name = "environment B alias",
                  .description = "as environment B, by an alias table",
                  .source = "Walker 1974; Vose 1991",
                  .family = EstimatorFamily::environment,
                  .density = SampledDensity::solid_angle,
                  .make =
                      [](const EnvironmentMap& map) {
                        return independent_samples(alias_source(map, DensitySpace::solid_angle));
                      }},
    EstimatorInfo{.name = "environment B alias 1/2",
                  .description = "the map by an alias table of the means of 2 x 2 texels",
                  .source = "Walker 1974; the light is that of the texel",
                  .family = EstimatorFamily::environment,
                  .map_pdf = pdf_of_reduced<2>,
                  .table_reduction = 2,
                  .make = from_reduced_table<2>},
    EstimatorInfo{.name = "environment B alias 1/4",
                  .description = "the map by an alias table of the means of 4 x 4 texels",
                  .source = "Walker 1974; the light is that of the texel",
                  .family = EstimatorFamily::environment,
                  .map_pdf = pdf_of_reduced<4>,
                  .table_reduction = 4,
                  .make = from_reduced_table<4>},
    EstimatorInfo{.name = "environment B alias 1/8",
                  .description = "the map by an alias table of the means of 8 x 8 texels",
                  .source = "Walker 1974; the light is that of the texel",
                  .family = EstimatorFamily::environment,
                  .map_pdf = pdf_of_reduced<8>,
                  .table_reduction = 8,
                  .make = from_reduced_table<8>},
    EstimatorInfo{.name = "environment B alias 1/16",
                  .description = "the map by an alias table of the means of 16 x 16 texels",
                  .source = "Walker 1974; the light is that of the texel",
                  .family = EstimatorFamily::environment,
                  .map_pdf = pdf_of_reduced<16>,
                  .table_reduction = 16,
                  .make = from_reduced_table<16>},
    EstimatorInfo{.name = "environment B half",
                  .description = "as environment B, each texel's mass rounded to half floats, "
                                 "relative to the brightest of its row",
                  .source = "cumulative sums over runs of 32 texels",
                  .family = EstimatorFamily::environment,
                  .map_pdf = pdf_of_rounded<MassForm::half>,
                  .make = from_rounded_table<MassForm::half>},
    EstimatorInfo{.name = "environment B 8-bit",
                  .description = "as environment B, each texel's mass rounded to 8 bits, a small "
                                 "float relative to the brightest of its row",
                  .source = "cumulative sums over runs of 32 texels",
                  .family = EstimatorFamily::environment,
                  .map_pdf = pdf_of_rounded<MassForm::byte>,
                  .make = from_rounded_table<MassForm::byte>},
    EstimatorInfo{
        .name = "product table",
        .description = "the product of map and material, tabulated for every shading point",
        .source = "Burke, Ghosh and Heidrich 2005, their exact product",
        .family = EstimatorFamily::product,
        .tabulates_each_point = true,
        .make =
            [](const EnvironmentMap& map) {
              return independent_samples(product_table_source(map));
            }},
    EstimatorInfo{
        .name = "product two-level",
        .description = "the product of map and material on 12 x 12 blocks, then the map alone",
        .source = "Conty Estevez and Lecocq 2018",
        .family = EstimatorFamily::product,
        .make =
            [](const EnvironmentMap& map) {
              return independent_samples(two_level_product_source(map));
            }},
    EstimatorInfo{.name = "product hierarchical",
                  .description = "the product of map and material down a quadtree",
                  .source = "Clarberg and Akenine-Möller 2008",
                  .family = EstimatorFamily::product,
                  .is_representative = true,
                  .make =
                      [](const EnvironmentMap& map) {
                        return independent_samples(hierarchical_product_source(map));
                      }},
    EstimatorInfo{
        .name = "mis balance",
        .description =
            "half of the samples by the lobes, half by the map, weighted by the balance heuristic",
        .source = "Veach and Guibas 1995",
        .family = EstimatorFamily::mis,
        .kind = EstimatorKind::multi_sample,
        .combined = CombinedSampling{.heuristic = Heuristic::balance, .compensation = 0.0},
        .samples_per_estimate = 2,
        .is_representative = true,
        .make =
            [](const EnvironmentMap& map) {
              return multi_sample(map, DensitySpace::solid_angle, Heuristic::balance, 0.0);
            }},
    EstimatorInfo{.name = "mis power",
                  .description = "as mis balance, by the power heuristic of exponent 2",
                  .source = "Veach and Guibas 1995",
                  .family = EstimatorFamily::mis,
                  .kind = EstimatorKind::multi_sample,
                  .combined = CombinedSampling{.heuristic = Heuristic::power, .compensation = 0.0},
                  .samples_per_estimate = 2,
                  .make =
                      [](const EnvironmentMap& map) {
                        return multi_sample(map, DensitySpace::solid_angle, Heuristic::power, 0.0);
                      }},
    EstimatorInfo{
        .name = "mis balance half-compensated",
        .description = "as mis balance, half of the mean taken off the map",
        .source = "Karlík et al. 2019",
        .family = EstimatorFamily::mis,
        .kind = EstimatorKind::multi_sample,
        .combined = CombinedSampling{.heuristic = Heuristic::balance, .compensation = 0.5},
        .samples_per_estimate = 2,
        .make =
            [](const EnvironmentMap& map) {
              return multi_sample(map, DensitySpace::solid_angle, Heuristic::balance, 0.5);
            }},
    EstimatorInfo{
        .name = "mis balance compensated",
        .description = "as mis balance, the mean taken off the map",
        .source = "Karlík et al. 2019",
        .family = EstimatorFamily::mis,
        .kind = EstimatorKind::multi_sample,
        .combined = CombinedSampling{.heuristic = Heuristic::balance, .compensation = 1.0},
        .samples_per_estimate = 2,
        .make =
            [](const EnvironmentMap& map) {
              return multi_sample(map, DensitySpace::solid_angle, Heuristic::balance, 1.0);
            }},
    EstimatorInfo{.name = "mis power compensated",
                  .description = "as mis power, the mean taken off the map",
                  .source = "Karlík et al. 2019",
                  .family = EstimatorFamily::mis,
                  .kind = EstimatorKind::multi_sample,
                  .combined = CombinedSampling{.heuristic = Heuristic::power, .compensation = 1.0},
                  .samples_per_estimate = 2,
                  .make =
                      [](const EnvironmentMap& map) {
                        return multi_sample(map, DensitySpace::solid_angle, Heuristic::power, 1.0);
                      }},
    EstimatorInfo{
        .name = "mis one-sample",
        .description =
            "each sample by the lobes or by the map at the toss of a coin, balance heuristic",
        .source = "Veach and Guibas 1995",
        .family = EstimatorFamily::mis,
        .combined = CombinedSampling{.is_one_sample = true, .compensation = 0.0},
        .make =
            [](const EnvironmentMap& map) {
              return independent_samples(one_sample_mixture(map, DensitySpace::solid_angle, 0.0));
            }},
    EstimatorInfo{.name = "mis one-sample half-compensated",
                  .description = "as mis one-sample, half of the mean taken off the map",
                  .source = "Karlík et al. 2019",
                  .family = EstimatorFamily::mis,
                  .combined = CombinedSampling{.is_one_sample = true, .compensation = 0.5},
                  .make =
                      [](const EnvironmentMap& map) {
                        return independent_samples(
                            one_sample_mixture(map, DensitySpace::solid_angle, 0.5));
                      }},
    EstimatorInfo{.name = "mis one-sample compensated",
                  .description = "as mis one-sample, the mean taken off the map",
                  .source = "Karlík et al. 2019",
                  .family = EstimatorFamily::mis,
                  .combined = CombinedSampling{.is_one_sample = true, .compensation = 1.0},
                  .make =
                      [](const EnvironmentMap& map) {
                        return independent_samples(
                            one_sample_mixture(map, DensitySpace::solid_angle, 1.0));
                      }},
    EstimatorInfo{
        .name = "ris 4",
        .description = "one of 4 candidates of mis one-sample, chosen by its unoccluded light",
        .source = "Burke, Ghosh and Heidrich 2005; Talbot, Cline and Egbert 2005",
        .family = EstimatorFamily::ris,
        .kind = EstimatorKind::resampled,
        .candidates = 4,
        .make = resampled_of<4>},
    EstimatorInfo{
        .name = "ris 16",
        .description = "one of 16 candidates of mis one-sample, chosen by its unoccluded light",
        .source = "Burke, Ghosh and Heidrich 2005; Talbot, Cline and Egbert 2005",
        .family = EstimatorFamily::ris,
        .kind = EstimatorKind::resampled,
        .candidates = 16,
        .is_representative = true,
        .make = resampled_of<16>},
    EstimatorInfo{
        .name = "ris 64",
        .description = "one of 64 candidates of mis one-sample, chosen by its unoccluded light",
        .source = "Burke, Ghosh and Heidrich 2005; Talbot, Cline and Egbert 2005",
        .family = EstimatorFamily::ris,
        .kind = EstimatorKind::resampled,
        .candidates = 64,
        .make = resampled_of<64>},
    EstimatorInfo{.name = "environment B stratified",
                  .description = "as environment B, one at random in each cell of a grid",
                  .source = "Cook, Porter and Carpenter 1984",
                  .family = EstimatorFamily::points,
                  .kind = EstimatorKind::point_set,
                  .at_independent_points = "environment B",
                  .make = from_map_at<kStratified>},
    EstimatorInfo{.name = "environment B hammersley",
                  .description = "as environment B, at Hammersley's points, shifted at random",
                  .source = "Hammersley 1960; Cranley and Patterson 1976",
                  .family = EstimatorFamily::points,
                  .kind = EstimatorKind::point_set,
                  .at_independent_points = "environment B",
                  .is_studied = true,
                  .make = from_map_at<kHammersley>},
    EstimatorInfo{.name = "environment B R2",
                  .description = "as environment B, at the points of R2, shifted at random",
                  .source = "Roberts 2018; Cranley and Patterson 1976",
                  .family = EstimatorFamily::points,
                  .kind = EstimatorKind::point_set,
                  .at_independent_points = "environment B",
                  .is_studied = true,
                  .make = from_map_at<kR2>},
    EstimatorInfo{.name = "environment B sobol",
                  .description = "as environment B, at Owen-scrambled Sobol points",
                  .source = "Owen 1995; Kollig and Keller 2002; Burley 2020",
                  .family = EstimatorFamily::points,
                  .kind = EstimatorKind::point_set,
                  .at_independent_points = "environment B",
                  .is_studied = true,
                  .is_representative = true,
                  .make = from_map_at<kSobol>},
    EstimatorInfo{.name = "brdf stratified",
                  .description = "as brdf, one at random in each cell of a grid",
                  .source = "Cook, Porter and Carpenter 1984",
                  .family = EstimatorFamily::points,
                  .kind = EstimatorKind::point_set,
                  .at_independent_points = "brdf",
                  .make = from_lobes_at<kStratified>},
    EstimatorInfo{.name = "brdf hammersley",
                  .description = "as brdf, at Hammersley's points, shifted at random",
                  .source = "Hammersley 1960; Cranley and Patterson 1976",
                  .family = EstimatorFamily::points,
                  .kind = EstimatorKind::point_set,
                  .at_independent_points = "brdf",
                  .is_studied = true,
                  .make = from_lobes_at<kHammersley>},
    EstimatorInfo{.name = "brdf R2",
                  .description = "as brdf, at the points of R2, shifted at random",
                  .source = "Roberts 2018; Cranley and Patterson 1976",
                  .family = EstimatorFamily::points,
                  .kind = EstimatorKind::point_set,
                  .at_independent_points = "brdf",
                  .is_studied = true,
                  .make = from_lobes_at<kR2>},
    EstimatorInfo{.name = "brdf sobol",
                  .description = "as brdf, at Owen-scrambled Sobol points",
                  .source = "Owen 1995; Kollig and Keller 2002; Burley 2020",
                  .family = EstimatorFamily::points,
                  .kind = EstimatorKind::point_set,
                  .at_independent_points = "brdf",
                  .is_studied = true,
                  .make = from_lobes_at<kSobol>},
    EstimatorInfo{.name = "environment B alias stratified",
                  .description = "as environment B alias, one at random in each cell of a grid: "
                                 "what an alias table leaves of their evenness",
                  .source = "Cook, Porter and Carpenter 1984",
                  .family = EstimatorFamily::points,
                  .kind = EstimatorKind::point_set,
                  .at_independent_points = "environment B alias",
                  .make = from_alias_at<kStratified>},
    EstimatorInfo{.name = "environment B alias hammersley",
                  .description = "as environment B alias, at Hammersley's points, shifted at "
                                 "random: what an alias table leaves of their evenness",
                  .source = "Hammersley 1960; Cranley and Patterson 1976",
                  .family = EstimatorFamily::points,
                  .kind = EstimatorKind::point_set,
                  .at_independent_points = "environment B alias",
                  .make = from_alias_at<kHammersley>},
    EstimatorInfo{.name = "environment B alias R2",
                  .description = "as environment B alias, at the points of R2, shifted at random: "
                                 "what an alias table leaves of their evenness",
                  .source = "Roberts 2018; Cranley and Patterson 1976",
                  .family = EstimatorFamily::points,
                  .kind = EstimatorKind::point_set,
                  .at_independent_points = "environment B alias",
                  .make = from_alias_at<kR2>},
    EstimatorInfo{.name = "environment B alias sobol",
                  .description = "as environment B alias, at Owen-scrambled Sobol points: what an "
                                 "alias table leaves of their evenness",
                  .source = "Owen 1995; Kollig and Keller 2002; Burley 2020",
                  .family = EstimatorFamily::points,
                  .kind = EstimatorKind::point_set,
                  .at_independent_points = "environment B alias",
                  .make = from_alias_at<kSobol>},
    EstimatorInfo{.name = "mis one-sample sobol",
                  .description = "as mis one-sample, at Owen-scrambled Sobol points",
                  .source = "Owen 1995; Kollig and Keller 2002; Burley 2020",
                  .family = EstimatorFamily::points,
                  .kind = EstimatorKind::point_set,
                  .at_independent_points = "mis one-sample",
                  .make =
                      [](const EnvironmentMap& map) {
                        return samples_at_points(
                            one_sample_mixture(map, DensitySpace::solid_angle, 0.0), kSobol);
                      }},
    EstimatorInfo{.name = "product hierarchical sobol",
                  .description = "as product hierarchical, at Owen-scrambled Sobol points",
                  .source = "Owen 1995; Kollig and Keller 2002; Burley 2020",
                  .family = EstimatorFamily::points,
                  .kind = EstimatorKind::point_set,
                  .at_independent_points = "product hierarchical",
                  .make =
                      [](const EnvironmentMap& map) {
                        return samples_at_points(hierarchical_product_source(map), kSobol);
                      }},
    EstimatorInfo{
        .name = "light sets",
        .description = "lights drawn beforehand, 1024 for each of 64 orientations of the surface",
        .source = "precomputed importance sampling; Agarwal et al. 2003",
        .family = EstimatorFamily::lights,
        .kind = EstimatorKind::precomputed,
        .is_biased = true,
        .unpredicted = "sets that are drawn beforehand are not known before they are",
        .make = [](const EnvironmentMap& map) { return light_sets(map); }},
    EstimatorInfo{
        .name = "riemann",
        .description = "midpoints in azimuth and polar angle, about twice as many azimuths",
        .source = "the lecture: rho pi / (K J) times the sum of L cos sin",
        .family = EstimatorFamily::quadrature,
        .kind = EstimatorKind::deterministic,
        .is_biased = true,
        .bias_vanishes = true,
        .unpredicted = "its error depends on where its steps fall",
        .make = riemann_sum},
    EstimatorInfo{.name = "median cut 16",
                  .description = "16 lights of equal power, each with a shadow ray",
                  .source = "Debevec 2005",
                  .family = EstimatorFamily::lights,
                  .kind = EstimatorKind::deterministic,
                  .is_biased = true,
                  .lights = 16,
                  .ignores_budget = true,
                  .make = median_cut_of<4>},
    EstimatorInfo{.name = "median cut 64",
                  .description = "64 lights of equal power, each with a shadow ray",
                  .source = "Debevec 2005",
                  .family = EstimatorFamily::lights,
                  .kind = EstimatorKind::deterministic,
                  .is_biased = true,
                  .lights = 64,
                  .ignores_budget = true,
                  .make = median_cut_of<6>},
    EstimatorInfo{.name = "median cut 256",
                  .description = "256 lights of equal power, each with a shadow ray",
                  .source = "Debevec 2005",
                  .family = EstimatorFamily::lights,
                  .kind = EstimatorKind::deterministic,
                  .is_biased = true,
                  .lights = 256,
                  .ignores_budget = true,
                  .make = median_cut_of<8>},
    EstimatorInfo{.name = "median cut 1024",
                  .description = "1024 lights of equal power, each with a shadow ray",
                  .source = "Debevec 2005",
                  .family = EstimatorFamily::lights,
                  .kind = EstimatorKind::deterministic,
                  .is_biased = true,
                  .lights = 1024,
                  .ignores_budget = true,
                  .make = median_cut_of<10>},
    EstimatorInfo{
        .name = "filtered importance sampling",
        .description = "the material's lobes at Hammersley's points, looked up in smaller maps",
        .source = "Křivánek and Colbert 2008",
        .family = EstimatorFamily::lobes,
        .kind = EstimatorKind::point_set,
        .is_biased = true,
        .bias_vanishes = true,
        .unpredicted = "its blur depends on the number of samples and on their densities",
        .make = filtered_sampling},
    EstimatorInfo{.name = "sh-9",
                  .description = "irradiance by nine spherical harmonics; ignores occlusion",
                  .source = "Ramamoorthi and Hanrahan 2001",
                  .family = EstimatorFamily::precomputed,
                  .kind = EstimatorKind::precomputed,
                  .is_biased = true,
                  .ignores_occlusion = true,
                  .ignores_budget = true,
                  .is_representative = true,
                  .serves = is_lambert,
                  .make = harmonic_irradiance},
    EstimatorInfo{.name = "tabulated irradiance",
                  .description = "irradiance of 64 x 32 normals, interpolated; ignores occlusion",
                  .source = "Miller and Hoffman 1984; Greene 1986",
                  .family = EstimatorFamily::precomputed,
                  .kind = EstimatorKind::precomputed,
                  .is_biased = true,
                  .ignores_occlusion = true,
                  .ignores_budget = true,
                  .serves = is_lambert,
                  .make = tabulated_irradiance},
    EstimatorInfo{
        .name = "split-sum",
        .description =
            "a chain of maps prefiltered by GGX, times the light of a white sky; ignores occlusion",
        .source = "Karis 2013",
        .family = EstimatorFamily::precomputed,
        .kind = EstimatorKind::precomputed,
        .is_biased = true,
        .ignores_occlusion = true,
        .ignores_budget = true,
        .is_representative = true,
        .serves = is_ggx,
        .make = split_sum},
    EstimatorInfo{.name = "prefiltered phong",
                  .description = "irradiance and a map prefiltered by Phong's lobe, times the "
                                 "light of a white sky; ignores occlusion",
                  .source = "Heidrich and Seidel 1999; the lecture",
                  .family = EstimatorFamily::precomputed,
                  .kind = EstimatorKind::precomputed,
                  .is_biased = true,
                  .ignores_occlusion = true,
                  .ignores_budget = true,
                  .serves = is_phong,
                  .make = prefiltered_phong},
    EstimatorInfo{.name = "outgoing table",
                  .description = "reflected radiance of 32 x 16 normals and 16 x 8 views, the "
                                 "nearest; ignores occlusion",
                  .source = "after Kautz and McCool 1999, without separation",
                  .family = EstimatorFamily::precomputed,
                  .kind = EstimatorKind::precomputed,
                  .is_biased = true,
                  .ignores_occlusion = true,
                  .ignores_budget = true,
                  .make = outgoing_table},
};

}  // namespace

std::span<const EstimatorInfo> estimators() { return kEstimators; }

const EstimatorInfo& estimator_by_name(std::string_view name) {
  const auto found = std::find_if(kEstimators.begin(), kEstimators.end(),
                                  [&](const EstimatorInfo& row) { return row.name == name; });
  if (found != kEstimators.end()) return *found;
  std::string names;
  for (const EstimatorInfo& row : kEstimators) {
    names.append(names.empty() ? "" : ", ").append(row.name);
  }
  throw InputError("there is no estimator \"" + std::string(name) + "\": there are " + names);
}

}  // namespace lightproof
