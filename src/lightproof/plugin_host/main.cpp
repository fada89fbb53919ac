// lightproof-plugin-host: loads one plug-in, and calls its functions for whoever started it.
#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <exception>
#include <limits>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "lightproof/core/companion_start.h"
#include "lightproof/core/failure.h"
#include "lightproof/core/serialise.h"
#include "lightproof/core/system_call.h"
#include "lightproof/plugin/plugin_messages.h"
#include "lightproof/plugin_host/confinement.h"

namespace lightproof {
namespace {

constexpr std::size_t kLongestError = 512;

/// What the plug-in did wrong, in words that go on after its name.
class Fault : public std::exception {
 public:
  explicit Fault(std::string words) : words_(std::move(words)) {}
  const char* what() const noexcept override { return words_.c_str(); }

 private:
  std::string words_;
};

/// The bytes of a descriptor.
std::span<std::byte> mapped(int descriptor, int protection) {
  struct stat file = {};
  if (::fstat(descriptor, &file) != 0 || file.st_size <= 0) return {};
  const auto bytes = static_cast<std::size_t>(file.st_size);
  void* at = ::mmap(nullptr, bytes, protection, MAP_SHARED, descriptor, 0);
  if (at == MAP_FAILED) return {};
  return {static_cast<std::byte*>(at), bytes};
}

double seconds_of(clockid_t clock) {
  timespec now = {};
  ::clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Requests come from, and replies go to, a socket.
class Conversation {
 public:
  explicit Conversation(int socket) : socket_(socket) {}

  /// None once the other end is closed.
  std::optional<PluginRequest> next() const {
    PluginRequest request;
    auto bytes = std::as_writable_bytes(std::span(&request, 1));
    while (!bytes.empty()) {
      const ssize_t got =
          uninterrupted([&] { return ::recv(socket_, bytes.data(), bytes.size(), 0); });
      if (got <= 0) return std::nullopt;
      bytes = bytes.subspan(static_cast<std::size_t>(got));
    }
    return request;
  }

  void reply(PluginReply reply, std::string_view text) const {
    text = text.substr(0, kLongestPluginText);
    reply.text_bytes = text.size();
    reply.held_bytes = held_memory();
    send(std::as_bytes(std::span(&reply, 1)));
    send(std::as_bytes(std::span(text)));
  }

  void item(PluginItem item) const { send(std::as_bytes(std::span(&item, 1))); }

 private:
  void send(std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
      const ssize_t sent =
          uninterrupted([&] { return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL); });
      if (sent <= 0) ::_exit(kInputFailed);
      bytes = bytes.subspan(static_cast<std::size_t>(sent));
    }
  }

  int socket_;
};

/// The library, the sampler that it made, and the memory of a batch.
class Plugin {
 public:
  explicit Plugin(const char* file)
      : file_(file), batch_(mapped(kPluginBatchFile, PROT_READ | PROT_WRITE)) {
    if (batch_.size() != (kPluginInputs + kPluginOutputs) * sizeof(double)) {
      throw Fault("the memory of batches is not there: it is started by lightproof alone");
    }
  }

  std::string describe() {
    load();
    const auto text = [](const char* words) { return std::string(words == nullptr ? "" : words); };
    PluginDescription description{.name = text(plugin_.name),
                                  .columns = text(plugin_.columns),
                                  .axes = text(plugin_.axes),
                                  .preset = text(plugin_.preset),
                                  .measure = text(plugin_.measure),
                                  .density = text(plugin_.density),
                                  .luminance = text(plugin_.luminance),
                                  .rounding = plugin_.rounding,
                                  .has_sample = plugin_.sample != nullptr,
                                  .has_draw = plugin_.draw != nullptr,
                                  .has_pdf = plugin_.pdf != nullptr};
    ValueWriter writer;
    writer.add(description);
    return writer.take();
  }

