// What the targets begin with: small files of every kind, in a folder for each target.
#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightproof/core/kept_measurement.h"
#include "lightproof/core/serialise.h"
#include "lightproof/image/decoder_messages.h"
#include "lightproof/image/stored_picture.h"
#include "lightproof/plugin/plugin_messages.h"
#include "lightproof/results/recommendation_survey.h"
#include "tests/dump/files.h"
#include "tests/image/picture_files.h"

namespace lightproof {
namespace {

namespace fs = std::filesystem;

/// The seeds of one target.
class Seeds {
 public:
  Seeds(const fs::path& root, std::string_view target) : folder_(root / target) {
    fs::create_directories(folder_);
  }
  fs::path path(std::string_view name) const { return folder_ / name; }
  void add(std::string_view name, std::string_view bytes) const {
    test::write_bytes(path(name), bytes);
  }

 private:
  fs::path folder_;
};

constexpr Extent kSize = {16, 8};

void write_exr_pictures(const Seeds& seeds) {
  const Grid<Rgb> picture = test::numbered_picture(kSize);
  for (std::size_t i = 0; i < test::kExrCompressions.size(); ++i) {
    const std::string_view name = test::kExrCompressions[i];
    test::write_compressed_exr(seeds.path(fmt::format("{}.exr", name)), picture, i, i % 2 == 0);
    test::write_compressed_exr(seeds.path(fmt::format("{}-tiles.exr", name)), picture, i,
                               i % 2 == 1, 8);
  }
  test::write_exr_file(seeds.path("window.exr"), picture,
                       {.channels = {"A", "R", "G", "B"},
                        .envmap = test::Envmap::lat_long,
                        .origin_x = 3,
                        .origin_y = -2,
                        .missing_columns = 2,
                        .chromaticities = {{0.7F, 0.3F, 0.2F, 0.7F, 0.1F, 0.05F, 0.31F, 0.33F}},
                        .pixel_aspect = 2.0F});
  test::write_exr_file(seeds.path("tiles-of-lines.exr"), picture, {.tiles_of_lines = 0});
  test::write_exr_file(seeds.path("xyz.exr"), picture, {.bottom_row_first = true, .xyz = true});
  test::write_exr_file(seeds.path("grey.exr"), picture, {.channels = {"Y"}});
  test::write_exr_file(seeds.path("layers.exr"), picture,
                       {.channels = {"sky.R", "sky.G", "sky.B", "Z"}});
  test::write_uint_exr(seeds.path("uint.exr"), kSize);
  test::write_two_part_exr(seeds.path("parts.exr"), picture, picture);
  test::write_deep_exr(seeds.path("deep.exr"), kSize);
  test::write_luminance_chroma_exr(seeds.path("yc.exr"), kSize);
  // With a white point that is no colour.
  test::write_exr_file(seeds.path("yc-white.exr"), picture,
                       {.channels = {"BY", "RY", "Y"},
                        .chromaticities = {{0.64F, 0.33F, 0.3F, 0.6F, 0.15F, 0.06F, 0.31F, 0.0F}}});
}

void write_hdr_pictures(const Seeds& seeds) {
  const std::vector<test::Rgbe> pixels(kSize.count(), {200, 100, 50, 129});
  test::write_hdr_file(seeds.path("plain.hdr"), "-Y 8 +X 16", pixels);
  test::write_hdr_file(seeds.path("turned.hdr"), "+X 16 -Y 8", pixels,
                       "EXPOSURE=2\nCOLORCORR=1 2 1\nPIXASPECT=1\nGAMMA=1\nVIEW=-vtl\n"
                       "PRIMARIES=.64 .33 .3 .6 .15 .06 .3127 .329\n");
  // Planes of runs and of bytes, and the older coding of repeats.
  std::string planes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 16\n";
  std::string repeats = "#?RGBE\nFORMAT=32-bit_rle_xyze\n\n-Y 2 +X 16\n";
  for (int line = 0; line < 2; ++line) {
    planes += std::string("\x02\x02\x00\x10", 4);
    for (int plane = 0; plane < 4; ++plane)
      planes +=
          "\x90\x81\x08"
          "abcdefgh\x88\x40";
    repeats += std::string("\xc0\x40\x20\x80\x01\x01\x01\x0f", 8);
  }
  // Of 16 bytes a plane: a run of 16 alone.
  std::string runs = "#?RADIANCE\n\n-Y 2 +X 16\n";
  for (int line = 0; line < 2; ++line) {
    runs += std::string("\x02\x02\x00\x10", 4) +
            "\x90\x81\x90\x82\x08"
            "abcdefgh\x88\x40\x90\x80";
  }
  seeds.add("planes.hdr", planes);
  seeds.add("repeats.hdr", repeats);
  seeds.add("runs.hdr", runs);
}

/// PNG and JPEG.
void write_integer_pictures(const Seeds& seeds) {
  std::vector<unsigned> values;
  for (std::size_t i = 0; i < 4 * kSize.count(); ++i) {
    values.push_back(static_cast<unsigned>(i * i % 251));
  }
  for (const int bits : {8, 16}) {
    for (const int channels : {1, 3, 4}) {
      const fs::path file = seeds.path(fmt::format("{}-{}.png", channels, bits));
      test::write_integer_picture(file, kSize, channels, values, bits);
    }
  }
  for (const int channels : {1, 3}) {
    test::write_integer_picture(seeds.path(fmt::format("{}.jpg", channels)), kSize, channels,
                                values, 8, channels);
  }
  test::write_png_with_gamma(seeds.path("gamma.png"), kSize, values, 0.4545);
}

void write_pictures(const Seeds& seeds) {
  write_exr_pictures(seeds);
  write_hdr_pictures(seeds);
  write_integer_pictures(seeds);
}

template <class Value>
std::string bytes_of(const Value& value) {
  ValueWriter writer;
  writer.add(value);
  return writer.take();
}

std::string message(MessageKind kind, std::string_view bytes) {
  const MessageHead head = {.kind = kind, .bytes = bytes.size()};
  return std::string(reinterpret_cast<const char*>(&head), sizeof head) + std::string(bytes);
}

StoredPicture some_picture() {
  StoredPicture stored;
  stored.data = {.width = 4, .height = 2};
  stored.display = stored.data;
  for (const char* name : {"R", "G", "B"}) stored.channels.push_back({.name = name});
  stored.compression = "zip";
  return stored;
}

void write_answers(const Seeds& seeds) {
  const std::string choices(8, '\0');
  const std::string rows = test::bytes_of(std::vector<float>(4 * 2 * 3, 0.5F));
  const std::string done = message(MessageKind::done, bytes_of(std::vector<std::string>{"a note"}));
  StoredPicture stored = some_picture();
  const auto add = [&](std::string_view name, std::string_view samples) {
    seeds.add(name, choices + message(MessageKind::picture, bytes_of(stored)) +
                        message(MessageKind::rows, samples) + done);
  };
  add("plain", rows);
  stored.order = {.columns = true, .lines_backwards = true, .pixels_backwards = true};
  stored.order_text = "+X 4 +Y 2";
  stored.compression.clear();
  add("turned", rows);
  stored = some_picture();
  for (StoredChannel& channel : stored.channels) channel.type = SampleType::uint8;
  stored.gamma = 2.2;
  stored.exif_orientation = 3;
  stored.profile = "a profile";
  add("integers", test::bytes_of(std::vector<float>(4 * 2 * 3, 200.0F)));
  stored = some_picture();
  stored.display = {.x = -1, .y = 0, .width = 4, .height = 2};
  stored.tile_width = stored.tile_height = 16;
  stored.holds_xyz = true;
  stored.parts = {"one", "two"};
  stored.chromaticities = kRec709Space;
  add("window", rows);
  seeds.add("failed",
            choices + message(MessageKind::failed, bytes_of(DecoderFailure{.reason = "a reason"})));
}

/// Of plug-ins that describe themselves, and are done with whatever they are asked, or fail.
void write_plugin_answers(const Seeds& seeds) {
  const auto reply = [](PluginStatus status, std::string_view text) {
    const PluginReply head = {
        .status = status, .cpu_seconds = 1e-6, .wall_seconds = 2e-6, .text_bytes = text.size()};
    return std::string(reinterpret_cast<const char*>(&head), sizeof head) + std::string(text);
  };
  const auto add = [&](std::string_view name, const PluginDescription& description, char end,
                       char after, std::string_view then) {
    // A map, a number of points, timed; how it ends, what follows the answers; four numbers in
    // steps of one, which make a unit vector and a density; a word.
    std::string bytes = std::string("\0\x10\0", 3) + end;
    bytes += after;
    bytes += std::string("\4\4\5\0\6\0\3", 7) + "ok.";
    seeds.add(name, bytes + reply(PluginStatus::done, bytes_of(description)) + std::string(then));
  };
  const PluginDescription whole = {.name = "mine", .has_sample = true, .has_pdf = true};
  PluginDescription picture = whole;
  picture.columns = "u,v,pdf";
  picture.preset = "exr-area";
  picture.measure = "square";
  picture.density = "A";
  picture.luminance = "average";
  picture.rounding = 1e-4;
  PluginDescription in_order = {.columns = "x,y,z", .axes = "x,-z,y", .has_draw = true};
  const std::string done = reply(PluginStatus::done, "");
  add("whole", whole, 6, 0, done);
  add("picture", picture, 6, 0, done);
  add("in-order", in_order, 6, 0, done + done);
  add("crash", whole, 0, 1, done);
  add("silent", whole, 1, 2, done + done);
  add("failed", whole, 6, 0, done + reply(PluginStatus::failed, "a reason"));
  add("refused", picture, 4, 0, reply(PluginStatus::failed, "returned no sampler: a reason"));
}

void write_kept(const Seeds& seeds) {
  const auto add = [&](std::string_view name, char kind, std::string_view bytes) {
    seeds.add(name, std::string(1, kind) + std::string(bytes));
  };
  add("picture", 1, bytes_of(some_picture()));
  add("encode", 2,
      bytes_of(
          EncodeRequest{.version = "0", .channels = {"R"}, .levels = {{.width = 4, .height = 2}}}));
  add("read", 3, bytes_of(ReadRequest{.channels = {"R", "G", "B"}}));
  add("failure", 4, bytes_of(DecoderFailure{.reason = "a reason"}));
  add("survey", 5, bytes_of(KeptMeasurement<RecommendationSurvey>{"today", {}}));
  add("list", 6, bytes_of(std::vector<std::optional<std::vector<bool>>>{std::vector{true}, {}}));
  add("file", 0, std::string(8, '\1'));
}

constexpr std::string_view kBenchmark = R"({"context": {"date": "2026-01-31T13:00:00+01:00",
 "host_name": "h", "num_cpus": 4, "machine": "m", "compiler": "c", "flags": "f", "commit": "abc",
 "caches": [{"type": "Data", "level": 2, "size": 1048576, "num_sharing": 1}]},
 "benchmarks": [{"name": "n", "run_name": "sample/alias/sky/256x128/random", "run_type": "iteration",
 "repetitions": 1, "repetition_index": 0, "threads": 1, "iterations": 9, "real_time": 2.5,
 "cpu_time": 1.5, "time_unit": "us", "ns_per_sample": 3, "table_bytes": 9, "build_ms": 1,
 "worst_error": 1e-6}]})";

