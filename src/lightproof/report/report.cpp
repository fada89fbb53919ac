#include "lightproof/report/report.h"

#include <utility>
#include <vector>

#include "lightproof/core/atomic_file.h"
#include "lightproof/core/error.h"
#include "lightproof/image/writer.h"
#include "lightproof/report/accuracy_tables.h"
#include "lightproof/report/csv.h"
#include "lightproof/report/json.h"
#include "lightproof/report/measured_csv.h"
#include "lightproof/report/names.h"
#include "lightproof/report/pictures.h"
#include "lightproof/report/report_page.h"
#include "lightproof/report/stability_tables.h"

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

using NamedTables = std::vector<std::pair<std::string, std::string>>;

NamedTables tables_of(const StudyResult& study) {
  const SelfTestResult self_test = study.self_test.value_or(SelfTestResult{});
  return {{"gate.csv", gate_csv(study.gate)},
          {"accuracy.csv", accuracy_csv(study.accuracy)},
          {"method-regimes.csv", method_regimes_csv(study.method_regimes)},
          {"convergence.csv", convergence_csv(study.convergence)},
          {"variance.csv", variance_csv(study.convergence)},
          {"throughput.csv", throughput_csv(study.throughput)},
          {"growth.csv", growth_csv(study.growth)},
          {"build.csv", build_csv(study.throughput)},
          {"tables.csv", tables_csv(study.tables)},
          {"directions.csv", directions_csv(study.directions)},
          {"renders.csv", renders_csv(study.renders)},
          {"maps.csv", maps_csv(study.maps)},
          {"split_sum.csv", split_sum_csv(study.split_sum)},
          {"published.csv", published_csv(study.published_forms)},
          {"frames.csv", frames_csv(study.frames)},
          {"points.csv", point_errors_csv(study.points.rates)},
          {"discrepancy.csv", discrepancy_csv(study.points.discrepancies)},
          {"decay.csv", decay_csv(study.points.decay)},
          {"levels.csv", level_costs_csv(study.level_costs.levels)},
          {"thread-gains.csv", thread_gains_csv(study.level_costs.gains)},
          {"stability.csv", stability_csv(study.stability.records)},
          {"breaking-points.csv", breaking_points_csv(study.stability.breaking_points)},
          {"mutants.csv", mutants_csv(self_test.mutants)}};
}

void write_texts(const StudyResult& study, const RunDescription& run, const fs::path& folder) {
  for (const auto& [name, table] : tables_of(study)) {
    if (name == "mutants.csv" && !study.self_test) continue;
    write_file(folder / name, table);
  }
  write_file(folder / "results.json", study_json(study, run));
  write_file(folder / "report.html", report_page(study));
}

}  // namespace

std::set<std::string> report_file_names() {
  std::set<std::string> names = {"report.html", "results.json"};
  for (const auto& [name, table] : tables_of({})) names.insert(name);
  return names;
}

void write_report(const StudyResult& study, const fs::path& folder, const RunDescription& run,
                  Overwriting overwriting) {
  ResultFolder results(folder, overwriting);
  const std::string temporary = results.temporary().string();
  try {
    write_pictures(study.renders, temporary);
    write_texts(study, run, temporary);
  } catch (const InputError& error) {
    // The reader knows the final name.
    std::string text = error.what();
    if (text.starts_with(temporary)) text.replace(0, temporary.size(), folder.string());
    throw InputError(text);
  }
  results.commit(run);
}

}  // namespace lightproof