  void create(const PluginRequest& request) {
    load();
    columns_ = request.columns;
    position_numbers_ = request.position_numbers;
    const std::span<std::byte> texels = mapped(kPluginMapFile, PROT_READ);
    if (texels.size() < std::size_t{12} * request.width * request.height) {
      throw Fault("the map is not there: it is started by lightproof alone");
    }
    name_ = request.map_name;
    map_ = {.size = sizeof(lightproof_map),
            .width = request.width,
            .height = request.height,
            .unused = 0,
            .texels = reinterpret_cast<const float*>(texels.data()),
            .name = name_.c_str(),
            .luminance = {request.luminance[0], request.luminance[1], request.luminance[2]}};
    char error[kLongestError] = {};
    sampler_ = plugin_.create(&map_, error, sizeof error);
    if (sampler_ != nullptr) return;
    error[kLongestError - 1] = '\0';
    throw Fault(error[0] == '\0' ? std::string("returned no sampler, and no reason")
                                 : fmt::format("returned no sampler: {}", error));
  }

  /// Calls a function for `count` items from number `at` of the batch on.
  void call(const PluginRequest& request, std::size_t at, std::size_t count) {
    double* in = reinterpret_cast<double*>(batch_.data());
    double* out = in + kPluginInputs;
    switch (request.call) {
      case PluginCall::sample:
        return plugin_.sample(sampler_, count, in + 2 * at, out + columns_ * at);
      case PluginCall::draw:
        return plugin_.draw(sampler_, request.seed, request.first, count, out);
      case PluginCall::pdf:
        return plugin_.pdf(sampler_, count, in + position_numbers_ * at, out + at);
      case PluginCall::describe:
      case PluginCall::create:
        return;
    }
  }

  /// Makes of what an earlier batch left, and the plug-in might not write, no numbers.
  void clear_outputs(const PluginRequest& request) {
    const std::size_t each = request.call == PluginCall::pdf ? 1 : columns_;
    double* out = reinterpret_cast<double*>(batch_.data()) + kPluginInputs;
    std::fill_n(out, each * request.count, std::numeric_limits<double>::quiet_NaN());
  }

  void destroy() {
    if (plugin_.destroy != nullptr && sampler_ != nullptr) plugin_.destroy(sampler_);
    sampler_ = nullptr;
  }

 private:
  void load() {
    if (is_loaded_) return;
    void* library = ::dlopen(file_, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) throw Fault(fmt::format("cannot be loaded: {}", ::dlerror()));
    void* symbol = ::dlsym(library, "lightproof_plugin_describe");
    if (symbol == nullptr) {
      throw Fault(
          "has no function lightproof_plugin_describe: is it a plug-in of Lightproof, and "
          "is the function exported (LIGHTPROOF_PLUGIN_EXPORT)?");
    }
    const auto describe_it = reinterpret_cast<const lightproof_plugin* (*)()>(symbol);
    take(describe_it());
    is_loaded_ = true;
  }

  /// Copies what the library knows of the description; the rest is 0.
  void take(const lightproof_plugin* theirs) {
    if (theirs == nullptr) throw Fault("describes no plug-in (NULL)");
    if (theirs->abi != LIGHTPROOF_PLUGIN_ABI) {
      throw Fault(
          fmt::format("was built for version {} of the interface, and this is version {}: "
                      "build it with the lightproof_plugin.h of this installation",
                      theirs->abi, LIGHTPROOF_PLUGIN_ABI));
    }
    constexpr std::size_t kLeast = offsetof(lightproof_plugin, destroy);
    if (theirs->size < kLeast) {
      throw Fault(fmt::format("has a description of {} bytes, fewer than any version had ({})",
                              theirs->size, kLeast));
    }
    std::memcpy(&plugin_, theirs, std::min<std::size_t>(theirs->size, sizeof plugin_));
    if (plugin_.create == nullptr) throw Fault("has no function create");
    if (plugin_.sample == nullptr && plugin_.draw == nullptr) {
      throw Fault("has neither a function sample nor draw");
    }
  }

