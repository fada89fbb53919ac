#include "lightproof/history/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "lightproof/core/error.h"
#include "lightproof/history/run_values.h"

namespace lightproof {
namespace {

using Runs = std::vector<const BenchmarkRun*>;

/// Interleaved runs keep the shares of both commits that have started together; after one commit
/// as a whole they are a whole apart.
constexpr double kLargestLead = 0.5;

/// Distinct commits, the latest first.
std::vector<std::string> commits_of(std::span<const BenchmarkRun> runs) {
  std::vector<std::string> commits;
  for (std::size_t i = runs.size(); i-- > 0;) {
    const std::string& commit = runs[i].commit;
    if (std::find(commits.begin(), commits.end(), commit) == commits.end()) {
      commits.push_back(commit);
    }
  }
  return commits;
}

std::string listed(std::span<const std::string> texts) {
  constexpr std::size_t kShown = 10;
  std::string list;
  for (const std::string& text : texts.first(std::min(kShown, texts.size()))) list += " " + text;
  return texts.size() > kShown ? list + " …" : list;
}

std::string resolved(const std::vector<std::string>& commits, const std::string& given) {
  if (std::find(commits.begin(), commits.end(), given) != commits.end()) return given;
  std::vector<std::string> found;
  for (const std::string& commit : commits) {
    if (!given.empty() && commit.starts_with(given)) found.push_back(commit);
  }
  if (found.size() == 1) return found.front();
  if (found.empty()) {
    throw InputError(fmt::format("there are no runs of commit '{}'; there are of:{}", given,
                                 commits.empty() ? " none" : listed(commits)));
  }
  throw InputError(fmt::format("commit '{}' is not unique; there are:{}", given, listed(found)));
}

/// The runs of two commits in one session, the earliest first.
struct Session {
  std::string name;
  Runs base;
  Runs head;

