// The findings on convergence, variance, renders and maps.
#include "lightproof/report/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lightproof/page/chart_parts.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/gate_summary.h"
#include "lightproof/report/names.h"

namespace lightproof {
namespace {

constexpr double kExpectedSlope = -0.5;
constexpr double kAllButExact = 1e-8;   // relative variance
constexpr double kTelling = 1.0 / 3.0;  // standard error of a point over its prediction
constexpr double kAgreement = 3.0;      // standard errors
constexpr double kBeyond =
    0.0026998;  // share of a normal distribution beyond 3 standard deviations

std::string capitalised(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 32);
  return text;
}

std::string scene_text(const ConvergenceRecord& r) {
  return fmt::format("{} on {}, {}, {}", r.estimator, r.map, r.receiver, r.material);
}

/// |value - expected| in standard errors; without a standard error any difference is infinite.
double deviation(double value, double expected, double error) {
  const double difference = std::abs(value - expected);
  if (std::isnan(difference)) return HUGE_VAL;
  if (difference == 0.0) return 0.0;
  return error > 0.0 ? difference / error : HUGE_VAL;
}

/// How far values lie from what is expected, over the records that have such a value.
struct Agreement {
  std::size_t all = 0;
  std::size_t within = 0;
  double farthest = -1.0;
  const ConvergenceRecord* worst = nullptr;

