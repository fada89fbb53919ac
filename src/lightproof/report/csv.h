// The numbers behind every chart and table as comma-separated values (RFC 4180, but lines end in
// \n). Doubles are written with the digits that restore them exactly; "nan", "inf" and "-inf" are
// possible, and an empty field is a value that does not exist.
#pragma once

#include <string>
#include <vector>

#include "lightproof/results/convergence_record.h"
#include "lightproof/results/gate_result.h"
#include "lightproof/results/growth_fit.h"
#include "lightproof/results/map_record.h"
#include "lightproof/results/published_comparison.h"
#include "lightproof/results/render_record.h"
#include "lightproof/results/self_test_result.h"
#include "lightproof/results/split_sum_record.h"
#include "lightproof/results/throughput_record.h"

namespace lightproof {

/// The tests of a gate: one row per test.
std::string gate_csv(const GateResult& gate);
/// Convergence: one row per record and number of samples.
std::string convergence_csv(const std::vector<ConvergenceRecord>& records);
/// Variance: one row per record, with variance, its prediction, their ratio, and the fitted slope.
std::string variance_csv(const std::vector<ConvergenceRecord>& records);
/// Throughput: one row per sampler and map size.
std::string throughput_csv(const std::vector<ThroughputRecord>& records);
/// Growth: one row per sampler, with exponents, sizes at which its table outgrows a cache, and its
/// breakpoints.
std::string growth_csv(const std::vector<GrowthFit>& growth);
/// Times to build: one row per sampler and map size.
std::string build_csv(const std::vector<ThroughputRecord>& records);
/// Tables: one row per sampler and map size, with time, bytes and error of the worst texel.
std::string tables_csv(const std::vector<TableRecord>& records);
std::string directions_csv(const std::vector<DirectionRecord>& records);
/// Renders: one row per picture.
std::string renders_csv(const std::vector<RenderRecord>& records);
/// Mutants: one row per mutant and test that rejects it.
std::string mutants_csv(const std::vector<KillRecord>& mutants);
/// Maps: one row per map.
std::string maps_csv(const std::vector<MapRecord>& records);
/// The split sum's error: one row per map, reflectance, roughness and view angle.
std::string split_sum_csv(const std::vector<SplitSumRecord>& records);
/// A line for each published form that is wrong or incomplete.
std::string published_csv(const std::vector<PublishedComparison>& comparisons);

}  // namespace lightproof
