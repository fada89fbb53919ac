#include "lightproof/report/pareto.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

namespace lightproof {

std::vector<TableRecord> pareto_front(std::vector<TableRecord> records, TableCost first,
                                      TableCost second) {
  std::sort(records.begin(), records.end(), [&](const TableRecord& a, const TableRecord& b) {
    return std::tie(a.*first, a.*second) < std::tie(b.*first, b.*second);
  });
  std::vector<TableRecord> front;
  double least = HUGE_VAL;
  for (const TableRecord& record : records) {
    const bool equals_last = !front.empty() && record.*first == front.back().*first &&
                             record.*second == front.back().*second;
    if (!(record.*second < least) && !equals_last) continue;
    least = record.*second;
    front.push_back(record);
  }
  return front;
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
