// The sampler of one map in processes of a plug-in.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lightproof/check/texel_locator.h"
#include "lightproof/core/error.h"
#include "lightproof/core/shared_memory.h"
#include "lightproof/gate/sampler_failure.h"
#include "lightproof/image/reproject.h"
#include "lightproof/plugin/plugin_library.h"
#include "lightproof/warp/lat_long.h"

namespace lightproof {
namespace {

/// Samples keep this many times their rounding away from the edges of their texel, but for no more
/// than a quarter of it: pdf() is asked there, and must not see the next texel.
constexpr double kMargin = 4.0;
constexpr double kMostMargin = 0.25;

std::string_view name_of(PluginCall call) {
  switch (call) {
    case PluginCall::describe:
      return "lightproof_plugin_describe()";
    case PluginCall::create:
      return "create()";
    case PluginCall::sample:
      return "sample()";
    case PluginCall::draw:
      return "draw()";
    case PluginCall::pdf:
      break;
  }
  return "pdf()";
}

/// "(0.25, 0.5)", to the last bit.
std::string numbers_text(std::span<const double> numbers) {
  std::string text;
  for (const double number : numbers) {
    text += fmt::format("{}{:.17g}", text.empty() ? "(" : ", ", number);
  }
  return text + ")";
}

/// The texels as the picture that the plug-in's preset asks for, row 0 at its top.
void write_picture(const EnvironmentMap& map, Preset preset, std::span<std::byte> bytes) {
  const Extent extent = map.radiance.extent();
  const std::span<float> picture(reinterpret_cast<float*>(bytes.data()), 3 * extent.count());
  for (int y = 0; y < extent.height; ++y) {
    for (int x = 0; x < extent.width; ++x) {
      const PicturePixel pixel = pixel_in_picture(preset, extent, x, y);
      const std::size_t at =
          3 * (static_cast<std::size_t>(pixel.row) * static_cast<std::size_t>(extent.width) +
               static_cast<std::size_t>(pixel.column));
      const Rgb rgb = map.radiance(x, y);
      picture[at] = rgb.r;
      picture[at + 1] = rgb.g;
      picture[at + 2] = rgb.b;
    }
  }
}

/// Throws InputError where the texels of a map are no picture of a preset.
void check_picture(const PluginLibrary& library, const EnvironmentMap& map) {
  const Preset preset = library.rows().convention().preset;
  const Extent extent = map.radiance.extent();
  if (is_plain(map.mapping) && is_plain(own_texels(preset, extent).mapping)) return;
  throw InputError(
      fmt::format("{}: the plug-in {} wants it in the convention {}, in which its {} x {} texels "
                  "are no picture: "
                  "resample it to an even width",
                  map.name, library.name(), info(preset).name, extent.width, extent.height));
}

/// The declared density over the square, from the map itself.
class DeclaredOnMap {
 public:
  DeclaredOnMap(const EnvironmentMap& map, TargetDensity target) : map_(&map), target_(target) {
    const Extent extent = map.radiance.extent();
    for (int y = 0; y < extent.height; ++y) {
      double row = 0.0;
      for (int x = 0; x < extent.width; ++x) row += weight(x, y);
      total_ += row;
    }
  }

  double operator()(SquarePoint at, int x, int y) const {
    const Extent extent = map_->radiance.extent();
    const double mass = weight(x, y) / total_;
    if (position_measure(target_.density_space) == MapMeasure::square) {
      return mass * static_cast<double>(extent.count());
    }
    return to_square(PerSteradian{mass / texel_solid_angle(extent, y)}, at).value;
  }

 private:
  double weight(int x, int y) const {
    const double luminance = luminance_of(map_->radiance(x, y), target_.weights);
    return texel_measure(target_.density_space) == MapMeasure::square
               ? luminance
               : luminance * texel_solid_angle(map_->radiance.extent(), y);
  }

