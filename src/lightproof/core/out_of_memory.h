// Where memory runs out, the user learns for what: for which table of which map.
#pragma once

#include <new>
#include <string>

#include "lightproof/core/error.h"

namespace lightproof {

/// The error that says that `purpose` ("alias of sun-sky (16384x8192)") needs more memory than
/// there is, and how much could not be had where the exception knows. An empty purpose is not
/// known.
OutOfMemory out_of_memory(const std::string& purpose, const std::bad_alloc& error);

/// The result of `work`. Where memory runs out in it, on whatever thread, throws OutOfMemory for
/// purpose().
template <class Purpose, class Work>
auto with_memory_for(const Purpose& purpose, const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc& error) {
    throw out_of_memory(purpose(), error);
  }
}

}  // namespace lightproof
