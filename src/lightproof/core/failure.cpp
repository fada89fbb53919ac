#include "lightproof/core/failure.h"

#include <fmt/format.h>

#include <new>

#include "lightproof/core/error.h"
#include "lightproof/core/out_of_memory.h"

namespace lightproof {
namespace {

Failure program_failure(const std::string& what) {
  return {
      kProgramFailed,
      fmt::format("internal error: {}\nThis is a fault of Lightproof itself, not of your input. "
                  "Please report it, with this message, the version ({}), the command line and, "
                  "if you may share it, the map.",
                  what, LIGHTPROOF_VERSION)};
}

}  // namespace

Failure failure_of(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const InputError& bad_input) {
    return {kInputFailed, bad_input.what()};
  } catch (const OutOfMemory& out_of_memory) {
    return {kMemoryFailed, out_of_memory.what()};
  } catch (const std::bad_alloc& bad_alloc) {
    return {kMemoryFailed, out_of_memory("", bad_alloc).what()};
  } catch (const std::exception& other) {
    return program_failure(other.what());
  } catch (...) {
    return program_failure("unknown");
  }
}

}  // namespace lightproof
