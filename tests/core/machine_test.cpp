#include "lightproof/core/machine.h"

#include <gtest/gtest.h>

#include <sstream>

namespace lightproof {
namespace {

std::string name_in(const std::string& cpuinfo) {
  std::istringstream text(cpuinfo);
  return processor_name(text);
}

TEST(ProcessorName, IsTheModelWhereThereIsOne) {
  EXPECT_EQ(name_in("processor\t: 0\nvendor_id\t: AuthenticAMD\nmodel\t\t: 17\n"
                    "model name\t: AMD EPYC 9R14\nstepping\t: 1\n"),
            "AMD EPYC 9R14");
}

// Two machines of which nothing but these numbers differ must not share what was measured.
TEST(ProcessorName, OfAnArmProcessorIsItsNumbers) {
  const std::string first =
      "processor\t: 0\nBogoMIPS\t: 243.75\nCPU implementer\t: 0x41\nCPU architecture: 8\n"
      "CPU part\t: 0xd0c\nCPU revision\t: 1\n";
  EXPECT_EQ(name_in(first), "implementer 0x41, part 0xd0c, revision 1");
  EXPECT_EQ(name_in("CPU implementer\t: 0x41\nCPU part\t: 0xd40\nCPU revision\t: 1\n"),
            "implementer 0x41, part 0xd40, revision 1");
}

TEST(ProcessorName, IsUnknownWhereTheSystemSaysNothing) {
  EXPECT_EQ(name_in(""), "unknown processor");
  EXPECT_EQ(name_in("model name\t:\nfeatures : a b\n"), "unknown processor");
}

}  // namespace
}  // namespace lightproof
