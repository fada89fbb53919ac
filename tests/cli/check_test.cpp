// lightproof check: dumps of samples, as the files that other programs write.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <vector>

#include "lightproof/core/random.h"
#include "tests/cli/program.h"
#include "tests/cli/schema.h"
#include "tests/dump/files.h"

namespace lightproof::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

/// Uniform directions, z, y and x of which go to `change`, with their density.
std::vector<float> uniform_samples(std::size_t count) {
  const RandomStream stream("check", 1);
  std::vector<float> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    const auto [u, v] = stream.point(i);
    const double z = 2.0 * u - 1.0;
    const double sine = std::sqrt(1.0 - z * z);
    const double phi = 2.0 * kPi * v;
    for (const double number : {sine * std::cos(phi), sine * std::sin(phi), z, 1.0 / kSphere}) {
      numbers.push_back(static_cast<float>(number));
    }
  }
  return numbers;
}

class CheckCommand : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string raw(const std::string& name, const std::vector<float>& numbers) const {
    write_bytes(path(name), bytes_of(numbers));
    return path(name);
  }
  /// Of a constant map, whose solid-angle density is that of uniform directions.
  static Finished check(const std::string& dump, Words more) {
    Words words = {"check", dump, "--map", "constant", "--size", "16x8"};
    words.insert(words.end(), more.begin(), more.end());
    return lightproof(words);
  }

 private:
  TemporaryFolder folder_;
};

constexpr std::size_t kEnough = 200'000;

TEST_F(CheckCommand, AcceptsWhatIsDrawnFromTheMap) {
  const std::string dump = raw("a.f32", uniform_samples(kEnough));
  const Finished finished =
      check(dump, {"--columns", "x,y,z,pdf", "--density", "B", "--json", path("a.json")});
  EXPECT_EQ(finished.exit_code, 0) << finished.out << finished.err;
  EXPECT_THAT(finished.out, HasSubstr("accept"));
  expect_valid("gate.schema.json", path("a.json"));
  const json gate = json_of(path("a.json"));
  EXPECT_EQ(gate.at("tests").front().at("sampler"), "a");
  EXPECT_TRUE(gate.at("recognised").empty());
}

TEST_F(CheckCommand, TakesWhatASideCarSays) {
  const std::string dump = raw("a.f32", uniform_samples(kEnough));
  std::ofstream(dump + ".json")
      << R"({"columns": ["x", "y", "z", "pdf"], "density": "B", "seed": 1})";
  EXPECT_EQ(check(dump, {}).exit_code, 0);
  // Options say it otherwise: with C the same samples lie wrongly inside the texels of the poles.
  const Finished finished = check(dump, {"--density", "C"});
  EXPECT_EQ(finished.exit_code, 1);
  EXPECT_THAT(finished.out, HasSubstr("the samples fit density B"));
}

TEST_F(CheckCommand, TakesTheLuminanceOfASideCarUnlessAnOptionSaysIt) {
  const std::string dump = raw("a.f32", uniform_samples(kEnough));
  const auto command_in_json = [&](Words more) {
    more.insert(more.end(), {"--columns", "x,y,z,pdf", "--density", "B", "--json", path("a.json")});
    EXPECT_EQ(check(dump, more).exit_code, 0);
    return json_of(path("a.json")).at("maps").at(0).at("luminance_weights").dump();
  };
  std::ofstream(dump + ".json") << R"({"luminance": "average"})";
  const std::string average = command_in_json({"--luminance", "average"});
  const std::string rec709 = command_in_json({"--luminance", "rec709"});
  EXPECT_NE(average, rec709);
  EXPECT_EQ(command_in_json({}), average);
  std::ofstream(dump + ".json") << R"({"luminance": "least"})";
  const Finished finished = check(dump, {"--columns", "x,y,z,pdf"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.err, HasSubstr("\"least\" is none of rec709"));
}

TEST_F(CheckCommand, RejectsAWrongDensityAndSaysHowToCheckAgain) {
  std::vector<float> numbers = uniform_samples(kEnough);
  for (std::size_t i = 3; i < numbers.size(); i += 4) numbers[i] *= 2.0F;
  const std::string dump = raw("a.f32", numbers);
  const Finished finished =
      check(dump, {"--columns", "x,y,z,pdf", "--density", "B", "--junit", path("a.xml")});
  EXPECT_EQ(finished.exit_code, 1);
  EXPECT_THAT(finished.out,
              AllOf(HasSubstr("pdf is the declared density"), HasSubstr("check " + dump)));
}

TEST_F(CheckCommand, IsInconclusiveWithFewSamples) {
  const std::string dump = raw("a.f32", uniform_samples(1000));
  EXPECT_EQ(check(dump, {"--columns", "x,y,z,pdf", "--density", "B"}).exit_code, 3);
}

TEST_F(CheckCommand, ReadsTheStandardInputAndText) {
  const std::vector<float> numbers = uniform_samples(kEnough);
  std::ofstream text(path("a.csv"));
  text << "x,y,z,pdf\n";
  text.precision(9);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    text << numbers[i] << (i % 4 == 3 ? '\n' : ',');
  }
  text.close();
  EXPECT_EQ(check(path("a.csv"), {"--density", "B"}).exit_code, 0);
  const std::string script =
      "\"$0\" check - --density B --map constant --size 16x8 < " + path("a.csv");
  for (const char* format : {"", " --format csv"}) {
    const Command command = {{"/bin/sh", "-c", script + format, program()}};
    EXPECT_EQ(run(command).exit_code, 0) << format;
  }
}

