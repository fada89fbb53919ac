#include "lightproof/systems/registry.h"

#include <algorithm>
#include <array>

namespace lightproof {
namespace {

constexpr std::array<SourceDocument, 4> kDocuments = {{
    {"000", "lecture: image-based lighting by sampling the environment"},
    {"002", "lecture: image-based lighting by prefiltered maps and the split sum"},
    {"003", "article: image-based real-time environment lighting"},
    {"004", "course project: precomputed irradiance and reflectivity maps"},
}};

constexpr SystemInfo kSystems[] = {
    {"000-1", "direction to (s, t) and back", "EveryPreset.FollowsThePublishedFormula"},
    {"000-2", "decoding and luminance of the map", "Luminance.WeighsTheChannels"},
    {"000-3", "averages of rows and of the map", "Marginals.AreSumsOfRowsAndColumns"},
    {"000-4", "linear scan: random numbers to (s, t)",
     "LinearScanPublished.BlackFirstRowAtZeroLeavesTheMap"},
    {"000-5", "the 2 pi^2 sin(theta) estimator",
     "Convergence.VariancesAndSlopesAreThePredictedOnes"},
    {"000-6", "sampling the BRDF against sampling the environment",
     "Convergence.MeasuredErrorsAreThePredictedOnes"},
    {"002-1", "modified Phong model", "ModifiedPhong.LosesHalfOfItsLobeAndMoreAtGrazingView"},
    {"002-2", "diffuse reflection by a Riemann sum of K x J nodes",
     "RiemannSum.OfConstantLightIsOffByAKnownFactor"},
    {"002-3", "diffuse reflection by cosine-distributed samples",
     "SampledIrradiance.ByCosineHasNoVarianceUnderConstantLight"},
    {"002-4", "map prefiltered by Phong lobes, one exponent a level",
     "ZonalFactors.OfPhongAreTheClosedForms"},
    {"002-5", "BRDF integration map of the split sum", "BrdfIntegral.HasThePrintedValues"},
    {"002-6", "shading by metallic and roughness with the split sum",
     "MetallicRoughnessSphere.IsTheOneByBruteForceInEveryPixelUnderAWhiteSky"},
    {"003-1", "Fresnel factor that knows roughness",
     "SchlickFresnelOfRoughness.IsSchlicksOwnForAMirror", true},
    {"003-2", "irradiance map by cosine-distributed samples",
     "SampledIrradianceMap.HasTheErrorThatItsVariancePredicts"},
    {"003-3", "cosine sampling in a tangent frame",
     "CosineHemisphere.HasUniformSquaresOfTheCosineAndUniformAzimuths"},
    {"003-4", "cosine sampling by the rotation of a quaternion",
     "PublishedQuaternion.GivesNoUnitVectorsNextToTheNadir"},
    {"003-5", "first part of the split sum, n = v = r",
     "SpecularChain.LevelsAreTheMapBlurredByTheirRoughness"},
    {"003-6", "GGX half-vectors by inversion",
     "GgxHalfVectors.MirrorTheirShareFromBelowTheHorizon"},
    {"003-7", "levels by roughness, interpolated trilinearly",
     "ChainInterpolation.StaysBelowItsBound"},
    {"003-8", "second part of the split sum", "BrdfIntegral.IsThatOverDirectionsOfLight"},
    {"004-1", "progressive accumulation", "SwappedBlend.NeverConverges"},
    {"004-2", "irradiance map, its shader and its formula",
     "SampledIrradiance.UniformlyAsPublishedIsTooSmallByFourPiSquared"},
    {"004-3", "diffuse light without the Fresnel factor",
     "SchlickFresnel.LeavesTwentyTwentyFirstsOfWhatEntersOnAverage"},
    {"004-4", "shininess of a roughness", "BlinnShininess.HasLevelsInTheMiddlesOfSevenths"},
    {"004-5", "half-vector of Blinn's distribution",
     "BlinnPdfs.IntegrateToOneWhereThePublishedOneIntegratesToTwoPi"},
    {"004-6", "weight of a half-vector sample",
     "PublishedBlinn.WeighsByTwoOverPiTimesTheCorrectedWeight"},
    {"004-7", "samples skipped, and the rest normalised",
     "Reflectivity.OfAWhiteMapIsTheExactValueOfItsForm"},
    {"004-8", "sampling until one sample is good",
     "PublishedReflectivity.DrawsOnUntilASampleIsGood"},
    {"004-9", "geometry term at n = v", "WhiteMap.ByEachGeometryTermIsItsIntegral"},
    {"004-10", "levels of half the size", "Reflectivity.MapsAreTwiceAsWideAsHigh"},
    {"004-11", "hash of pixel and frame (pcg3d)", "FrameIndex.IsRoundedOrStandsStillAsAFloat",
     true},
    {"004-12", "golden ratio, R2 and the metallic numbers", "FloatDecay.LeavesFewPointsOfR2"},
    {"004-13", "files: Radiance, and PNG by Reinhard's operator",
     "MapFiles.ShowAMapByReinhardsCurve"},
    {"004-14", "Fresnel factor of the mirrored direction",
     "Comparisons.OfTheFresnelTermIntegrateItUnderTheIntegral"},
    {"004-15", "a scene shaded with both maps",
     "TwoMaps.ShowTheReflectionOfTheSurfaceSeenAlongItsNormal"},
    {"004-16", "pixel to normal", "EveryPreset.ReturnsImagePoints"},
};

}  // namespace

std::span<const SourceDocument> source_documents() { return kDocuments; }

std::span<const SystemInfo> systems() { return kSystems; }

std::string_view document_of(const SystemInfo& system) {
  return std::find_if(kDocuments.begin(), kDocuments.end(),
                      [&](const SourceDocument& d) { return system.id.starts_with(d.number); })
      ->title;
}

}  // namespace lightproof