  const EnvironmentMap* map_;
  TargetDensity target_;
  double total_ = 0.0;
};

/// What every process of a plug-in on one map is told, and shares.
class MapOfPlugin {
 public:
  MapOfPlugin(const PluginLibrary& library, const EnvironmentMap& map)
      : library_(&library), texels_(3 * sizeof(float) * map.radiance.extent().count()) {
    check_picture(library, map);
    const Extent extent = map.radiance.extent();
    write_picture(map, library.rows().convention().preset, texels_.bytes());
    texels_.close_to_others();
    create_.width = static_cast<std::uint32_t>(extent.width);
    create_.height = static_cast<std::uint32_t>(extent.height);
    create_.columns = static_cast<std::uint32_t>(library.rows().columns().count);
    create_.position_numbers = static_cast<std::uint32_t>(library.rows().numbers_of_position());
    const LuminanceWeights weights = on_map(library.target(), map).weights;
    create_.luminance[0] = weights.red;
    create_.luminance[1] = weights.green;
    create_.luminance[2] = weights.blue;
    const std::size_t length = std::min(map.name.size(), sizeof create_.map_name - 1);
    std::memcpy(create_.map_name, map.name.data(), length);
  }

  /// A process with the sampler of the map. Throws SamplerFailure if it makes none.
  std::unique_ptr<PluginProcess> start() const {
    auto process =
        std::make_unique<PluginProcess>(library_->file(), library_->options().limits, &texels_);
    const PluginAnswer answer =
        process->create(create_, std::size_t{create_.width} * create_.height);
    if (answer.is_done()) return process;
    throw SamplerFailure(fmt::format("create() {}, on a map of {} x {} texels", answer.failure,
                                     create_.width, create_.height));
  }

 private:
  const PluginLibrary* library_;
  SharedMemory texels_;
  PluginRequest create_;
};

/// Processes of one plug-in on one map: as many as threads ask at a time.
class PluginSampler {
 public:
  PluginSampler(std::shared_ptr<const PluginLibrary> library, const EnvironmentMap& map,
                std::shared_ptr<PluginNotes> notes)
      : library_(std::move(library)),
        notes_(std::move(notes)),
        mapping_(map.mapping),
        extent_(map.radiance.extent()),
        map_(*library_, map),
        locate_(map.mapping, extent_, library_->rounding(),
                DeclaredOnMap(map, on_map(library_->target(), map))) {
    give_back(map_.start());
  }

  ~PluginSampler() {
    for (const std::unique_ptr<PluginProcess>& process : idle_) retire(*process);
  }
  PluginSampler(const PluginSampler&) = delete;
  PluginSampler& operator=(const PluginSampler&) = delete;

  void sample(std::span<const SquarePoint> points, std::span<TexelSample> samples) const {
    for (std::size_t done = 0; done < points.size(); done += kPluginBatch) {
      const std::size_t count = std::min(kPluginBatch, points.size() - done);
      PluginRequest request;
      request.call = PluginCall::sample;
      request.count = count;
      const auto put = [&](std::span<double> inputs) {
        for (std::size_t i = 0; i < count; ++i) {
          inputs[2 * i] = points[done + i].s;
          inputs[2 * i + 1] = points[done + i].t;
        }
      };
      ask(request, put, [&](std::span<const double> rows) {
        for (std::size_t i = 0; i < count; ++i) samples[done + i] = sample_of(rows, i);
      });
    }
  }

  void draw(std::uint64_t first, std::span<TexelSample> samples) const {
    const std::uint64_t last = first + samples.size();
    for (std::uint64_t block = first / kPluginDrawn * kPluginDrawn; block < last;
         block += kPluginDrawn) {
      PluginRequest request;
      request.call = PluginCall::draw;
      request.count = kPluginDrawn;
      request.first = block;
      request.seed = library_->options().seed;
      ask(
          request, [](std::span<double>) {},
          [&](std::span<const double> rows) {
            const std::uint64_t end = std::min(last, block + kPluginDrawn);
            for (std::uint64_t number = std::max(first, block); number < end; ++number) {
              samples[number - first] = sample_of(rows, number - block);
            }
          });
    }
  }

