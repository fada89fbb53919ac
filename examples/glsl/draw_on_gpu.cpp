// Samples of an environment map that a compute shader draws, as a dump for `lightproof check`.
// Usage: draw_on_gpu MAP DUMP.f32 [--size WxH] [--count N] [--random FILE] [--published]
//        [--half-texel]
//
//   draw_on_gpu sun-sky samples.f32 --size 128x64
//   lightproof check samples.f32 --map sun-sky --size 128x64
//
// MAP is a file or a map that Lightproof has built in. A row of the dump is s, t, the density per
// unit square, and the texel, as floats; what they mean stands in DUMP.f32.json, which `check`
// reads. The random numbers, two a sample, come from a generator, or as floats from a file.
// --published draws as the lecture's shader does, --half-texel is a defect, to see it found.
#include <GLES3/gl31.h>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "headless_context.h"
#include "lightproof/image/reader.h"
#include "lightproof/image/synthetic.h"

namespace {

using lightproof::EnvironmentMap;
using lightproof::Extent;

constexpr std::size_t kGroupSize = 64;  // as draw.comp has it
constexpr std::size_t kRowFloats = 4;

struct Options {
  std::string map;
  std::string dump;
  Extent size = {128, 64};
  std::size_t count = std::size_t{1} << 20U;
  std::string random;
  std::string defines;
};

Options parse(std::span<char*> arguments) {
  Options options;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string word = arguments[i];
    const auto value = [&]() -> std::string {
      if (i + 1 == arguments.size()) throw std::invalid_argument(word + " needs a value");
      return arguments[++i];
    };
    if (word == "--published") {
      options.defines += "#define PUBLISHED\n";
    } else if (word == "--half-texel") {
      options.defines += "#define HALF_TEXEL\n";
    } else if (word == "--random") {
      options.random = value();
    } else if (word == "--count") {
      options.count = std::stoull(value());
    } else if (word == "--size") {
      const std::string size = value();
      options.size = {std::stoi(size), std::stoi(size.substr(size.find('x') + 1))};
    } else if (word.starts_with("-")) {
      throw std::invalid_argument("there is no option " + word);
    } else {
      names.push_back(word);
    }
  }
  if (names.size() != 2) {
    throw std::invalid_argument(
        "usage: draw_on_gpu MAP DUMP.f32 [--size WxH] [--count N] [--random FILE] [--published] "
        "[--half-texel]");
  }
  options.map = names[0];
  options.dump = names[1];
  return options;
}

EnvironmentMap map_of(const Options& options) {
  for (const lightproof::SyntheticMap& known : lightproof::synthetic_maps()) {
    if (known.name == options.map) return known.make(options.size);
  }
  return lightproof::read_environment_map(options.map, {.repair = lightproof::Repair::zero});
}

std::vector<char> bytes_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(file + " cannot be read");
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string text_of(const std::string& file) {
  const std::vector<char> bytes = bytes_of(std::string(SHADERS "/") + file);
  return {bytes.begin(), bytes.end()};
}

/// Two floats a sample, in [0,1): multiples of 2^-24.
std::vector<float> random_numbers(const Options& options) {
  if (!options.random.empty()) {
    const std::vector<char> bytes = bytes_of(options.random);
    std::vector<float> numbers(bytes.size() / (2 * sizeof(float)) * 2);
    std::copy_n(bytes.data(), numbers.size() * sizeof(float),
                reinterpret_cast<char*>(numbers.data()));
    return numbers;
  }
  std::mt19937 generator(1);
  std::vector<float> numbers(2 * options.count);
  for (float& number : numbers) number = static_cast<float>(generator() >> 8U) * 0x1p-24F;
  return numbers;
}

/// Means of the luminances of rows, and of the map, summed as a host program does: in float.
struct Averages {
  std::vector<float> rows;
  float map = 0.0F;
};

Averages averages_of(const EnvironmentMap& map) {
  const lightproof::LuminanceWeights weights = lightproof::kPublishedLuminance;
  const glm::vec3 published(weights.red, weights.green, weights.blue);
  const Extent extent = map.radiance.extent();
  Averages averages;
  for (int y = 0; y < extent.height; ++y) {
    float sum = 0.0F;
    for (const lightproof::Rgb& rgb : map.radiance.row(y)) sum += glm::dot(published, rgb);
    averages.rows.push_back(sum / static_cast<float>(extent.width));
    averages.map += averages.rows.back();
  }
  averages.map /= static_cast<float>(extent.height);
  return averages;
}

