#include "lightproof/report/pareto.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>

namespace lightproof {

namespace {

bool beats(const TableRecord& a, const TableRecord& b) {
  const auto costs = [](const TableRecord& r) {
    return std::array{r.ns_per_sample, r.bytes_per_texel, r.worst_texel_error};
  };
  const auto of_a = costs(a);
  const auto of_b = costs(b);
  return of_a != of_b && std::equal(of_a.begin(), of_a.end(), of_b.begin(), std::less_equal<>());
}

}  // namespace

std::vector<TableRecord> unbeaten_tables(const std::vector<TableRecord>& records) {
  std::vector<TableRecord> unbeaten;
  std::copy_if(records.begin(), records.end(), std::back_inserter(unbeaten),
               [&](const TableRecord& r) {
                 return std::none_of(records.begin(), records.end(),
                                     [&](const TableRecord& other) { return beats(other, r); });
               });
  std::stable_sort(unbeaten.begin(), unbeaten.end(),
                   [](const auto& a, const auto& b) { return a.ns_per_sample < b.ns_per_sample; });
  return unbeaten;
}

std::vector<TableRecord> of_largest_map(const std::vector<TableRecord>& records) {
  std::size_t largest = 0;
  for (const TableRecord& record : records) largest = std::max(largest, record.extent.count());
  std::vector<TableRecord> chosen;
  std::copy_if(records.begin(), records.end(), std::back_inserter(chosen),
               [&](const TableRecord& record) { return record.extent.count() == largest; });
  return chosen;
}

}  // namespace lightproof
