#include "lightproof/report/stability_json.h"

#include <nlohmann/json.hpp>

#include "lightproof/report/json_number.h"

namespace lightproof {
namespace {

using Json = nlohmann::ordered_json;
using json_parts::number;

/// The version of this document. It grows when a key changes its meaning or goes away.
constexpr int kFormatVersion = 1;

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json json_of(const StabilityCaseRecord& r) {
  return {{"number", r.number},
          {"name", r.name},
          {"input", r.input},
          {"required", r.required},
          {"source", r.source}};
}

Json json_of(const StabilityRecord& r) {
  return {{"case", r.number},
          {"kind", r.kind},
          {"method", r.method},
          {"known_defects", r.known_defects},
          {"outcome", to_string(r.outcome)},
          {"passes", passes(r)},
          {"breaks_claim", breaks_claim(r)},
          {"amount", number(r.amount)},
          {"bound", number(r.bound)},
          {"put_in", r.put_in},
          {"came_out", r.came_out},
          {"limit", text_or_null(r.limit)}};
}

Json json_of(const BreakingPoint& r) {
  return {{"quantity", r.quantity},
          {"criterion", r.criterion},
          {"kind", r.kind},
          {"method", r.method},
          {"known_defects", r.known_defects},
          {"easiest", number(r.easiest)},
          {"hardest", number(r.hardest)},
          {"passed", number(r.passed)},
          {"failed", number(r.failed)}};
}

template <class Record>
Json list_of(const std::vector<Record>& records) {
  Json list = Json::array();
  for (const Record& record : records) list.push_back(json_of(record));
  return list;
}

}  // namespace

Json stability_parts_json(const StabilityResult& stability) {
  return {{"cases", list_of(stability.cases)},
          {"records", list_of(stability.records)},
          {"breaking_points", list_of(stability.breaking_points)}};
}

std::string stability_json(const StabilityResult& stability, const StabilityRun& asked,
                           const RunDescription& run) {
  Json document = {{"format_version", kFormatVersion},
                   {"version", run.version},
                   {"commit", text_or_null(run.commit)},
                   {"command", run.command},
                   {"seed", asked.seed},
                   {"thorough", asked.thorough}};
  document.update(stability_parts_json(stability));
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lightproof
