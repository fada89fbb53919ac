#include "lightproof/shading/shaded_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lightproof/core/parallel.h"
#include "lightproof/image/map_levels.h"
#include "lightproof/prefilter/reflectivity.h"
#include "lightproof/render/picture.h"
#include "lightproof/shading/metallic_roughness.h"
#include "lightproof/shading/two_maps.h"

namespace lightproof {
namespace {

constexpr Extent kMapExtent = {128, 64};

/// A dim room, darker below, with two bright windows on the side of the camera: their reflections
/// show how far a lobe blurs.
EnvironmentMap room_with_windows() {
  EnvironmentMap map{"a room with two windows", Grid<Rgb>(kMapExtent)};
  for (int y = 0; y < kMapExtent.height; ++y) {
    for (int x = 0; x < kMapExtent.width; ++x) {
      const double s = (x + 0.5) / kMapExtent.width;
      const double t = (y + 0.5) / kMapExtent.height;
      const bool left = s > 0.58 && s < 0.66 && t > 0.52 && t < 0.72;
      const bool right = s > 0.79 && s < 0.84 && t > 0.55 && t < 0.68;
      map.radiance(x, y) = left    ? Rgb(8.0F, 9.0F, 10.0F)
                           : right ? Rgb(12.0F, 10.0F, 7.0F)
                                   : static_cast<float>(0.15 + 0.35 * t) * Rgb(1.0F, 0.95F, 0.9F);
    }
  }
  return map;
}

/// A pixel of what is compared.
struct PixelIndex {
  int x;
  int y;
};

/// Fills the errors, and their root mean squares. `standard_error` is of luminance, pixel by pixel;
/// empty if the exact picture has none.
void compare(PublishedPicture& picture, const std::vector<PixelIndex>& compared,
             const std::vector<double>& standard_errors) {
  const auto luminance = [](const Grid<Rgb>& of, PixelIndex at) {
    return luminance_of(of(at.x, at.y));
  };
  const double count = static_cast<double>(compared.size());
  double mean = 0.0;
  for (const PixelIndex at : compared) mean += luminance(picture.exact, at) / count;
  const auto error_of = [&](const Grid<Rgb>& form, Grid<double>& error) {
    error = Grid<double>(form.extent());
    double squares = 0.0;
    for (const PixelIndex at : compared) {
      const double difference = (luminance(form, at) - luminance(picture.exact, at)) / mean;
      error(at.x, at.y) = difference;
      squares += difference * difference / count;
    }
    return std::sqrt(squares);
  };
  picture.published_rmse = error_of(picture.published, picture.published_error);
  picture.corrected_rmse = error_of(picture.corrected, picture.corrected_error);
  double noise = 0.0;
  for (const double error : standard_errors) noise += error * error / count / (mean * mean);
  picture.noise = std::sqrt(noise);
}

/// A bound: the errors of red, green and blue come of the same samples.
double luminance_error(glm::dvec3 standard_error) {
  return kRec709.red * standard_error.r + kRec709.green * standard_error.g +
         kRec709.blue * standard_error.b;
}

std::string brute_force_text(std::uint64_t samples) {
  return fmt::format("every pixel integrated, {} samples", samples);
}

}  // namespace

PublishedPicture shaded_sphere(const EnvironmentMap& map, const LayeredSurface& surface,
                               const ShadePoint& published, const ShadePoint& corrected,
                               const ShadedPictureOptions& options) {
  const ReceiverInfo& receiver = receiver_by_name("sphere");
  const Scene scene(receiver.content);
  const RandomStream stream("shaded-sphere/" + map.name, options.seed);
  const auto picture_by = [&](const ShadePoint& shade) {
    return render_picture(
        map, scene, receiver, options.picture, stream,
        [&](const ShadingPoint& at, const RandomStream& /*unused*/) { return Rgb(shade(at)); });
  };
  PublishedPicture picture;
  picture.published = picture_by(published);
  picture.corrected = picture_by(corrected);
  picture.exact = picture.published;
  const std::vector<Pixel> pixels = visible_pixels(receiver, scene, options.picture);
  const LayeredLight light(map, scene);
  std::vector<double> noise(pixels.size());
  parallel_for(pixels.size(), [&](std::size_t i) {
    const LayeredEstimate estimate =
        light.reflected(surface, pixels[i].point, stream.substream(i), options.samples);
    picture.exact(pixels[i].x, pixels[i].y) = Rgb(estimate.radiance);
    noise[i] = luminance_error(estimate.standard_error);
  });
  std::vector<PixelIndex> compared;
  for (const Pixel& pixel : pixels) compared.push_back({pixel.x, pixel.y});
  compare(picture, compared, noise);
  picture.exact_form = brute_force_text(options.samples);
  return picture;
}

PublishedPicture metallic_roughness_picture(const ShadedPictureOptions& options) {
  constexpr int kLevels = 5;
  const EnvironmentMap map = room_with_windows();
  MetallicRoughness gold;
  gold.base_colour = {1.0, 0.77, 0.34};
  gold.metallic = 1.0;
  gold.roughness = 0.4;
  const MetallicRoughnessMaps maps(map, kMapExtent, kLevels);
  const auto by = [&](LevelForm form) {
    return [&gold, &maps, form](const ShadingPoint& at) {
      return shaded(gold, maps, at.frame.normal, at.view, form).rgb;
    };
  };
  const LayeredSurface surface = {Ggx{gold.roughness, 0.0}, normal_reflectance(gold),
                                  (1.0 - gold.metallic) * gold.base_colour};
  PublishedPicture picture =
      shaded_sphere(map, surface, by(LevelForm::published), by(LevelForm::corrected), options);
  picture.system = "002-6";
  picture.what = fmt::format(
      "a golden sphere of roughness {} in a room with two windows, shaded by the "
      "split sum with {} levels",
      gold.roughness, kLevels);
  picture.published_form = "level R mipCount: too rough";
  picture.corrected_form = "level R (mipCount \u2212 1)";
  return picture;
}

PublishedPicture reflectivity_picture(const ShadedPictureOptions& options) {
  constexpr double kRoughness = 0.5;
  constexpr int kFrames = 64;
  constexpr Extent kExtent = {96, 48};
  constexpr int kSamplesOfFrame = 16;
  const EnvironmentMap map = room_with_windows();
  const Lobe lobe = HalfVectorLobe{half_vector_shininess(kRoughness)};
  const auto from_top = [](const Grid<Rgb>& level) { return lat_long_level(level).faces.front(); };
  const auto accumulated = [&](ReflectivityForm form) {
    ReflectivityAccumulation accumulation(map.radiance, kExtent, kRoughness, form,
                                          RandomStream("reflectivity-picture", options.seed));
    for (int frame = 0; frame < kFrames; ++frame) accumulation.add_frame(kSamplesOfFrame);
    return from_top(accumulation.mean());
  };
  PublishedPicture picture;
  picture.system = "004-7";
  picture.what = fmt::format(
      "the reflectivity map of roughness {} of a room with two windows, {} frames of "
      "{} samples",
      kRoughness, kFrames, kSamplesOfFrame);
  picture.published_form = "divided by the number of good samples";
  picture.corrected_form = "divided by the sum of their weights";
  picture.exact_form = "the map convolved with the lobe";
  const std::vector<PrefilteredLevel> level = {{lobe, kExtent}};
  picture.exact = from_top(prefilter(map.radiance, level).front());
  picture.published = accumulated(ReflectivityForm::published);
  picture.corrected = accumulated(ReflectivityForm::normalised);
  std::vector<PixelIndex> compared;
  for (int y = 0; y < kExtent.height; ++y) {
    for (int x = 0; x < kExtent.width; ++x) compared.push_back({x, y});
  }
  compare(picture, compared, {});
  return picture;
}

PublishedPicture two_maps_picture(const ShadedPictureOptions& options) {
  const EnvironmentMap map = room_with_windows();
  const GlossyOnDiffuse glossy = {0.5, 0.04, {0.8, 0.1, 0.1}};
  const TwoMaps program(map, kMapExtent, kReflectivityLevels, TwoMapsForm::program);
  const TwoMaps corrected(map, kMapExtent, kReflectivityLevels, TwoMapsForm::corrected);
  const auto by = [&glossy](const TwoMaps& maps) {
    return [&glossy, &maps](const ShadingPoint& at) {
      return maps.shaded(glossy, at.frame.normal, at.view).rgb;
    };
  };
  const LayeredSurface surface = {BlinnMicrofacet{glossy.roughness, 0.0},
                                  glm::dvec3(glossy.normal_reflectance), glossy.colour,
                                  BaseShare::of_light};
  PublishedPicture picture = shaded_sphere(map, surface, by(program), by(corrected), options);
  picture.system = "004-15";
  picture.what = fmt::format(
      "a red glossy sphere of roughness {} in a room with two windows, shaded with "
      "a reflectivity map and an irradiance map",
      glossy.roughness);
  picture.published_form =
      "the program's maps: c E where c E/\u03c0 is meant, reflections at 2/\u03c0";
  picture.corrected_form =
      "c E/\u03c0 behind the coat, the lobe's own weight; what is left is F taken at n\u00b7v "
      "(004-14)";
  return picture;
}

std::vector<PublishedPicture> shaded_pictures(const ShadedPictureOptions& options,
                                              const Progress& progress) {
  std::vector<PublishedPicture> pictures;
  for (const auto& make : {metallic_roughness_picture, reflectivity_picture, two_maps_picture}) {
    if (progress) progress("published forms", static_cast<double>(pictures.size()) / 3.0);
    pictures.push_back(make(options));
  }
  return pictures;
}

}  // namespace lightproof
