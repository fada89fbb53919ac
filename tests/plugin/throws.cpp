// A plug-in in C++ that throws.
#include <cstddef>
#include <stdexcept>

#include "lightproof/plugin/lightproof_plugin.h"

namespace {

void* create(const lightproof_map* /*map*/, char* /*error*/, std::size_t /*bytes*/) {
  static int sampler = 0;
  return &sampler;
}

void sample(void* /*sampler*/, std::size_t /*count*/, const double* /*u*/, double* /*rows*/) {
  throw std::runtime_error("the lamp is broken");
}

}  // namespace

extern "C" LIGHTPROOF_PLUGIN_EXPORT const lightproof_plugin* lightproof_plugin_describe() {
  static const lightproof_plugin plugin = [] {
    lightproof_plugin description = {};
    description.abi = LIGHTPROOF_PLUGIN_ABI;
    description.size = sizeof description;
    description.create = create;
    description.sample = sample;
    return description;
  }();
  return &plugin;
}