void write_json(const Seeds& seeds) {
  seeds.add("side-car", R"({"columns": ["x", "y", "z", "pdf"], "format": "f32", "axes": "x,-z,y",
 "preset": "z-up", "measure": "square", "density": "B", "luminance": "average"})");
  seeds.add("benchmark", kBenchmark);
  seeds.add("manifest", R"({"format": "lightproof manifest", "format_version": 1, "version": "0",
 "commit": null, "command": "c", "complete": true, "files": ["report.html", "results.json"]})");
}

void write_statements(const Seeds& seeds) {
  const auto add = [&](std::string_view name, std::string_view statements) {
    seeds.add(name, std::string(1, '\0') + std::string(statements));
  };
  add("value", "UPDATE measurements SET value = 1e308");
  add("column", "ALTER TABLE runs ADD COLUMN more TEXT");
  add("trigger", "CREATE TRIGGER t AFTER INSERT ON runs BEGIN DELETE FROM runs; END");
  add("view", "DROP VIEW history; CREATE VIEW mine AS SELECT randomblob(9) FROM runs");
  add("table", "CREATE TABLE t (a CHECK (a > 0), b AS (a + 1)); INSERT INTO t VALUES (1)");
  add("endless", "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT * FROM n");
  add("schema", "DELETE FROM runs; DROP TABLE measurements; VACUUM");
  seeds.add("bytes", std::string("\1\x3c\x00\x03\x00\x00\x00\x01\x05", 9));
}

