#include "lightproof/report/csv.h"

#include <optional>

#include "lightproof/report/csv_row.h"
#include "lightproof/report/findings.h"
#include "lightproof/report/names.h"

namespace lightproof {
namespace {

using csv_parts::field;
using csv_parts::row;

template <class Record, class Value>
std::optional<Value> member(const std::optional<Record>& record, Value Record::*value) {
  if (!record) return std::nullopt;
  return (*record).*value;
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : "; ") + text;
  return all;
}

/// None where it has no meaning.
std::optional<double> dof_of(const TestRecord& test) {
  return test.dof > 0.0 ? std::optional(test.dof) : std::nullopt;
}

}  // namespace

std::string gate_csv(const GateResult& gate) {
  std::string csv =
      "sampler,density,map,oracle,test,samples,statistic,dof,log10_p,effect,"
      "minimum_detectable_effect,outcome,known_defect,detail\n";
  for (const TestRecord& t : gate.tests) {
    csv += row(t.sampler, t.density_space, t.map, to_string(describe(t.test).oracle),
               describe(t.test).name, t.samples, t.statistic, dof_of(t), t.log10_p, t.effect,
               t.minimum_detectable_effect, to_string(t.outcome), t.known_defect ? "yes" : "no",
               t.detail);
  }
  for (const LeftOut& l : gate.left_out) {
    csv += row(l.sampler, l.density_space, l.map, "", "", "", "", "", "", "", "",
               to_string(Outcome::not_run), "", "left out: " + l.reason);
  }
  return csv;
}

std::string mutants_csv(const std::vector<KillRecord>& mutants) {
  std::string csv = "mutant,oracle,test,samples,looks_like\n";
  for (const KillRecord& m : mutants) {
    for (const auto& [test, samples] : m.kills) {
      csv += row(m.mutant, to_string(m.oracle), full_name(test), samples, m.looks_like);
    }
    if (m.sequential) {
      csv += row(m.mutant, to_string(m.oracle), "sequential gate", *m.sequential, m.looks_like);
    }
  }
  return csv;
}

std::string convergence_csv(const std::vector<ConvergenceRecord>& records) {
  std::string csv =
      "map,receiver,material,estimator,pixels,replicates,samples,rmse,rmse_error,predicted\n";
  for (const ConvergenceRecord& r : records) {
    for (const ConvergencePoint& p : r.points) {
      csv += row(r.map, r.receiver, r.material, r.estimator, r.pixels, r.replicates, p.samples,
                 p.rmse, p.rmse_error, p.predicted);
    }
  }
  return csv;
}

std::string variance_csv(const std::vector<ConvergenceRecord>& records) {
  std::string csv =
      "map,receiver,material,estimator,measured_variance,predicted_variance,ratio,ratio_error,"
      "slope,slope_error\n";
  for (const ConvergenceRecord& r : records) {
    csv += row(r.map, r.receiver, r.material, r.estimator, r.measured_variance,
               r.predicted_variance, r.measured_variance / r.predicted_variance,
               r.variance_ratio_error, r.slope, r.slope_error);
  }
  return csv;
}

std::string throughput_csv(const std::vector<ThroughputRecord>& records) {
  std::string csv =
      "sampler,map,width,height,ns_per_sample,ns_low,ns_high,table_bytes,build_ms,"
      "wall_per_cpu\n";
  for (const ThroughputRecord& r : records) {
    csv += row(r.sampler, r.map, r.extent.width, r.extent.height, r.ns_per_sample, r.ns_low,
               r.ns_high, r.table_bytes, r.build_ms, r.wall_per_cpu);
  }
  return csv;
}