TEST_F(CheckCommand, RefusesWhatItCannotRead) {
  const auto refusal = [&](const std::string& dump, const Words& more) {
    const Finished finished = check(dump, more);
    EXPECT_EQ(finished.exit_code, 2) << finished.out;
    return finished.err;
  };
  const std::string dump = raw("a.f32", {1.0F, 0.0F, 0.0F, 1.0F, 1.0F});
  EXPECT_THAT(refusal(dump, {}), HasSubstr("--columns"));
  EXPECT_THAT(refusal(dump, {"--columns", "x,y,z,pdf"}), HasSubstr("ends inside row 1"));
  EXPECT_THAT(refusal(dump, {"--columns", "x,y,z,w,pdf"}), HasSubstr("no column is called \"w\""));
  EXPECT_THAT(refusal(dump, {"--columns", "x,y,z,pdf,-", "--axes", "x,y"}),
              HasSubstr("names no axes"));
  EXPECT_THAT(refusal(dump, {"--columns", "x,y,z,pdf,-", "--density", "D"}),
              HasSubstr("none of A, B, C"));
  EXPECT_THAT(refusal(dump, {"--columns", "x,y,z,pdf,-", "--measure", "cubic"}),
              HasSubstr("none of solid-angle, square"));
  EXPECT_THAT(refusal(path("nowhere.npy"), {}), HasSubstr("No such file"));
  std::ofstream(dump + ".json") << "[1]";
  EXPECT_THAT(refusal(dump, {"--columns", "x,y,z,pdf,-"}), HasSubstr("is no JSON object"));
  const std::string deep = std::string(1'000'000, '[') + std::string(1'000'000, ']');
  std::ofstream(dump + ".json") << R"({"columns": )" << deep << "}";
  EXPECT_THAT(refusal(dump, {"--columns", "x,y,z,pdf,-"}), HasSubstr("is no JSON object"));
  std::filesystem::remove(dump + ".json");
  std::filesystem::create_directory(dump + ".json");
  EXPECT_THAT(refusal(dump, {"--columns", "x,y,z,pdf,-"}), HasSubstr("is no JSON object"));
}

TEST_F(CheckCommand, JudgesDirectionsAgainstATargetWithoutAMap) {
  const std::string dump = raw("a.f32", uniform_samples(kEnough));
  const auto against = [&](const std::string& target, Words more = {}) {
    Words words = {"check", dump, "--columns", "x,y,z,pdf", "--target", target};
    words.insert(words.end(), more.begin(), more.end());
    return lightproof(words);
  };
  const Finished right = against("uniform", {"--json", path("a.json")});
  EXPECT_EQ(right.exit_code, 0) << right.out << right.err;
  expect_valid("gate.schema.json", path("a.json"));
  EXPECT_EQ(json_of(path("a.json")).at("tests").front().at("map"), "directions");
  EXPECT_EQ(against("cosine").exit_code, 1);
  EXPECT_EQ(against("uniform", {"--sequential"}).exit_code, 0);
  EXPECT_EQ(against("cosine", {"--sequential"}).exit_code, 1);
  // A picture of a density, which is the same everywhere.
  EXPECT_EQ(against("constant", {"--size", "32x16"}).exit_code, 0);
  std::ofstream(dump + ".json") << R"({"columns": ["x", "y", "z", "pdf"], "target": "uniform"})";
  EXPECT_EQ(lightproof({"check", dump}).exit_code, 0);
  // A map on the command line stands against the side-car's target.
  EXPECT_EQ(check(dump, {"--density", "B"}).exit_code, 0);
}

