// No window system's headers behind EGL's.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstring>
#include <string>

#include "mesh/error.h"
#include "render/offscreen_contexts.h"

namespace isorelax::render {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw Error("EGL " + what + " (error " + std::to_string(eglGetError()) + "); the context osmesa may work");
}

EGLDisplay surfaceless_display() {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (extensions == nullptr || std::strstr(extensions, "EGL_MESA_platform_surfaceless") == nullptr)
    fail("has no surfaceless platform (is libegl-mesa0 installed?)");
  const EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
  if (display == EGL_NO_DISPLAY) fail("gives no surfaceless display");
  if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE) fail("cannot be initialised");
  return display;
}

class EglContext final : public OffscreenContext {
 public:
  EglContext() : display_(surfaceless_display()) {
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) fail("has no desktop OpenGL");
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                             EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglChooseConfig(display_, wanted, &config, 1, &count) == EGL_FALSE || count == 0)
      fail("has no configuration for OpenGL");
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 3,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 3,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, attributes);
    if (context_ == EGL_NO_CONTEXT) fail("gives no OpenGL 3.3 core context");
  }
  ~EglContext() override {
    if (eglGetCurrentContext() == context_)
      eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    // The display is shared by all contexts of the process and stays initialised.
    eglDestroyContext(display_, context_);
  }

  void make_current() override {
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE)
      fail("cannot make its context current without a surface");
    load_gl(loader());
  }
  [[nodiscard]] GlLoader loader() const override {
    return [](const char* name) { return eglGetProcAddress(name); };
  }

 private:
  EGLDisplay display_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<OffscreenContext> create_egl_context() {
  return std::make_unique<EglContext>();
}

}  // namespace isorelax::render