void require_ok(GLuint object, GLenum what, decltype(glGetProgramiv)* ask,
                decltype(glGetProgramInfoLog)* ask_log) {
  GLint ok = GL_FALSE;
  ask(object, what, &ok);
  if (ok == GL_TRUE) return;
  std::string log(4096, '\0');
  GLsizei length = 0;
  ask_log(object, static_cast<GLsizei>(log.size()), &length, log.data());
  throw std::runtime_error("the shader: " + log.substr(0, static_cast<std::size_t>(length)));
}

GLuint compute_program(const std::string& defines) {
  const std::string text = "#version 310 es\nprecision highp float;\nprecision highp int;\n" +
                           defines + text_of("linear_scan.glsl") + text_of("draw.comp");
  const char* const source = text.c_str();
  const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  require_ok(shader, GL_COMPILE_STATUS, glGetShaderiv, glGetShaderInfoLog);
  const GLuint program = glCreateProgram();
  glAttachShader(program, shader);
  glLinkProgram(program);
  require_ok(program, GL_LINK_STATUS, glGetProgramiv, glGetProgramInfoLog);
  return program;
}

/// A texture that is only fetched from, texel by texel, as unit `unit` of the program.
void bind_texture(GLuint program, const char* name, GLint unit, GLenum format, Extent extent,
                  const float* texels) {
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexStorage2D(GL_TEXTURE_2D, 1, format, extent.width, extent.height);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, extent.width, extent.height,
                  format == GL_RGB32F ? GL_RGB : GL_RED, GL_FLOAT, texels);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glUniform1i(glGetUniformLocation(program, name), unit);
}

void bind_buffer(GLuint binding, std::size_t floats, const float* values) {
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer);
  glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(floats * sizeof(float)), values,
               GL_STATIC_DRAW);
}

std::vector<float> samples_of(const EnvironmentMap& map, const std::vector<float>& random,
                              const std::string& defines) {
  const GLuint program = compute_program(defines);
  glUseProgram(program);
  const Averages averages = averages_of(map);
  const Extent extent = map.radiance.extent();
  bind_texture(program, "map", 0, GL_RGB32F, extent, &map.radiance.values().data()->x);
  bind_texture(program, "row_averages", 1, GL_R32F, {1, extent.height}, averages.rows.data());
  glUniform1f(glGetUniformLocation(program, "average"), averages.map);

  const std::size_t count = random.size() / 2;
  bind_buffer(0, random.size(), random.data());
  bind_buffer(1, kRowFloats * count, nullptr);
  glDispatchCompute(static_cast<GLuint>((count + kGroupSize - 1) / kGroupSize), 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const auto bytes = static_cast<GLsizeiptr>(kRowFloats * count * sizeof(float));
  const void* const drawn = glMapBufferRange(GL_SHADER_STORAGE_BUFFER, 0, bytes, GL_MAP_READ_BIT);
  if (const GLenum error = glGetError(); error != GL_NO_ERROR || drawn == nullptr) {
    throw std::runtime_error("OpenGL error " + std::to_string(error));
  }
  const auto* const first = static_cast<const float*>(drawn);
  return {first, first + kRowFloats * count};
}

void write(const std::string& file, const void* bytes, std::size_t size) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  if (!stream.flush()) throw std::runtime_error(file + " cannot be written");
}

void run(const Options& options) {
  const EnvironmentMap map = map_of(options);
  const std::vector<float> random = random_numbers(options);
  const HeadlessContext context;
  std::printf("%s\n", HeadlessContext::driver().c_str());
  const std::vector<float> samples = samples_of(map, random, options.defines);
  write(options.dump, samples.data(), samples.size() * sizeof(float));
  const std::string meaning =
      "{\"columns\": [\"s\", \"t\", \"pdf\", \"-\"], \"measure\": \"square\",\n"
      " \"density\": \"A\", \"luminance\": \"published\"}\n";
  write(options.dump + ".json", meaning.data(), meaning.size());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(parse({argv + 1, argv + argc}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "draw_on_gpu: %s\n", error.what());
    return 2;
  }
  return 0;
}
