// A study as files for people and programs.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "lightproof/report/result_folder.h"
#include "lightproof/results/study_result.h"

namespace lightproof {

/// Names of files that every report has.
std::set<std::string> report_file_names();

/// Writes into `folder`, which is created if need be:
///   report.html    one self-contained page
///   results.json   everything but the pixels (report/json.h)
///   gate.csv, convergence.csv, variance.csv, throughput.csv, growth.csv, build.csv, tables.csv,
///   directions.csv, renders.csv, maps.csv, published.csv, frames.csv, points.csv, discrepancy.csv,
///   decay.csv, levels.csv, thread-gains.csv, mutants.csv, stability.csv, breaking-points.csv
///   MAP-RECEIVER-MATERIAL-ESTIMATOR.exr, …-error.exr (signed, relative to the reference's
///   mean, the same in R, G and B), MAP-RECEIVER-MATERIAL-reference.exr; the pictures and
///   the reference as .png too, at one exposure a scene
///   manifest.json  the list of these (report/result_folder.h)
/// Nothing appears before all of it is written. Throws InputError if one cannot be written, or if a
/// file stands in its way that may not be overwritten.
void write_report(const StudyResult& study, const std::filesystem::path& folder,
                  const RunDescription& run = {}, Overwriting overwriting = Overwriting::refused);

}  // namespace lightproof
