// OpenGL ES 3.1 without a window or a display server: EGL on Mesa's surfaceless platform. Where
// there is no graphics processor, Mesa's llvmpipe computes on the processor;
// LIBGL_ALWAYS_SOFTWARE=1 asks for it.
#pragma once

#include <string>

/// A context that is current as long as this lives.
class HeadlessContext {
 public:
  /// Throws std::runtime_error if there is none.
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

  /// What the driver calls itself, and its version.
  static std::string driver();

 private:
  void* display_;
  void* context_ = nullptr;
};