TEST_F(CheckCommand, TakesWhatAnOptionSaysOfTheDensityAgainstASideCar) {
  const std::string dump = raw("a.f32", uniform_samples(kEnough));
  std::ofstream(dump + ".json") << R"({"columns": ["x", "y", "z", "pdf"], "density": "C"})";
  const Finished none = check(dump, {"--target", "none"});
  EXPECT_EQ(none.exit_code, 0) << none.out << none.err;
  const Finished uniform = lightproof({"check", dump, "--target", "uniform"});
  EXPECT_EQ(uniform.exit_code, 0) << uniform.out << uniform.err;
  std::ofstream(dump + ".json") << R"({"columns": ["x", "y", "z", "pdf"], "target": "none"})";
  const Finished declared = check(dump, {"--density", "B"});
  EXPECT_EQ(declared.exit_code, 0) << declared.out << declared.err;
  EXPECT_THAT(declared.out, testing::Not(HasSubstr("solid angle by 1/pdf")));
}

TEST_F(CheckCommand, JudgesTheGivenPdfOfASamplerWhoseDensityIsItsOwnAffair) {
  std::vector<float> numbers = uniform_samples(kEnough);
  const Words none = {"--columns", "x,y,z,pdf", "--target", "none"};
  Words with_json = none;
  with_json.insert(with_json.end(), {"--json", path("a.json")});
  const Finished right = check(raw("a.f32", numbers), with_json);
  EXPECT_EQ(right.exit_code, 0) << right.out << right.err;
  expect_valid("gate.schema.json", path("a.json"));
  for (std::size_t i = 3; i < numbers.size(); i += 4) numbers[i] *= 1.1F;
  const Finished wrong = check(raw("b.f32", numbers), none);
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_THAT(wrong.out, HasSubstr("pdf-too-large"));
}

TEST_F(CheckCommand, JudgesWeights) {
  const std::vector<float> numbers = uniform_samples(kEnough);
  const auto with_weights = [&](float factor) {
    std::vector<float> rows;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      // The map's radiance is 1.
      rows.push_back(i % 4 == 3 ? factor / numbers[i] : numbers[i]);
    }
    return raw("w.f32", rows);
  };
  const Words words = {"--columns", "x,y,z,weight", "--density", "B"};
  const Finished right = check(with_weights(1.0F), words);
  EXPECT_EQ(right.exit_code, 0) << right.out << right.err;
  const Finished wrong = check(with_weights(1.1F), words);
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_THAT(wrong.out, HasSubstr("light by the given weights"));
}

TEST_F(CheckCommand, JudgesDensitiesOnAGrid) {
  const std::string dump = raw("a.f32", uniform_samples(kEnough));
  const auto with_grid = [&](double density) {
    std::ofstream text(path("grid.csv"));
    text << "s,t,pdf\n";
    text.precision(9);
    for (int row = 0; row < 8; ++row) {
      for (int column = 0; column < 16; ++column) {
        text << (column + 0.5) / 16 << ',' << (row + 0.5) / 8 << ',' << density << '\n';
      }
    }
    text.close();
    return check(dump, {"--columns", "x,y,z,pdf", "--density", "B", "--densities", path("grid.csv"),
                        "--json", path("a.json")});
  };
  const Finished right = with_grid(1.0 / kSphere);
  EXPECT_EQ(right.exit_code, 0) << right.out << right.err;
  expect_valid("gate.schema.json", path("a.json"));
  const Finished wrong = with_grid(1.02 / kSphere);
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_THAT(wrong.out, AllOf(HasSubstr("pdf of a grid of directions"),
                               HasSubstr("pdf of a grid integrates to 1")));
  expect_valid("gate.schema.json", path("a.json"));
}

TEST_F(CheckCommand, HoldsDensitiesOnAGridAgainstTheSamplesWhereNoneIsDeclared) {
  const std::string dump = raw("a.f32", uniform_samples(kEnough));
  const auto with_grid = [&](double of_upper, double of_lower) {
    std::ofstream text(path("grid.csv"));
    text << "s,t,pdf\n";
    text.precision(9);
    for (int row = 0; row < 16; ++row) {
      for (int column = 0; column < 32; ++column) {
        text << (column + 0.5) / 32 << ',' << (row + 0.5) / 16 << ','
             << (row < 8 ? of_lower : of_upper) / kSphere << '\n';
      }
    }
    text.close();
    return check(dump, {"--columns", "x,y,z,pdf", "--target", "none", "--densities",
                        path("grid.csv"), "--json", path("a.json")});
  };
  const Finished right = with_grid(1.0, 1.0);
  EXPECT_EQ(right.exit_code, 0) << right.out << right.err;
  expect_valid("gate.schema.json", path("a.json"));
  // It integrates to 1.
  const Finished wrong = with_grid(1.5, 0.5);
  EXPECT_EQ(wrong.exit_code, 1) << wrong.out;
  EXPECT_THAT(wrong.out, AllOf(HasSubstr("bins of the pdf of a grid"),
                               testing::Not(HasSubstr("pdf of a grid integrates to 1"))));
  expect_valid("gate.schema.json", path("a.json"));
}

