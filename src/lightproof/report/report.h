// A study as files for people and programs.
#pragma once

#include <filesystem>

#include "lightproof/suite/results.h"

namespace lightproof {

/// Writes into `folder`, which is created if need be:
///   report.html    one self-contained page
///   results.json   everything but the pixels (report/json.h)
///   gate.csv, convergence.csv, variance.csv, throughput.csv, tables.csv, renders.csv,
///   maps.csv
///   <map>-<receiver>-<material>-<strategy>.exr, …-error.exr (signed, relative to the reference's
///   mean, the same in R, G and B), <map>-<receiver>-<material>-reference.exr; the pictures and
///   the reference as .png too, at one exposure a scene
/// Nothing appears before all of it is written. Throws InputError if one cannot be written.
void write_report(const StudyResult& study, const std::filesystem::path& folder);

}  // namespace lightproof