  void pdf(std::span<const SquarePoint> positions, std::span<PerSquare> densities) const {
    const SampleRows& rows = library_->rows();
    const std::size_t size = rows.numbers_of_position();
    for (std::size_t done = 0; done < positions.size(); done += kPluginBatch) {
      const std::size_t count = std::min(kPluginBatch, positions.size() - done);
      PluginRequest request;
      request.call = PluginCall::pdf;
      request.count = count;
      const auto put = [&](std::span<double> inputs) {
        for (std::size_t i = 0; i < count; ++i) {
          rows.put_position(direction_at(mapping_, positions[done + i]),
                            inputs.subspan(size * i, size));
        }
      };
      ask(request, put, [&](std::span<const double> values) {
        for (std::size_t i = 0; i < count; ++i) {
          const SquarePoint at = positions[done + i];
          const PerSteradian density = rows.density(direction_at(mapping_, at), values[i]);
          densities[done + i] = {density.value * solid_angle_per_square(mapping_, at)};
        }
      });
    }
  }

  double pdf_rounding(SquarePoint at) const {
    return 2.0 * library_->rounding() * effect_of_turn(mapping_, at).jacobian;
  }

 private:
  TexelSample sample_of(std::span<const double> rows, std::size_t number) const {
    const std::size_t columns = library_->rows().columns().count;
    DumpedSample drawn = library_->rows().sample(rows.subspan(number * columns, columns));
    TexelSample sample = locate_(drawn);
    if (sample.x < 0) return sample;
    const TurnEffect turn = effect_of_turn(mapping_, sample.at);
    sample.at = {inside(sample.at.s, sample.x, extent_.width, turn.s),
                 inside(sample.at.t, sample.y, extent_.height, turn.t)};
    return sample;
  }

  /// A coordinate, far enough from the edges of its cell for a direction there to be in the cell.
  double inside(double coordinate, int cell, int count, double turn) const {
    const double margin = std::min(kMostMargin, kMargin * library_->rounding() * turn * count);
    return (cell + std::clamp(coordinate * count - cell, margin, 1.0 - margin)) / count;
  }

  std::unique_ptr<PluginProcess> take() const {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        std::unique_ptr<PluginProcess> process = std::move(idle_.back());
        idle_.pop_back();
        return process;
      }
    }
    return map_.start();
  }

  void give_back(std::unique_ptr<PluginProcess> process) const {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(process));
  }

  /// Ends a process, and notes what it printed.
  void retire(PluginProcess& process) const {
    const std::string fault = process.end();
    if (!fault.empty()) notes_->add(fmt::format("{}: the plug-in {}", library_->name(), fault));
    const std::string printed = process.printed();
    if (!printed.empty()) {
      notes_->add(fmt::format("{}: the plug-in printed: {}", library_->name(), printed));
    }
  }

  /// Has a batch done: put(inputs), the call, get(outputs).
  template <class Put, class Get>
  void ask(const PluginRequest& request, const Put& put, const Get& get) const {
    std::unique_ptr<PluginProcess> process = take();
    put(process->inputs());
    const PluginAnswer answer = process->call(request);
    if (!answer.is_done()) {
      retire(*process);
      process.reset();
      // The plug-in may have written over what it was given.
      std::vector<double> inputs(kPluginInputs);
      put(inputs);
      throw SamplerFailure(words_of(request, answer, inputs));
    }
    // A copy, which no thread of the plug-in changes while it is looked at.
    const std::size_t each = request.call == PluginCall::pdf ? 1 : library_->rows().columns().count;
    const auto first = process->outputs().begin();
    const std::vector<double> outputs(first,
                                      first + static_cast<std::ptrdiff_t>(each * request.count));
    get(outputs);
    give_back(std::move(process));
  }

  /// The input of item number i of a batch.
  std::string input_text(const PluginRequest& request, std::span<const double> inputs,
                         std::size_t i) const {
    if (request.call == PluginCall::draw) {
      return fmt::format("sample number {} with the seed {}", request.first + i, request.seed);
    }
    if (request.call == PluginCall::sample) {
      return fmt::format("u = {}", numbers_text(inputs.subspan(2 * i, 2)));
    }
    const std::size_t size = library_->rows().numbers_of_position();
    return fmt::format("the {} {}", size == 3 ? "direction" : "point",
                       numbers_text(inputs.subspan(size * i, size)));
  }

  /// What became of a call, with the input at fault: the first of the batch that fails alone, in a
  /// new process, or the whole batch.
  std::string words_of(const PluginRequest& request, const PluginAnswer& failed,
                       std::span<const double> inputs) const {
    std::string alone;
    if (request.call != PluginCall::draw && !failed.is_over_memory) {
      PluginRequest again = request;
      again.one_by_one = 1;
      const std::unique_ptr<PluginProcess> process = map_.start();
      std::ranges::copy(inputs, process->inputs().begin());
      const PluginAnswer answer = process->call(again);
      if (!answer.is_done() && answer.items_done < request.count) {
        return fmt::format("{} {} at {}, alone in a new process", name_of(request.call),
                           answer.failure, input_text(request, inputs, answer.items_done));
      }
      alone = fmt::format("; {} of them alone, in a new process, it answers",
                          answer.items_done < request.count
                              ? fmt::format("the first {}", answer.items_done)
                              : "each");
    }
    return fmt::format("{} {}, in a batch of {} from {} on{}", name_of(request.call),
                       failed.failure, request.count, input_text(request, inputs, 0), alone);
  }

  std::shared_ptr<const PluginLibrary> library_;
  std::shared_ptr<PluginNotes> notes_;
  Mapping mapping_;
  Extent extent_;
  MapOfPlugin map_;
  TexelLocator locate_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<PluginProcess>> idle_;
};

}  // namespace