TEST_F(CheckCommand, NamesTheFileOfDensitiesThatItRefuses) {
  const std::string dump = raw("a.f32", uniform_samples(16));
  const auto refusal = [&](const std::string& name, std::string_view bytes) {
    write_bytes(path(name), bytes);
    const Finished finished =
        check(dump, {"--columns", "x,y,z,pdf", "--density", "B", "--densities", path(name)});
    EXPECT_EQ(finished.exit_code, 2) << finished.out;
    return finished.err;
  };
  EXPECT_THAT(refusal("raw.f32", bytes_of(std::vector<float>{0.5F, 0.5F, 0.08F})),
              AllOf(HasSubstr("raw.f32: "), HasSubstr("densities are taken from an .npy file")));
  EXPECT_THAT(refusal("two.csv", "0.5,0.5\n"),
              AllOf(HasSubstr("two.csv: "), HasSubstr("three numbers are s,t,pdf")));
  EXPECT_THAT(refusal("named.csv", "s,t,p\n0.5,0.5,0.08\n"),
              AllOf(HasSubstr("named.csv: "), HasSubstr("no column is called \"p\"")));
  EXPECT_THAT(refusal("none.csv", "s,t\n0.5,0.5\n"),
              AllOf(HasSubstr("none.csv: "), HasSubstr("needs a column pdf")));
  write_bytes(path("narrow.csv"), "1,2\n");
  EXPECT_THAT(check(path("narrow.csv"), {}).err,
              AllOf(HasSubstr("narrow.csv: "), HasSubstr("are no directions")));
}

TEST_F(CheckCommand, TakesTheLargestChannelAsLuminance) {
  const std::string dump = raw("a.f32", uniform_samples(kEnough));
  // A grey map: it is the same by any luminance.
  EXPECT_EQ(
      check(dump, {"--columns", "x,y,z,pdf", "--density", "B", "--luminance", "max"}).exit_code, 0);
  EXPECT_EQ(lightproof({"gate", "constant", "--luminance", "max"}).exit_code, 2);
}

TEST_F(CheckCommand, RefusesWhatDoesNotGoTogether) {
  const std::string dump = raw("a.f32", uniform_samples(16));
  const auto refusal = [&](Words more) {
    Words words = {"check", dump};
    words.insert(words.end(), more.begin(), more.end());
    const Finished finished = lightproof(words);
    EXPECT_EQ(finished.exit_code, 2) << finished.out;
    return finished.err;
  };
  EXPECT_THAT(refusal({"--columns", "x,y,z,pdf"}), HasSubstr("--target a distribution"));
  EXPECT_THAT(refusal({"--columns", "x,y,z,pdf", "--target", "cosin"}),
              HasSubstr("did you mean 'cosine'?"));
  EXPECT_THAT(refusal({"--columns", "x,y,z,pdf", "--target", "phong"}),
              HasSubstr("its parameter is missing"));
  EXPECT_THAT(refusal({"--columns", "x,y,z,pdf", "--target", "cosine", "--map", "constant"}),
              HasSubstr("needs no map"));
  EXPECT_THAT(refusal({"--columns", "x,y,z,pdf", "--target", "cosine", "--density", "B"}),
              HasSubstr("--density belongs to --map"));
  EXPECT_THAT(refusal({"--columns", "x,y,z,-", "--target", "none", "--map", "constant"}),
              HasSubstr("a column pdf is needed"));
  EXPECT_THAT(refusal({"--columns", "x,y,z,pdf", "--target", "none"}), HasSubstr("--map"));
  EXPECT_THAT(
      refusal({"--columns", "x,y,z,pdf", "--target", "none", "--map", "constant", "--sequential"}),
      HasSubstr("--sequential"));
  EXPECT_THAT(refusal({"--columns", "x,y,z,weight", "--target", "cosine"}),
              HasSubstr("weights are held against the light of a map"));
  EXPECT_THAT(refusal({"--columns", "x,y,z,wr", "--map", "constant"}), HasSubstr("three channels"));
}

}  // namespace
}  // namespace lightproof::test
