#include "lightproof/dump/sample_dump.h"

#include <gmock/gmock.h>

#include <cmath>

#include "lightproof/core/error.h"
#include "lightproof/warp/lat_long.h"
#include "tests/dump/files.h"

namespace lightproof {
namespace {

class SampleDumpFile : public testing::Test {
 protected:
  SampleDump dump(const std::vector<double>& numbers, const std::vector<std::string>& columns,
                  SampleConvention convention = {}) {
    test::write_bytes(folder_ / "a.f64", test::bytes_of(numbers));
    return {NumberTable((folder_ / "a.f64").string(), std::nullopt, columns.size()),
            sample_columns(columns), convention};
  }
  static DumpedSample first_of(const SampleDump& dump) {
    std::vector<DumpedSample> samples(1);
    dump.read(0, samples);
    return samples.front();
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(SampleDumpFile, OfDirectionsHasThemInOurAxes) {
  SampleConvention convention;
  convention.axes = AxisMap::parse("z,x,y");
  const DumpedSample sample =
      first_of(dump({0.48, -0.6, 0.64, 2.5}, {"x", "y", "z", "pdf"}, convention));
  EXPECT_NEAR(sample.direction.x, 0.64, 1e-15);
  EXPECT_NEAR(sample.direction.y, 0.48, 1e-15);
  EXPECT_NEAR(sample.direction.z, -0.6, 1e-15);
  EXPECT_EQ(sample.pdf.value, 2.5);
}

TEST_F(SampleDumpFile, OfImageCoordinatesHasTheDirectionsOfThePreset) {
  SampleConvention convention;
  for (const PresetInfo& preset : presets()) {
    convention.preset = preset.preset;
    const Direction expected = direction_from_image(preset.preset, {0.3, 0.6});
    for (const auto& [names, t] : {std::pair(std::vector<std::string>{"s", "t"}, 0.6),
                                   std::pair(std::vector<std::string>{"u", "v"}, 0.4)}) {
      const Direction found = first_of(dump({0.3, t}, names, convention)).direction;
      EXPECT_NEAR(glm::distance(found, expected), 0.0, 1e-12) << preset.name;
    }
  }
}

TEST_F(SampleDumpFile, OfImageCoordinatesMayBeTurnedToo) {
  SampleConvention convention;
  convention.axes = AxisMap::parse("x,-z,y");
  convention.measure = DensityMeasure::square;
  const DumpedSample sample = first_of(dump({0.3, 0.6, 1.5}, {"s", "t", "pdf"}, convention));
  EXPECT_EQ(sample.direction, convention.axes(direction_from_image(Preset::z_up, {0.3, 0.6})));
  // The area of the image there is that of its own row, wherever the direction is turned to.
  EXPECT_NEAR(sample.pdf.value, 1.5 / solid_angle_per_square(0.6), 1e-12);
}

TEST_F(SampleDumpFile, WithDensitiesOverTheImageHasThemPerSteradian) {
  SampleConvention convention;
  convention.measure = DensityMeasure::square;
  const DumpedSample sample = first_of(dump({0.3, 0.6, 1.5}, {"s", "t", "pdf"}, convention));
  EXPECT_NEAR(sample.pdf.value, 1.5 / solid_angle_per_square(0.6), 1e-12);
  convention.preset = Preset::pbrt_v4;
  EXPECT_NEAR(first_of(dump({0.3, 0.6, 1.5}, {"s", "t", "pdf"}, convention)).pdf.value,
              1.5 / kSphere, 1e-12);
}

TEST_F(SampleDumpFile, SaysOfWhatIsNoDirectionThatItIsNoNumber) {
  for (const std::vector<double>& row :
       {std::vector<double>{0.5, 0.0, 0.0}, {1.0, 1.0, 0.0}, {NAN, 0.0, 1.0}, {0.0, 0.0, 0.0}}) {
    EXPECT_TRUE(std::isnan(first_of(dump(row, {"x", "y", "z"})).direction.x));
  }
  EXPECT_TRUE(std::isnan(first_of(dump({1.1, 0.5}, {"s", "t"})).direction.x));
  EXPECT_TRUE(std::isnan(first_of(dump({0.0, 0.0, 1.0}, {"x", "y", "z"})).pdf.value));
}

TEST_F(SampleDumpFile, NeedsAsManyColumnsAsTheTableHas) {
  test::write_bytes("columns.f64", test::bytes_of(std::vector<double>{1, 2, 3}));
  EXPECT_THROW(SampleDump(NumberTable("columns.f64", std::nullopt, 3),
                          sample_columns(std::vector<std::string>{"s", "t"}), {}),
               InputError);
  std::filesystem::remove("columns.f64");
}

}  // namespace
}  // namespace lightproof