void write_dumps(const Seeds& seeds) {
  const std::vector<float> floats = {0.6F, 0.0F, 0.8F, 0.5F, 0.0F, 1.0F, 0.0F, 0.25F};
  const std::vector<double> doubles(floats.begin(), floats.end());
  seeds.add("f4.npy", test::npy_header("<f4", "(2, 4)") + test::bytes_of(floats));
  seeds.add("f8.npy", test::npy_header("<f8", "(8,)") + test::bytes_of(doubles));
  seeds.add("raw", test::bytes_of(floats));
  seeds.add("text.csv", "x,y,z,pdf\n0.6,0,0.8,0.5\n+0,1e0,0,-2.5e-7\n# a note\n" +
                            std::string("\4\0\0\0\0\0\0\0", 8));
  seeds.add("words.csv", "1 2;3\t4\r\ninf nan 1e999 -0\n" + std::string("\4\0\0\0\0\0\0\0", 8));
}

/// Numbers without a pattern.
void write_numbers(const Seeds& seeds) {
  std::uint32_t word = 1;
  for (const char* name : {"a", "b", "c", "d"}) {
    std::string bytes;
    for (int i = 0; i < 400; ++i) {
      word = word * 1664525U + 1013904223U;
      bytes += static_cast<char>(word >> 24U);
    }
    seeds.add(name, bytes);
  }
}

void write_all(const fs::path& root) {
  write_pictures({root, "read_picture"});
  write_answers({root, "decoder_answers"});
  write_plugin_answers({root, "plugin_answers"});
  write_numbers({root, "build_sampler"});
  write_numbers({root, "draw_sample"});
  write_json({root, "json_file"});
  write_statements({root, "history_file"});
  write_dumps({root, "dump_file"});
  write_kept({root, "kept_values"});
}

}  // namespace
}  // namespace lightproof

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: write_seeds FOLDER\n");
    return 2;
  }
  try {
    lightproof::write_all(argv[1]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "write_seeds: {}\n", error.what());
    return 1;
  }
  return 0;
}
