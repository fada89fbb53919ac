#include "lightproof/report/measured_json.h"

#include "lightproof/report/json_number.h"

namespace lightproof {
namespace {

using Json = nlohmann::ordered_json;
using json_parts::number;

Json json_of(const PointRate& r) {
  Json errors = Json::array();
  for (const PointError& e : r.errors) {
    errors.push_back({{"points", e.points},
                      {"rmse", number(e.rmse)},
                      {"rmse_error", number(e.rmse_error)},
                      {"independent", number(e.independent)}});
  }
  return {{"set", r.set},
          {"kind", r.kind},
          {"integrand", r.integrand},
          {"roughness", r.roughness},
          {"seeds", r.seeds},
          {"errors", errors},
          {"exponent", number(r.exponent)},
          {"exponent_error", number(r.exponent_error)}};
}

Json json_of(const PointDiscrepancy& r) {
  return {{"set", r.set},
          {"kind", r.kind},
          {"points", r.points},
          {"star", number(r.star)},
          {"l2_star", number(r.l2_star)},
          {"independent_l2_star", number(r.independent_l2)}};
}

Json json_of(const PointDecay& r) {
  return {{"set", r.set},
          {"first", r.first},
          {"window", r.window},
          {"distinct", r.distinct},
          {"distinct_s", r.distinct_s},
          {"distinct_t", r.distinct_t},
          {"error_s", number(r.error_s)},
          {"error_t", number(r.error_t)}};
}

Json json_of(const TimeRange& time) {
  return {{"median", number(time.median)}, {"low", number(time.low)}, {"high", number(time.high)}};
}

Json json_of(const LevelCost& r) {
  return {{"map", r.map},
          {"map_size", json_parts::size(r.map_extent)},
          {"level", r.level},
          {"size", json_parts::size(r.level_extent)},
          {"method", r.method},
          {"setting", r.setting},
          {"error", number(r.error)},
          {"error_low", number(r.error_low)},
          {"error_high", number(r.error_high)},
          {"texels", r.texels},
          {"milliseconds", json_of(r.milliseconds)}};
}

Json json_of(const ThreadGain& r) {
  return {{"work", r.work},
          {"one_thread", json_of(r.one)},
          {"two_threads", json_of(r.two)},
          {"gain", number(r.one.median / r.two.median)},
          {"wall_over_processor", number(r.wall_over_processor)}};
}

template <class Record>
Json list_of(const std::vector<Record>& records) {
  Json list = Json::array();
  for (const Record& record : records) list.push_back(json_of(record));
  return list;
}

}  // namespace

Json frames_json(const std::vector<FrameErrorRecord>& frames) {
  Json list = Json::array();
  for (const FrameErrorRecord& r : frames) {
    list.push_back({{"construction", r.construction},
                    {"source", r.source},
                    {"precision", r.is_float ? "float" : "double"},
                    {"pole", r.is_nadir ? "-z" : "+z"},
                    {"distance", number(r.distance)},
                    {"error", number(r.error)}});
  }
  return list;
}

Json points_json(const PointStudy& points) {
  return {{"rates", list_of(points.rates)},
          {"discrepancies", list_of(points.discrepancies)},
          {"decay", list_of(points.decay)}};
}

Json level_costs_json(const LevelCosts& costs) {
  return {{"levels", list_of(costs.levels)},
          {"thread_gains", list_of(costs.gains)},
          {"origin", costs.origin}};
}

}  // namespace lightproof
