#include "headless_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl31.h>

#include <stdexcept>

namespace {

void require(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error("EGL: " + what);
}

std::string text_of(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text == nullptr ? "?" : reinterpret_cast<const char*>(text);
}

}  // namespace

HeadlessContext::HeadlessContext()
    : display_(eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)) {
  require(display_ != EGL_NO_DISPLAY, "the driver has no surfaceless platform");
  require(eglInitialize(display_, nullptr, nullptr) == EGL_TRUE, "no display could be opened");
  require(eglBindAPI(EGL_OPENGL_ES_API) == EGL_TRUE, "the driver has no OpenGL ES");
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 1, EGL_NONE};
  context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version);
  require(context_ != EGL_NO_CONTEXT, "the driver has no OpenGL ES 3.1");
  require(eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE,
          "the driver needs a surface");
}

HeadlessContext::~HeadlessContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

std::string HeadlessContext::driver() { return text_of(GL_RENDERER) + "; " + text_of(GL_VERSION); }
