#include "lightproof/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "lightproof/core/error.h"
#include "lightproof/core/pending_file.h"
#include "lightproof/image/writer.h"
#include "lightproof/report/csv.h"
#include "lightproof/report/json.h"
#include "lightproof/report/names.h"
#include "lightproof/report/page.h"

namespace lightproof {
namespace fs = std::filesystem;
namespace {

void create_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw InputError(
        fmt::format("{}: cannot create the folder: {}", folder.string(), error.message()));
  }
}

Grid<Rgb> grey(const Grid<double>& values) {
  Grid<Rgb> picture(values.extent());
  std::transform(values.values().begin(), values.values().end(), picture.values().begin(),
                 [](double value) { return Rgb(static_cast<float>(value)); });
  return picture;
}

void write_pictures(const std::vector<RenderRecord>& renders, const fs::path& folder) {
  const std::vector<std::string> stems = render_stems(renders);
  for (std::size_t i = 0; i < renders.size(); ++i) {
    write_exr(folder / (stems[i] + ".exr"), renders[i].picture);
    write_exr(folder / (stems[i] + "-error.exr"), grey(renders[i].error));
  }
  for (const RenderScene& scene : render_scenes(renders)) {
    write_exr(folder / (scene.stem + "-reference.exr"), renders[scene.members.front()].reference);
  }
}

void write_tables(const StudyResult& study, const fs::path& folder) {
  write_file(folder / "gate.csv", gate_csv(study.gate));
  write_file(folder / "convergence.csv", convergence_csv(study.convergence));
  write_file(folder / "variance.csv", variance_csv(study.convergence));
  write_file(folder / "throughput.csv", throughput_csv(study.throughput));
  write_file(folder / "renders.csv", renders_csv(study.renders));
  write_file(folder / "maps.csv", maps_csv(study.maps));
  write_file(folder / "results.json", study_json(study));
}

}  // namespace

void write_report(const StudyResult& study, const fs::path& folder) {
  create_folder(folder);
  write_pictures(study.renders, folder);
  write_tables(study, folder);
  write_file(folder / "report.html", report_page(study));
}

}  // namespace lightproof
