#include "lightproof/report/rejection_files.h"

#include "lightproof/core/atomic_file.h"
#include "lightproof/image/writer.h"
#include "lightproof/report/json.h"
#include "lightproof/report/names.h"
#include "lightproof/report/pictures.h"

namespace lightproof {
namespace {

/// Standard deviations at which the colours are full.
constexpr double kFullColour = 10.0;
constexpr int kPixelsPerBin = 16;

std::string stem_of(const std::string& sampler, const std::string& density_space,
                    const std::string& map) {
  return file_name_part(sampler + (density_space.empty() ? "" : "-" + density_space) + "-" + map);
}

Grid<Rgb> enlarged(const Grid<Rgb>& picture, int factor) {
  Grid<Rgb> large({picture.extent().width * factor, picture.extent().height * factor});
  for (int y = 0; y < large.extent().height; ++y) {
    for (int x = 0; x < large.extent().width; ++x) {
      large(x, y) = picture(x / factor, y / factor);
    }
  }
  return large;
}

}  // namespace

std::set<std::string> rejection_file_names(const std::string& sampler,
                                           const std::string& density_space,
                                           const std::string& map) {
  const std::string stem = stem_of(sampler, density_space, map);
  return {stem + "-residual.exr", stem + "-residual.png", stem + ".json"};
}

void write_rejections(const GateResult& gate, const std::filesystem::path& folder,
                      const RunDescription& run, Overwriting overwriting) {
  ResultFolder results(folder, overwriting);
  for (const Rejection& rejection : gate.rejections) {
    const std::filesystem::path stem =
        results.temporary() / stem_of(rejection.sampler, rejection.density_space, rejection.map);
    write_exr(stem.string() + "-residual.exr", flip_rows(grey_picture(rejection.residual)));
    const Grid<Rgb> colours = flip_rows(diverging_picture(rejection.residual, kFullColour));
    write_png(stem.string() + "-residual.png", enlarged(colours, kPixelsPerBin));
    write_file(stem.string() + ".json", rejection_json(gate, rejection, run));
  }
  results.commit(run);
}

}  // namespace lightproof
