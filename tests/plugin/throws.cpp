// Plug-ins in C++ that throw, in sample() or in destroy(), as LIGHTPROOF_DEFECT says.
#include <cstddef>
#include <stdexcept>
#include <string_view>

#include "lightproof/plugin/lightproof_plugin.h"

namespace {

constexpr bool kAtTheEnd = LIGHTPROOF_DEFECT == std::string_view("throws-at-the-end");

void* create(const lightproof_map* /*map*/, char* /*error*/, std::size_t /*bytes*/) {
  static int sampler = 0;
  return &sampler;
}

void sample(void* /*sampler*/, std::size_t /*count*/, const double* /*u*/, double* /*rows*/) {
  if (kAtTheEnd) return;
  throw std::runtime_error("the lamp is broken");
}

void destroy(void* /*sampler*/) {
  if (kAtTheEnd) throw std::runtime_error("the lamp is broken");
}

}  // namespace

extern "C" LIGHTPROOF_PLUGIN_EXPORT const lightproof_plugin* lightproof_plugin_describe() {
  static const lightproof_plugin plugin = [] {
    lightproof_plugin description = {};
    description.abi = LIGHTPROOF_PLUGIN_ABI;
    description.size = sizeof description;
    description.create = create;
    description.sample = sample;
    description.destroy = destroy;
    return description;
  }();
  return &plugin;
}