BoundSampler bound_plugin(std::shared_ptr<const PluginLibrary> library, const EnvironmentMap& map,
                          std::shared_ptr<PluginNotes> notes) {
  const PluginDescription& said = library->description();
  const bool has_weights = library->rows().columns().pdf.has_value();
  const auto plugin =
      std::make_shared<const PluginSampler>(std::move(library), map, std::move(notes));
  BoundSampler sampler;
  sampler.runs_elsewhere = true;
  sampler.has_weights = has_weights;
  if (said.has_sample) {
    sampler.sample = [plugin](std::span<const SquarePoint> points, std::span<TexelSample> samples) {
      plugin->sample(points, samples);
    };
  } else {
    sampler.sample_in_order = [plugin](std::uint64_t first, std::span<TexelSample> samples) {
      plugin->draw(first, samples);
    };
  }
  sampler.pdf_rounding = [plugin](SquarePoint at) { return plugin->pdf_rounding(at); };
  if (!said.has_pdf) return sampler;
  sampler.pdfs = [plugin](std::span<const SquarePoint> positions, std::span<PerSquare> densities) {
    plugin->pdf(positions, densities);
  };
  sampler.pdf = [plugin](SquarePoint at) {
    PerSquare density{};
    plugin->pdf({&at, 1}, {&density, 1});
    return density;
  };
  return sampler;
}

struct TimedPlugin::State {
  State(const PluginLibrary& library, const EnvironmentMap& map)
      : shared(library, map), process(shared.start()) {}

  MapOfPlugin shared;
  std::unique_ptr<PluginProcess> process;
};

TimedPlugin::TimedPlugin(const PluginLibrary& library, const EnvironmentMap& map)
    : state_(std::make_unique<State>(library, map)) {}

TimedPlugin::~TimedPlugin() = default;

PluginTime TimedPlugin::draw(std::span<const SquarePoint> points) const {
  PluginProcess& process = *state_->process;
  const std::span<double> inputs = process.inputs();
  for (std::size_t i = 0; i < points.size(); ++i) {
    inputs[2 * i] = points[i].s;
    inputs[2 * i + 1] = points[i].t;
  }
  PluginRequest request;
  request.call = PluginCall::sample;
  request.count = points.size();
  const PluginAnswer answer = process.call(request);
  if (!answer.is_done()) throw SamplerFailure(fmt::format("sample() {}", answer.failure));
  const auto count = static_cast<double>(points.size());
  return {1e9 * answer.cpu_seconds / count, 1e9 * answer.wall_seconds / count};
}

}  // namespace lightproof
