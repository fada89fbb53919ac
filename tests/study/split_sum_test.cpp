#include "lightproof/study/split_sum.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "lightproof/core/measure.h"
#include "lightproof/core/parallel.h"
#include "lightproof/image/synthetic.h"

namespace lightproof {
namespace {

SplitSumOptions few() {
  SplitSumOptions options;
  options.roughness = {0.4, 0.8};
  options.view_angles = {0.0, 60.0 * kPi / 180.0};
  return options;
}

std::vector<EnvironmentMap> two_maps() {
  return {make_synthetic_map("constant", {64, 32}), make_synthetic_map("checker", {64, 32})};
}

void expect_same_bits(const std::vector<SplitSumRecord>& a, const std::vector<SplitSumRecord>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].map, b[i].map);
    EXPECT_EQ(a[i].rmse, b[i].rmse);
    EXPECT_EQ(a[i].left_out, b[i].left_out);
  }
}

TEST(SplitSumStudy, HasARecordOfEveryCase) {
  const std::vector<EnvironmentMap> maps = two_maps();
  const std::vector<SplitSumRecord> records = study_split_sum(maps, few());
  ASSERT_EQ(records.size(), 2U * 2U * 2U * 2U);
  EXPECT_EQ(records.front().map, "constant");
  EXPECT_EQ(records.back().map, "checker");
  EXPECT_EQ(records.back().roughness, 0.8);
  EXPECT_EQ(records.back().normal_reflectance, 1.0);
  for (const SplitSumRecord& r : records) {
    if (r.map == "constant") {
      EXPECT_LT(r.rmse, 1e-6);
    } else {
      EXPECT_GT(r.rmse, 1e-6);
    }
  }
}

TEST(SplitSumStudy, IsTheSameForAnyNumberOfThreads) {
  const std::vector<EnvironmentMap> maps = two_maps();
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return study_split_sum(maps, few());
  };
  expect_same_bits(with(1), with(3));
}

/// Two processes, as threads that wait for each other.
class Exchange {
 public:
  std::vector<std::string> gather(std::size_t rank, std::string bytes) {
    std::unique_lock lock(mutex_);
    const std::size_t round = round_;
    given_[rank] = std::move(bytes);
    if (++arrived_ == 2) {
      arrived_ = 0;
      ++round_;
      all_ = {given_[0], given_[1]};
      both_.notify_all();
    } else {
      both_.wait(lock, [&] { return round_ != round; });
    }
    return all_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable both_;
  std::array<std::string, 2> given_;
  std::vector<std::string> all_;
  std::size_t arrived_ = 0;
  std::size_t round_ = 0;
};

TEST(SplitSumStudy, IsTheSameWhereTwoProcessesShareIt) {
  const std::vector<EnvironmentMap> maps = two_maps();
  const std::vector<SplitSumRecord> alone = study_split_sum(maps, few());
  Exchange exchange;
  std::array<std::vector<SplitSumRecord>, 2> shared;
  std::vector<std::thread> processes;
  for (std::size_t rank = 0; rank < 2; ++rank) {
    processes.emplace_back([&, rank] {
      shared[rank] =
          study_split_sum(maps, few(), {}, {{rank, 2}, [&, rank](std::string bytes) {
                                              return exchange.gather(rank, std::move(bytes));
                                            }});
    });
  }
  for (std::thread& process : processes) process.join();
  expect_same_bits(shared[0], alone);
  expect_same_bits(shared[1], alone);
}

TEST(SplitSumStudy, RefusesTwoMapsOfOneName) {
  const std::vector<EnvironmentMap> maps = {make_synthetic_map("checker", {8, 4}),
                                            make_synthetic_map("checker", {16, 8})};
  EXPECT_THROW(study_split_sum(maps, few()), std::logic_error);
}

TEST(SplitSumStudy, OfNoMapIsEmpty) { EXPECT_TRUE(study_split_sum({}, few()).empty()); }

}  // namespace
}  // namespace lightproof
