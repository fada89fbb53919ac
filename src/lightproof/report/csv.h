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
#include "lightproof/results/render_record.h"
#include "lightproof/results/self_test_result.h"
#include "lightproof/results/throughput_record.h"

namespace lightproof {

std::string gate_csv(const GateResult& gate);
/// One row per record and number of samples.
std::string convergence_csv(const std::vector<ConvergenceRecord>& records);
/// One row per record: variance, its prediction, their ratio, and the fitted slope.
std::string variance_csv(const std::vector<ConvergenceRecord>& records);
std::string throughput_csv(const std::vector<ThroughputRecord>& records);
/// One row per sampler: exponents, sizes at which its table outgrows a cache, and its breakpoints.
std::string growth_csv(const std::vector<GrowthFit>& growth);
/// One row per record: the time to build.
std::string build_csv(const std::vector<ThroughputRecord>& records);
std::string tables_csv(const std::vector<TableRecord>& records);
std::string renders_csv(const std::vector<RenderRecord>& records);
/// One row per mutant and test that rejects it.
std::string mutants_csv(const std::vector<KillRecord>& mutants);
std::string maps_csv(const std::vector<MapRecord>& records);

}  // namespace lightproof
