#include "lightproof/report/report.h"

#include <algorithm>

#include "lightproof/core/error.h"
#include "lightproof/core/pending_file.h"
#include "lightproof/image/writer.h"
#include "lightproof/report/csv.h"
#include "lightproof/report/json.h"
#include "lightproof/report/names.h"
#include "lightproof/report/page.h"
#include "lightproof/report/pictures.h"

namespace lightproof {
namespace fs = std::filesystem;
namespace {

/// Each scene's pictures at one exposure, as in the report; the values themselves as EXR.
void write_scene(const RenderScene& scene, const std::vector<std::string>& stems,
                 const std::vector<RenderRecord>& renders, const fs::path& folder) {
  const Grid<Rgb>& reference = renders[scene.members.front()].reference;
  const double exposure = mean_exposure(reference);
  write_exr(folder / (scene.stem + "-reference.exr"), reference);
  write_png(folder / (scene.stem + "-reference.png"), tone_mapped(reference, exposure));
  for (const std::size_t i : scene.members) {
    write_exr(folder / (stems[i] + ".exr"), renders[i].picture);
    write_png(folder / (stems[i] + ".png"), tone_mapped(renders[i].picture, exposure));
    write_exr(folder / (stems[i] + "-error.exr"), grey_picture(renders[i].error));
  }
}

void write_pictures(const std::vector<RenderRecord>& renders, const fs::path& folder) {
  const std::vector<std::string> stems = render_stems(renders);
  for (const RenderScene& scene : render_scenes(renders)) {
    write_scene(scene, stems, renders, folder);
  }
}

void write_tables(const StudyResult& study, const fs::path& folder) {
  write_file(folder / "gate.csv", gate_csv(study.gate));
  write_file(folder / "convergence.csv", convergence_csv(study.convergence));
  write_file(folder / "variance.csv", variance_csv(study.convergence));
  write_file(folder / "throughput.csv", throughput_csv(study.throughput));
  write_file(folder / "growth.csv", growth_csv(study.growth));
  write_file(folder / "build.csv", build_csv(study.throughput));
  write_file(folder / "tables.csv", tables_csv(study.tables));
  write_file(folder / "renders.csv", renders_csv(study.renders));
  write_file(folder / "maps.csv", maps_csv(study.maps));
  if (study.self_test) {
    write_file(folder / "mutants.csv", mutants_csv(study.self_test->mutants));
  }
  write_file(folder / "results.json", study_json(study));
}

}  // namespace

void write_report(const StudyResult& study, const fs::path& folder) {
  PendingFolder pending(folder);
  const std::string temporary = pending.temporary().string();
  try {
    write_pictures(study.renders, temporary);
    write_tables(study, temporary);
    write_file(pending.temporary() / "report.html", report_page(study));
  } catch (const InputError& error) {
    // The reader knows the final name.
    std::string text = error.what();
    if (text.starts_with(temporary)) text.replace(0, temporary.size(), folder.string());
    throw InputError(text);
  }
  pending.commit();
}

}  // namespace lightproof
