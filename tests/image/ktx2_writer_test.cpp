// KTX 2.0 files, read by an independent reader: ktx-parse, which web/check_ktx2.mjs runs.
#include "lightproof/image/ktx2_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lightproof/core/child_process.h"
#include "lightproof/core/error.h"
#include "tests/image/picture_files.h"

namespace lightproof {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;

/// R, G, B and an alpha of 1 of every texel.
Json values_of(const Grid<Rgb>& face) {
  Json values = Json::array();
  for (const Rgb rgb : face.values()) {
    for (const float v : {rgb.r, rgb.g, rgb.b, 1.0F}) values.push_back(v);
  }
  return values;
}

Json expectation_of(const MapLevels& map) {
  Json levels = Json::array();
  for (const MapLevel& level : map.levels) {
    Json faces = Json::array();
    for (const Grid<Rgb>& face : level.faces) faces.push_back(values_of(face));
    levels.push_back(faces);
  }
  return {{"vkFormat", 97},
          {"width", map.extent().width},
          {"height", map.extent().height},
          {"channels", 4},
          {"primaries", 1},
          {"keys", {{"KTXorientation", "rd"}}},
          {"levels", levels}};
}

/// Every value different, and one that 16 bits hold: multiples of 1/4 below 512.
MapLevels numbered_map(Projection projection, Extent base, int levels) {
  MapLevels map = {.projection = projection, .levels = {}};
  float next = 0.0F;
  for (int i = 0; i < levels; ++i) {
    MapLevel level;
    for (int face = 0; face < info(projection).faces; ++face) {
      level.faces.emplace_back(level_extent(base, i));
      for (Rgb& rgb : level.faces.back().values()) {
        for (int c = 0; c < 3; ++c) rgb[c] = next += 0.25F;
      }
    }
    map.levels.push_back(level);
  }
  return map;
}

class Ktx2 : public testing::Test {
 protected:
  /// What ktx-parse finds other than expected; empty if it is all the same.
  std::string difference(const std::string& bytes, const Json& expected) const {
    test::write_bytes(folder_ / "a.ktx2", bytes);
    test::write_bytes(folder_ / "expected.json", expected.dump());
    try {
      run_child(NODE_PROGRAM, {CHECK_KTX2, WEB_MODULES, (folder_ / "a.ktx2").string(),
                               (folder_ / "expected.json").string()});
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(Ktx2, IsReadTexelForTexelByAnotherReader) {
  for (const auto& [size, levels] :
       std::vector<std::pair<int, int>>{{8, 4}, {8, 2}, {5, 3}, {1, 1}}) {
    const MapLevels map = numbered_map(Projection::cube, {size, size}, levels);
    EXPECT_EQ(difference(ktx2_bytes(map), expectation_of(map)), "") << size << ", " << levels;
  }
  for (const auto& [extent, levels] :
       std::vector<std::pair<Extent, int>>{{{16, 8}, 5}, {{7, 3}, 2}, {{1, 6}, 3}}) {
    const MapLevels map = numbered_map(Projection::lat_long, extent, levels);
    EXPECT_EQ(difference(ktx2_bytes(map), expectation_of(map)), "") << extent.width;
  }
}

TEST_F(Ktx2, NoticesADifferentTexel) {
  const MapLevels map = numbered_map(Projection::cube, {4, 4}, 3);
  MapLevels other = map;
  other.levels[2].faces[5](0, 0).b += 0.25F;
  EXPECT_THAT(difference(ktx2_bytes(map), expectation_of(other)), HasSubstr("level 2, value 22"));
  std::string bytes = ktx2_bytes(map);
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  EXPECT_THAT(difference(bytes, expectation_of(map)), HasSubstr("level 0, value 383"));
}

TEST_F(Ktx2, RoundsToTheNearestHalf) {
  MapLevels map = {.levels = {{std::nullopt, {Grid<Rgb>({2, 1})}}}};
  map.levels[0].faces[0](0, 0) = {0x1.002p0F, 0x1.006p0F, -0x1.0021p0F};
  map.levels[0].faces[0](1, 0) = {1e9F, 0x1p-24F, 0.1F};
  Json expected = expectation_of(map);
  // Steps of 2^-10 between 1 and 2: ties to even, then the nearest. A tenth is 1638.4 * 2^-14.
  expected["levels"] = {
      {{1.0, 0x1.008p0, -0x1.004p0, 1.0, 65504.0, 0x1p-24, 1638.0 / 16384.0, 1.0}}};
  EXPECT_EQ(difference(ktx2_bytes(map), expected), "");
}

TEST_F(Ktx2, SaysHowItWasMade) {
  MapLevels map = numbered_map(Projection::cube, {4, 4}, 2);
  map.levels[0].roughness = 0.0;
  map.levels[1].roughness = 0.7;
  map.attributes = {{"source", "Z\xc3\xbcrich sky"}, {"Method", "quadrature"}, {"a", ""}};
  Json expected = expectation_of(map);
  expected["keys"] = {{"KTXorientation", "rd"},
                      {"KTXwriter", attributes_of(map).front().value},
                      {"lightproof.Method", "quadrature"},
                      {"lightproof.a", ""},
                      {"lightproof.levels", "2"},
                      {"lightproof.projection", info(Projection::cube).description},
                      {"lightproof.roughness", "0, 0.7"},
                      {"lightproof.source", "Z\xc3\xbcrich sky"}};
  EXPECT_EQ(difference(ktx2_bytes(map), expected), "");
  EXPECT_THAT(attributes_of(map).front().value, HasSubstr("Lightproof "));
}

TEST_F(Ktx2, NamesItsPrimariesWhereTheFormatHasANumber) {
  MapLevels map = numbered_map(Projection::lat_long, {2, 1}, 1);
  const std::vector<std::pair<Chromaticities, int>> rows = {
      {{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}}, 1},
      {{{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.3290}}, 4},
      {{{0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.0770}, {0.32168, 0.33767}}, 6},
      {{{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767}}, 7},
      {{{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.3127, 0.3290}}, 10},
      {{{0.64, 0.33}, {0.21, 0.71}, {0.15, 0.06}, {0.3127, 0.3290}}, 11},
      {{{0.7, 0.3}, {0.2, 0.7}, {0.1, 0.1}, {0.3, 0.3}}, 0}};
  for (const auto& [chromaticities, number] : rows) {
    map.chromaticities = chromaticities;
    Json expected = expectation_of(map);
    expected["primaries"] = number;
    EXPECT_EQ(difference(ktx2_bytes(map), expected), "");
  }
}

TEST_F(Ktx2, HoldsABrdfMapInTwoChannels) {
  BrdfMap map = {.values = Grid<glm::vec2>({5, 3}), .attributes = {{"method", "quadrature"}}};
  Json values = Json::array();
  float next = 0.0F;
  for (glm::vec2& ab : map.values.values()) {
    next += 0.0625F;
    ab = {next, 1.0F - next};
    values.push_back(ab.x);
    values.push_back(ab.y);
  }
  const Json expected = {{"vkFormat", 83},      {"width", 5},
                         {"height", 3},         {"channels", 2},
                         {"primaries", 0},      {"keys", {{"lightproof.method", "quadrature"}}},
                         {"levels", {{values}}}};
  EXPECT_EQ(difference(ktx2_bytes(map), expected), "");
}

TEST_F(Ktx2, GivesTheSameBytesAgain) {
  const MapLevels map = numbered_map(Projection::cube, {8, 8}, 4);
  EXPECT_EQ(ktx2_bytes(map), ktx2_bytes(map));
}

}  // namespace
}  // namespace lightproof
