#include "lightproof/results/accuracy_reading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/results/accuracy_lines.h"

namespace lightproof {
namespace {

using testing::chart_of;
using testing::falling;
using testing::look_up;

std::vector<std::string> names_of(const std::vector<const AccuracyLine*>& lines) {
  std::vector<std::string> names;
  for (const AccuracyLine* line : lines) names.push_back(line->estimator);
  return names;
}

TEST(AccuracyReading, GoesStraightBetweenLogarithms) {
  const AccuracyLine line = falling("a", EstimatorFamily::lobes);
  const auto place = at_error(line, 1.0 / std::sqrt(8.0));
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->samples, 8.0, 1e-9);
  EXPECT_NEAR(place->seconds, 8e-6, 1e-15);
  const auto later = at_time(line, 32e-6);
  ASSERT_TRUE(later);
  EXPECT_NEAR(later->error, 1.0 / std::sqrt(32.0), 1e-12);
}

TEST(AccuracyReading, DoesNotGoBeyondWhatWasMeasured) {
  const AccuracyLine line = falling("a", EstimatorFamily::lobes);
  EXPECT_FALSE(at_error(line, 0.1));
  EXPECT_FALSE(at_time(line, 65e-6));
  EXPECT_FALSE(at_time(line, 0.9e-6));
  EXPECT_EQ(at_error(line, 3.0)->samples, 1.0);
}

TEST(AccuracyReading, StaysAtTheErrorOfALookUpHoweverLongItMayTake) {
  const AccuracyLine line = look_up("a", 1e-7, 0.08);
  EXPECT_EQ(at_time(line, 1.0)->error, 0.08);
  EXPECT_FALSE(at_error(line, 0.05));
}

TEST(AccuracyReading, TakesThePredictionWhereRareHitsWereMissed) {
  AccuracyPoint point{4, 1e-6, 0.3, 0.16, 2.0};
  EXPECT_FALSE(is_measured(point));
  EXPECT_EQ(known_error(point), 2.0);
  point.predicted = std::nan("");
  EXPECT_TRUE(std::isnan(known_error(point)));
  point.rmse_error = 0.15;
  EXPECT_TRUE(is_measured(point));
  EXPECT_EQ(known_error(point), 0.3);
}

TEST(AccuracyReading, HasTheSameEfficiencyAllAlongALine) {
  AccuracyLine line = falling("a", EstimatorFamily::lobes);
  EXPECT_NEAR(efficiency(line), 1e6, 1e-3);
  line.points.resize(2);
  EXPECT_NEAR(efficiency(line), 1e6, 1e-3);
}

TEST(AccuracyFront, LeavesOutWhatIsSlowerAndHardlyBetter) {
  const AccuracyChart chart =
      chart_of({falling("a", EstimatorFamily::lobes), falling("b", EstimatorFamily::mis, 0.95),
                look_up("c", 1e-7, 0.3)});
  std::vector<std::pair<std::string, std::uint64_t>> front;
  for (const ChartPoint& p : pareto_front(chart)) {
    front.emplace_back(p.line->estimator, p.point->samples);
  }
  EXPECT_EQ(front,
            (std::vector<std::pair<std::string, std::uint64_t>>{{"c", 1}, {"b", 16}, {"b", 64}}));
}

TEST(AccuracyFront, CountsTheShareOfTheSetUpThatIsAskedFor) {
  AccuracyLine prepared = look_up("c", 1e-7, 0.3);
  prepared.set_up_processor_seconds = 10.0;
  const AccuracyChart chart = chart_of({falling("a", EstimatorFamily::lobes), prepared});
  EXPECT_EQ(pareto_front(chart).front().line->estimator, "c");
  EXPECT_EQ(pareto_front(chart, 1e-2).front().line->estimator, "a");
  EXPECT_DOUBLE_EQ(total_seconds({&chart.lines[1], &chart.lines[1].points[0]}, 1e-2), 0.1 + 1e-7);
}

TEST(LeadingLines, AreTheFrontAndTheBestOfEveryOtherFamily) {
  const AccuracyChart chart = chart_of(
      {falling("worse", EstimatorFamily::lobes, 3.0),
       falling("better", EstimatorFamily::lobes, 2.0), falling("best", EstimatorFamily::mis),
       falling("second", EstimatorFamily::mis, 1.5), look_up("c", 1e-7, 0.3)});
  std::vector<std::string> names = names_of(leading_lines(chart));
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"best", "better", "c"}));
}

}  // namespace
}  // namespace lightproof