  void add(double distance, const ConvergenceRecord& record) {
    ++all;
    if (distance <= kAgreement) ++within;
    if (distance > farthest) {
      farthest = distance;
      worst = &record;
    }
  }
};

std::string by_chance(std::size_t all) {
  return fmt::format("normal errors would leave {} outside",
                     format_number(kBeyond * static_cast<double>(all), 2));
}

/// "all 128 ratios", "the one ratio".
std::string all_of(std::size_t count, std::string_view noun) {
  if (count == 1) return fmt::format("the one {}", noun);
  return fmt::format("all {}", counted(count, noun));
}

struct Bounds {
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

std::string slope_sentence(const Agreement& slopes, Bounds range, Bounds errors) {
  if (slopes.within == slopes.all) {
    return capitalised(fmt::format(
        "{} {} with slope \u22120.5 as predicted: fitted slopes from {} to {}, each within 3 of "
        "its standard errors ({} to {})",
        all_of(slopes.all, "estimator"), slopes.all == 1 ? "falls" : "fall",
        format_number(range.low), format_number(range.high), format_number(errors.low, 2),
        format_number(errors.high, 2)));
  }
  const ConvergenceRecord& worst = *slopes.worst;
  return fmt::format(
      "{} of {} fall with slope \u22120.5 within 3 standard errors ({}); the farthest is {} "
      "with slope {}",
      with_thousands(slopes.within), counted(slopes.all, "estimator"), by_chance(slopes.all),
      scene_text(worst), with_error(worst.slope, worst.slope_error));
}

}  // namespace

bool is_all_but_exact(const ConvergenceRecord& record) {
  return std::max(record.measured_variance, record.predicted_variance) < kAllButExact;
}

bool has_slope(const ConvergenceRecord& record) {
  return std::isfinite(record.slope) && record.slope_error > 0.0;
}

std::string convergence_finding(const std::vector<ConvergenceRecord>& records) {
  Agreement slopes;
  Bounds range;
  Bounds errors;
  for (const ConvergenceRecord& r : records) {
    if (!has_slope(r)) continue;
    slopes.add(deviation(r.slope, kExpectedSlope, r.slope_error), r);
    range.add(r.slope);
    errors.add(r.slope_error);
  }
  if (slopes.all == 0) return "No slope could be fitted";
  const std::size_t others = records.size() - slopes.all;
  return slope_sentence(slopes, range, errors) +
         (others == 0 ? "" : fmt::format("; {} could not be fitted", counted(others, "other")));
}

std::string prediction_finding(const std::vector<ConvergenceRecord>& records) {
  Agreement points;
  std::size_t vague = 0;
  for (const ConvergenceRecord& r : records) {
    if (is_all_but_exact(r)) continue;
    for (const ConvergencePoint& p : r.points) {
      if (p.rmse_error > 0.0 && p.rmse_error <= kTelling * p.predicted) {
        points.add(deviation(p.rmse, p.predicted, p.rmse_error), r);
      } else {
        ++vague;
      }
    }
  }
  if (points.all == 0) return "";
  std::string text = fmt::format(
      "{} of {} lie within 3 standard errors of the predicted error ({}); the farthest is {} "
      "standard errors away ({}).",
      with_thousands(points.within), counted(points.all, "measured point"), by_chance(points.all),
      format_number(points.farthest, 2), scene_text(*points.worst));
  if (vague == 0) return text;
  return text + fmt::format(
                    " Left out of this count: {} whose standard error is unknown or more "
                    "than a third of the prediction.",
                    counted(vague, "point"));
}

bool has_ratio(const ConvergenceRecord& record) {
  return record.predicted_variance > 0.0 && std::isfinite(record.predicted_variance) &&
         std::isfinite(record.measured_variance) && record.variance_ratio_error > 0.0 &&
         std::isfinite(record.variance_ratio_error) && !is_all_but_exact(record);
}

bool has_telling_ratio(const ConvergenceRecord& record) {
  return has_ratio(record) && record.variance_ratio_error <= kTelling;
}

std::string variance_finding(const std::vector<ConvergenceRecord>& records) {
  Agreement ratios;
  Bounds range;
  std::size_t vague = 0;
  for (const ConvergenceRecord& r : records) {
    if (!has_ratio(r)) continue;
    if (!has_telling_ratio(r)) {
      ++vague;
      continue;
    }
    const double ratio = r.measured_variance / r.predicted_variance;
    ratios.add(deviation(ratio, 1.0, r.variance_ratio_error), r);
    range.add(ratio);
  }
  if (ratios.all == 0) return "No variance was both measured and predicted";
  const std::string rest =
      vague == 0 ? "" : fmt::format("; {} not counted, with a standard error above a third", vague);
  if (ratios.within == ratios.all) {
    return capitalised(fmt::format(
        "{} of measured to predicted variance within 3 standard errors of 1: from {} to {}{}",
        all_of(ratios.all, "ratio"), format_number(range.low), format_number(range.high), rest));
  }
  const ConvergenceRecord& worst = *ratios.worst;
  return fmt::format(
      "{} of {} of measured to predicted variance within 3 standard errors of 1 ({}); the "
      "farthest is {} with {}{}",
      with_thousands(ratios.within), counted(ratios.all, "ratio"), by_chance(ratios.all),
      scene_text(worst),
      with_error(worst.measured_variance / worst.predicted_variance, worst.variance_ratio_error),
      rest);
}

std::vector<DensityVariances> density_variances(const std::vector<ConvergenceRecord>& records) {
  std::vector<DensityVariances> scenes;
  const auto at_scene_of = [&](const ConvergenceRecord& r) {
    return std::find_if(scenes.begin(), scenes.end(), [&](const DensityVariances& p) {
      return p.scene->map == r.map && p.scene->receiver == r.receiver &&
             p.scene->material == r.material;
    });
  };
  for (const ConvergenceRecord& r : records) {
    for (std::size_t i = 0; i < kDensities.size(); ++i) {
      if (r.estimator != fmt::format("environment {}", kDensities[i].label)) continue;
      auto scene = at_scene_of(r);
      if (scene == scenes.end()) {
        scenes.push_back({&r, {}, 0});
        scene = scenes.end() - 1;
        scene->variances.fill(std::nan(""));
      }
      scene->variances[i] = r.predicted_variance;
    }
  }
  std::erase_if(scenes, [](const DensityVariances& p) {
    return std::count_if(p.variances.begin(), p.variances.end(),
                         [](double v) { return std::isfinite(v); }) < 2;
  });
  for (DensityVariances& p : scenes) {
    const auto unknown_last = [](double a, double b) {
      return (std::isnan(a) ? HUGE_VAL : a) < (std::isnan(b) ? HUGE_VAL : b);
    };
    p.least = static_cast<std::size_t>(
        std::min_element(p.variances.begin(), p.variances.end(), unknown_last) -
        p.variances.begin());
  }
  return scenes;
}

std::string density_finding(const std::vector<DensityVariances>& scenes) {
  std::string text;
  for (std::size_t i = 0; i < kDensities.size(); ++i) {
    const auto best = std::count_if(scenes.begin(), scenes.end(),
                                    [&](const DensityVariances& p) { return p.least == i; });
    if (best == 0) continue;
    text += fmt::format("{}{} ({}) in {}", text.empty() ? "" : ", ", kDensities[i].label,
                        kDensities[i].name, best);
  }
  if (text.empty()) return "";
  return fmt::format("Least exact variance of the densities of the map, over {}: {}",
                     counted(scenes.size(), "scene"), text);
}

std::string saving_finding(const std::vector<const ConvergenceRecord*>& records) {
  const auto by_variance = [](const ConvergenceRecord* a, const ConvergenceRecord* b) {
    return a->predicted_variance < b->predicted_variance;
  };
  const ConvergenceRecord& best = **std::min_element(records.begin(), records.end(), by_variance);
  const ConvergenceRecord& worst = **std::max_element(records.begin(), records.end(), by_variance);
  if (is_all_but_exact(best)) return fmt::format("{} is exact", best.estimator);
  const double factor = worst.predicted_variance / best.predicted_variance;
  if (!(factor > 1.0)) return "no estimator is ahead";
  const double digit = std::pow(10.0, std::floor(std::log10(factor)) - 1.0);
  const std::string times =
      factor < 100.0
          ? format_number(factor, 2)
          : with_thousands(static_cast<std::uint64_t>(std::round(factor / digit) * digit));
  return fmt::format("{} needs {} times fewer samples than {}", best.estimator, times,
                     worst.estimator);
}

namespace {

/// "At 64 samples per pixel ", "In 16 µs a pixel "; empty if neither is equal.
std::string what_is_equal(const std::vector<const RenderRecord*>& scene) {
  const RenderRecord& first = *scene.front();
  if (first.point_seconds > 0.0) {
    return fmt::format("In about {} a pixel ", seconds_text(first.point_seconds));
  }
  const bool equal = std::all_of(scene.begin(), scene.end(), [&](const RenderRecord* r) {
    return r->samples == first.samples;
  });
  return equal ? fmt::format("At {} per pixel ", counted(first.samples, "sample")) : "";
}

}  // namespace

std::string render_finding(const std::vector<const RenderRecord*>& scene) {
  const auto by_error = [](const RenderRecord* a, const RenderRecord* b) {
    return a->rmse < b->rmse;
  };
  const RenderRecord& best = **std::min_element(scene.begin(), scene.end(), by_error);
  const RenderRecord& worst = **std::max_element(scene.begin(), scene.end(), by_error);
  std::string text = fmt::format("{}{} has the smallest error, {} of the mean",
                                 what_is_equal(scene), best.estimator, percent(best.rmse));
  if (&best != &worst && best.rmse > 0.0) {
    text += fmt::format("; that of {} is {} times as large", worst.estimator,
                        format_number(worst.rmse / best.rmse, 2));
  }
  return text;
}

std::string renders_finding(const std::vector<RenderRecord>& renders) {
  const std::vector<RenderScene> scenes = render_scenes(renders);
  if (scenes.size() == 1) return render_finding(members_of(scenes.front(), renders));
  std::vector<std::string> winners;
  for (const RenderScene& scene : scenes) {
    winners.push_back(renders[*std::min_element(scene.members.begin(), scene.members.end(),
                                                [&](std::size_t a, std::size_t b) {
                                                  return renders[a].rmse < renders[b].rmse;
                                                })]
                          .estimator);
  }
  std::string text;
  for (const std::string& name : unique_names(winners)) {
    text += fmt::format("{}{} in {}", text.empty() ? "" : ", ", name,
                        std::count(winners.begin(), winners.end(), name));
  }
  return fmt::format("Smallest error over {}: {}", counted(scenes.size(), "scene"), text);
}

std::string map_finding(const MapRecord& map) {
  const double fraction = map.effective_fraction;
  if (!(fraction > 0.0)) return "The effective fraction is not known.";
  std::string text = fmt::format(
      "The light counts as if it came evenly from {} of the sphere (its effective fraction), ",
      percent(fraction));
  const double variance = 1.0 / fraction - 1.0;
  if (variance < 0.005) return text + "so directions drawn uniformly do as well as any.";
  text += fmt::format(
      "so directions drawn uniformly have a variance of {} \u00d7 mean\u00b2 "
      "per sample; ",
      format_number(variance, 2));
  if (fraction < 0.05) return text + "sampling the map pays off a lot.";
  return text + (fraction < 0.5 ? "sampling the map pays off." : "sampling the map gains little.");
}

}  // namespace lightproof