  const BenchmarkRun& latest() const {
    return base.back()->started > head.back()->started ? *base.back() : *head.back();
  }
};

/// The sessions that hold both commits, the latest last.
std::vector<Session> sessions_of(std::span<const BenchmarkRun> runs, const std::string& base,
                                 const std::string& head) {
  std::map<std::string, Session> by_name;
  for (const BenchmarkRun& run : runs) {
    if (run.commit != base && run.commit != head) continue;
    Session& session = by_name[run.session];
    session.name = run.session;
    (run.commit == base ? session.base : session.head).push_back(&run);
  }
  std::vector<Session> sessions;
  for (auto& [name, session] : by_name) {
    if (!session.base.empty() && !session.head.empty()) sessions.push_back(std::move(session));
  }
  std::stable_sort(sessions.begin(), sessions.end(), [](const Session& a, const Session& b) {
    return a.latest().started < b.latest().started;
  });
  if (!sessions.empty()) return sessions;
  throw InputError(fmt::format(
      "no session holds runs of both {} and {}: times are compared within a session only; add the "
      "files of both with one `history add`, or with the same --session",
      base, head));
}

bool same_setting(const BenchmarkRun& a, const BenchmarkRun& b) {
  return a.machine == b.machine && a.compiler == b.compiler && a.flags == b.flags;
}

void require_one_setting(const Session& session) {
  const BenchmarkRun& first = *session.base.front();
  for (const Runs& runs : {session.base, session.head}) {
    for (const BenchmarkRun* run : runs) {
      if (same_setting(first, *run)) continue;
      throw InputError(fmt::format(
          "session {}: runs that cannot be compared: {} was measured on \"{}\" ({}; {}), {} on "
          "\"{}\" ({}; {})",
          session.name, first.commit, first.machine, first.compiler, first.flags, run->commit,
          run->machine, run->compiler, run->flags));
    }
  }
}

bool has_times(const BenchmarkRun& run) {
  return std::any_of(run.measurements.begin(), run.measurements.end(),
                     [](const Measurement& m) { return m.metric == Metric::nanoseconds; });
}

std::vector<std::int64_t> starts_of(const Runs& runs) {
  std::vector<std::int64_t> starts;
  for (const BenchmarkRun* run : runs) {
    if (has_times(*run)) starts.push_back(run->started);
  }
  return starts;
}

double share_until(const std::vector<std::int64_t>& starts, std::int64_t time) {
  const auto started =
      std::count_if(starts.begin(), starts.end(), [&](std::int64_t s) { return s <= time; });
  return static_cast<double>(started) / static_cast<double>(starts.size());
}

/// Kolmogorov's distance between the starting times. Starts in the same second are no lead.
void require_interleaved(const Session& session) {
  const std::vector<std::int64_t> base = starts_of(session.base);
  const std::vector<std::int64_t> head = starts_of(session.head);
  if (base.empty() || head.empty()) return;
  for (const auto& starts : {base, head}) {
    for (const std::int64_t time : starts) {
      if (std::abs(share_until(base, time) - share_until(head, time)) <= kLargestLead) continue;
      throw InputError(fmt::format(
          "session {}: the runs of {} and {} are not interleaved: drift of the machine would pass "
          "for a difference between them",
          session.name, session.base.front()->commit, session.head.front()->commit));
    }
  }
}

using Key = std::pair<Metric, std::string>;

std::set<Key> keys_of(const std::vector<Session>& sessions) {
  std::set<Key> keys;
  for (const Session& session : sessions) {
    for (const Runs& runs : {session.base, session.head}) {
      for (const BenchmarkRun* run : runs) {
        for (const Measurement& m : run->measurements) keys.emplace(m.metric, m.benchmark);
      }
    }
  }
  return keys;
}

std::vector<double> values_in(const Runs& runs, const Key& key) {
  std::vector<double> values;
  for (const BenchmarkRun* run : runs) {
    const auto value = run_value(*run, key.first, key.second);
    if (value) values.push_back(*value);
  }
  return values;
}

void require_enough(const Session& session, const Key& key, std::size_t base, std::size_t head,
                    const RegressionRule& rule) {
  if (is_exact(key.first) || enough_runs(base, head, rule)) return;
  throw InputError(fmt::format(
      "session {}: {} was run {} times on {} and {} times on {}: too few for a p-value of {}; {} "
      "runs of each are the least",
      session.name, key.second, base, session.base.front()->commit, head,
      session.head.front()->commit, rule.alpha, least_runs(rule)));
}

RowVerdict verdict_of(const ComparisonRow& row) {
  const Change now = row.latest->change;
  if (now == Change::faster) return RowVerdict::faster;
  const bool before = row.earlier && row.earlier->change == Change::slower;
  if (now == Change::none) return before ? RowVerdict::unconfirmed : RowVerdict::same;
  return before || is_exact(row.metric) ? RowVerdict::regressed : RowVerdict::suspected;
}

ComparisonRow row_of(const std::vector<Session>& sessions, const Key& key,
                     const RegressionRule& rule) {
  ComparisonRow row{key.second, key.first, RowVerdict::only_in_head, std::nullopt, std::nullopt};
  bool in_base = false;
  for (const Session& session : sessions) {
    const std::vector<double> base = values_in(session.base, key);
    const std::vector<double> head = values_in(session.head, key);
    in_base = in_base || !base.empty();
    if (base.empty() || head.empty()) continue;
    require_enough(session, key, base.size(), head.size(), rule);
    row.earlier = std::exchange(row.latest, judge(key.first, base, head, rule));
  }
  row.verdict = row.latest ? verdict_of(row)
                : in_base  ? RowVerdict::only_in_base
                           : RowVerdict::only_in_head;
  return row;
}

}  // namespace

const char* to_string(RowVerdict verdict) {
  switch (verdict) {
    case RowVerdict::same:
      return "same";
    case RowVerdict::regressed:
      return "regressed";
    case RowVerdict::suspected:
      return "suspected";
    case RowVerdict::unconfirmed:
      return "not confirmed";
    case RowVerdict::faster:
      return "faster";
    case RowVerdict::only_in_base:
      return "only in base";
    case RowVerdict::only_in_head:
      return "only in head";
  }
  return "";
}

Comparison compare(std::span<const BenchmarkRun> runs, const std::string& base,
                   const std::string& head, const RegressionRule& rule) {
  const std::vector<std::string> commits = commits_of(runs);
  Comparison result{resolved(commits, base), resolved(commits, head), "", "", "", rule, {}, {}};
  if (result.base == result.head) {
    throw InputError(fmt::format("'{}' and '{}' are the same commit", base, head));
  }
  std::vector<Session> sessions = sessions_of(runs, result.base, result.head);
  const BenchmarkRun setting = sessions.back().latest();
  std::erase_if(sessions,
                [&](const Session& session) { return !same_setting(session.latest(), setting); });
  for (const Session& session : sessions) {
    require_one_setting(session);
    require_interleaved(session);
    result.sessions.push_back(session.name);
  }
  result.machine = setting.machine;
  result.compiler = setting.compiler;
  result.flags = setting.flags;
  for (const Key& key : keys_of(sessions)) result.rows.push_back(row_of(sessions, key, rule));
  return result;
}

std::size_t count_of(const Comparison& comparison, RowVerdict verdict) {
  return static_cast<std::size_t>(
      std::count_if(comparison.rows.begin(), comparison.rows.end(),
                    [&](const ComparisonRow& row) { return row.verdict == verdict; }));
}

}  // namespace lightproof
