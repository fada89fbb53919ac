// Processes that share the self-test all find what one alone finds.
#include <gtest/gtest.h>

#include "lightproof/image/synthetic.h"
#include "lightproof/self_test/calibration.h"
#include "lightproof/self_test/kill_matrix.h"
#include "lightproof/self_test/naming.h"
#include "lightproof/self_test/power.h"
#include "tests/core/processes.h"

namespace lightproof {
namespace {

template <class Value>
std::string bytes_of_value(const Value& value) {
  ValueWriter writer;
  writer.add(value);
  return writer.take();
}

/// The result of `measure(communicator)` at each of so many processes, and alone.
template <class Measure>
void expect_the_same_in_processes(std::initializer_list<std::size_t> numbers,
                                  const Measure& measure) {
  const std::string alone = bytes_of_value(measure(Communicator()));
  for (const std::size_t of : numbers) {
    const auto found = test::in_processes(of, [&](const Communicator& communicator) {
      return bytes_of_value(measure(communicator));
    });
    for (std::size_t index = 0; index < of; ++index) {
      EXPECT_TRUE(found[index] == alone) << "process " << index << " of " << of;
    }
  }
}

TEST(SharedSelfTest, CalibratesAsOneProcess) {
  expect_the_same_in_processes({3, 8}, [](const Communicator& communicator) {
    return calibrate({.replicates = 170, .samples = 256, .runs = 21, .run_samples = 256}, {},
                     communicator);
  });
}

TEST(SharedSelfTest, MeasuresPowerAsOneProcess) {
  expect_the_same_in_processes({3, 8}, [](const Communicator& communicator) {
    return measure_power({.replicates = 25}, {}, communicator);
  });
}

TEST(SharedSelfTest, TriesPrintedEffectsAsOneProcess) {
  expect_the_same_in_processes({3}, [](const Communicator& communicator) {
    return measure_printed_effects({.replicates = 1}, {}, communicator);
  });
}

TEST(SharedSelfTest, KillsAsOneProcess) {
  expect_the_same_in_processes({5}, [](const Communicator& communicator) {
    return measure_kills({.usual = 1U << 12U, .most = 1U << 12U}, {}, communicator);
  });
}

TEST(SharedSelfTest, NamesAsOneProcess) {
  MapRecord map;
  map.map = make_synthetic_map("sun-sky", {16, 8});
  expect_the_same_in_processes({2, 3, 5, 8}, [&](const Communicator& communicator) {
    return measure_naming({&map, 1}, {.seeds = 1, .samples = 1U << 12U}, {}, communicator);
  });
}

}  // namespace
}  // namespace lightproof
