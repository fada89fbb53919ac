#include "lightproof/report/measured_csv.h"

#include "lightproof/report/csv_row.h"

namespace lightproof {

using csv_parts::row;

std::string frames_csv(const std::vector<FrameErrorRecord>& frames) {
  std::string csv = "construction,source,precision,pole,distance,error\n";
  for (const FrameErrorRecord& r : frames) {
    csv += row(r.construction, r.source, r.is_float ? "float" : "double",
               r.is_nadir ? "nadir" : "zenith", r.distance, r.error);
  }
  return csv;
}

std::string point_errors_csv(const std::vector<PointRate>& rates) {
  std::string csv =
      "set,kind,integrand,roughness,seeds,points,rmse,rmse_error,independent,exponent,"
      "exponent_error\n";
  for (const PointRate& r : rates) {
    for (const PointError& e : r.errors) {
      csv += row(r.set, r.kind, r.integrand, r.roughness, r.seeds, e.points, e.rmse, e.rmse_error,
                 e.independent, r.exponent, r.exponent_error);
    }
  }
  return csv;
}

std::string discrepancy_csv(const std::vector<PointDiscrepancy>& discrepancies) {
  std::string csv = "set,kind,points,star,l2_star,independent_l2_star\n";
  for (const PointDiscrepancy& r : discrepancies) {
    csv += row(r.set, r.kind, r.points, r.star, r.l2_star, r.independent_l2);
  }
  return csv;
}

std::string decay_csv(const std::vector<PointDecay>& decay) {
  std::string csv = "set,first,window,distinct,distinct_s,distinct_t,error_s,error_t\n";
  for (const PointDecay& r : decay) {
    csv +=
        row(r.set, r.first, r.window, r.distinct, r.distinct_s, r.distinct_t, r.error_s, r.error_t);
  }
  return csv;
}

std::string level_costs_csv(const std::vector<LevelCost>& levels) {
  std::string csv =
      "map,map_size,level,size,method,setting,error,error_low,error_high,texels,ms,ms_low,"
      "ms_high\n";
  for (const LevelCost& r : levels) {
    csv +=
        row(r.map, r.map_extent, r.level, r.level_extent, r.method, r.setting, r.error, r.error_low,
            r.error_high, r.texels, r.milliseconds.median, r.milliseconds.low, r.milliseconds.high);
  }
  return csv;
}

std::string thread_gains_csv(const std::vector<ThreadGain>& gains) {
  std::string csv =
      "work,one_thread_ms,one_low,one_high,two_threads_ms,two_low,two_high,gain,"
      "wall_over_processor\n";
  for (const ThreadGain& r : gains) {
    csv += row(r.work, r.one.median, r.one.low, r.one.high, r.two.median, r.two.low, r.two.high,
               r.one.median / r.two.median, r.wall_over_processor);
  }
  return csv;
}

}  // namespace lightproof
