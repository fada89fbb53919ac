#include "lightproof/study/frame_study.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "lightproof/core/measure.h"
#include "lightproof/warp/frame_errors.h"

namespace lightproof {
namespace {

constexpr int kDecades = 12;
constexpr int kPerDecade = 4;

std::vector<double> distances() {
  std::vector<double> all;
  for (int i = -kDecades * kPerDecade; i <= 0; ++i) {
    all.push_back(std::pow(10.0, static_cast<double>(i) / kPerDecade));
  }
  all.push_back(0.5 * kPi);
  return all;
}

std::string source_of(std::string_view construction) {
  return std::string(
      std::ranges::find(frame_constructions(), construction, &FrameConstruction::name)->source);
}

}  // namespace

std::vector<FrameErrorRecord> study_frames() {
  std::vector<FrameErrorRecord> records;
  for (const FrameError& row : frame_errors(distances())) {
    records.push_back({std::string(row.construction), source_of(row.construction), row.is_float,
                       row.is_nadir, row.distance, row.error});
  }
  return records;
}

}  // namespace lightproof