std::string growth_csv(const std::vector<GrowthFit>& growth) {
  std::string csv =
      "sampler,steps,exponent,exponent_error,build_exponent,build_exponent_error,leaves_l2,"
      "leaves_l3,exponent_before,breakpoints,exponents_after,breakpoints_p\n";
  for (const GrowthFit& fit : growth) {
    std::vector<std::string> sizes;
    std::vector<std::string> exponents;
    for (const GrowthBreakpoint& breakpoint :
         fit.segmented.value_or(SegmentedGrowth{}).breakpoints) {
      sizes.push_back(field(breakpoint.extent));
      exponents.push_back(field(breakpoint.exponent_after));
    }
    csv += row(fit.sampler, fit.model, fit.exponent, fit.exponent_error,
               member(fit.build_exponent, &FittedExponent::value),
               member(fit.build_exponent, &FittedExponent::error), fit.leaves_l2, fit.leaves_l3,
               member(fit.segmented, &SegmentedGrowth::exponent_before), joined(sizes),
               joined(exponents), member(fit.segmented, &SegmentedGrowth::p_value));
  }
  return csv;
}

std::string build_csv(const std::vector<ThroughputRecord>& records) {
  std::string csv = "sampler,map,width,height,build_ms\n";
  for (const ThroughputRecord& r : records) {
    csv += row(r.sampler, r.map, r.extent.width, r.extent.height, r.build_ms);
  }
  return csv;
}

std::string tables_csv(const std::vector<TableRecord>& records) {
  std::string csv =
      "sampler,map,width,height,ns_per_sample,bytes_per_texel,worst_texel_error,times_baseline,"
      "share_of_limit,wall_per_cpu\n";
  for (const TableRecord& r : records) {
    csv +=
        row(r.sampler, r.map, r.extent.width, r.extent.height, r.ns_per_sample, r.bytes_per_texel,
            r.worst_texel_error, r.times_baseline, r.share_of_limit, r.wall_per_cpu);
  }
  return csv;
}

std::string directions_csv(const std::vector<DirectionRecord>& records) {
  std::string csv =
      "sampler,map,width,height,density,order,ns_per_sample,times_baseline,share_of_limit,"
      "wall_per_cpu\n";
  for (const DirectionRecord& r : records) {
    csv += row(r.sampler, r.map, r.extent.width, r.extent.height, r.density, describe(r.order).name,
               r.ns_per_sample, r.times_baseline, r.share_of_limit, r.wall_per_cpu);
  }
  return csv;
}

std::string renders_csv(const std::vector<RenderRecord>& records) {
  std::string csv =
      "map,receiver,material,estimator,samples,width,height,rmse,seconds,point_seconds,picture\n";
  const std::vector<std::string> stems = render_stems(records);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const RenderRecord& r = records[i];
    csv += row(r.map, r.receiver, r.material, r.estimator, r.samples, r.picture.extent().width,
               r.picture.extent().height, r.rmse, r.seconds, r.point_seconds, stems[i] + ".exr");
  }
  return csv;
}

std::string maps_csv(const std::vector<MapRecord>& records) {
  std::string csv =
      "map,source,width,height,mapping,own_width,own_height,mean_luminance,peak_ratio,"
      "effective_fraction,notes\n";
  for (const MapRecord& r : records) {
    const Extent extent = r.map.radiance.extent();
    csv += row(r.map.name, r.source, extent.width, extent.height, describe(r.own_mapping),
               r.own_texels.width, r.own_texels.height, r.mean_luminance, r.peak_ratio,
               r.effective_fraction, joined(r.map.notes));
  }
  return csv;
}

std::string split_sum_csv(const std::vector<SplitSumRecord>& records) {
  std::string csv = "map,normal_reflectance,roughness,view_degrees,rmse,left_out\n";
  for (const SplitSumRecord& r : records) {
    csv += row(r.map, r.normal_reflectance, r.roughness, view_degrees(r), r.rmse, r.left_out);
  }
  return csv;
}

std::string published_csv(const std::vector<PublishedComparison>& comparisons) {
  std::string csv = "system,quantity,exact,published,corrected\n";
  for (const PublishedComparison& c : comparisons) {
    csv += row(c.system, c.what, c.exact, c.published, c.corrected);
  }
  return csv;
}

}  // namespace lightproof