  const char* file_;
  std::span<std::byte> batch_;
  lightproof_plugin plugin_ = {};
  bool is_loaded_ = false;
  std::string name_;
  lightproof_map map_ = {};
  void* sampler_ = nullptr;
  std::size_t columns_ = 0;
  std::size_t position_numbers_ = 0;
};

/// Makes a call of the plug-in, with the clock running, and looks at what it left behind.
template <class Call>
void timed(PluginReply& reply, const Call& call) {
  static const pid_t self = ::getpid();
  const double cpu = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
  const double wall = seconds_of(CLOCK_MONOTONIC);
  call();
  reply.wall_seconds += seconds_of(CLOCK_MONOTONIC) - wall;
  reply.cpu_seconds += seconds_of(CLOCK_PROCESS_CPUTIME_ID) - cpu;
  // A copy of this process, which the plug-in made, has no business here.
  if (::getpid() != self) ::_exit(0);
  if (has_children()) throw Fault("started another process, which a plug-in may not");
}

void answer(Plugin& plugin, const Conversation& conversation, const PluginRequest& request,
            PluginReply& reply, std::string& text) {
  switch (request.call) {
    case PluginCall::describe:
      limit_memory(request.memory_bytes);
      return timed(reply, [&] { text = plugin.describe(); });
    case PluginCall::create:
      limit_memory(request.memory_bytes);
      return timed(reply, [&] { plugin.create(request); });
    case PluginCall::sample:
    case PluginCall::draw:
    case PluginCall::pdf:
      break;
  }
  const std::size_t count = std::min<std::size_t>(request.count, kPluginBatch);
  plugin.clear_outputs(request);
  if (request.one_by_one == 0) return timed(reply, [&] { plugin.call(request, 0, count); });
  for (std::size_t at = 0; at < count; ++at) {
    timed(reply, [&] { plugin.call(request, at, 1); });
    conversation.item(PluginItem::done);
  }
}

[[noreturn]] void converse(const char* file, int socket) {
  const Conversation conversation(socket);
  Plugin plugin(file);
  while (const std::optional<PluginRequest> next = conversation.next()) {
    const PluginRequest& request = *next;
    PluginReply reply;
    std::string text;
    try {
      answer(plugin, conversation, request, reply, text);
      reply.status = PluginStatus::done;
    } catch (const Fault& fault) {
      text = fault.what();
    } catch (const std::bad_alloc&) {
      text = "threw std::bad_alloc: it needs more memory than it may have";
    } catch (const std::exception& error) {
      text = fmt::format("threw an exception: {}", error.what());
    } catch (...) {
      text = "threw an exception";
    }
    if (request.one_by_one != 0 && reply.status == PluginStatus::failed) {
      conversation.item(PluginItem::failed);
    }
    conversation.reply(reply, text);
  }
  try {
    plugin.destroy();
  } catch (...) {
    ::_exit(kPluginThrew);
  }
  // What the library would do at the end of a program is no matter of its sampler.
  ::_exit(kPluginDestroyed);
}

constexpr const char* kUsage =
    "lightproof-plugin-host calls the functions of a plug-in for lightproof gate --plugin, which\n"
    "starts it itself: it has no use of its own.\n"
    "  --version   print the version\n"
    "  --help      print this\n";

}  // namespace
}  // namespace lightproof

int main(int argc, char** argv) {
  using namespace lightproof;
  if (argc != 2 || !is_socket(STDIN_FILENO)) {
    return explain_companion("lightproof-plugin-host", kUsage, argc, argv);
  }
  const HostFiles files = confine_plugin();
  watch(files, mapped(kPluginLogFile, PROT_READ | PROT_WRITE));
  try {
    converse(argv[1], files.socket);
  } catch (...) {
    ::_exit(kProgramFailed);
  }
}
