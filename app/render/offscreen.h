#pragma once

#include <memory>
#include <string_view>

#include "render/gl_loader.h"

namespace isorelax::render {

/// How to get OpenGL without a display and without a window system.
enum class ContextKind {
  osmesa,  ///< Mesa's software renderer as a plain library
  egl,     ///< EGL on Mesa's surfaceless platform
};

/// "osmesa" or "egl". Throws UsageError.
ContextKind parse_context_kind(std::string_view text);

/// An OpenGL 3.3 core context that knows no window. Whoever draws binds a framebuffer object of their own.
class OffscreenContext {
 public:
  /// Made current in the calling thread, functions loaded. Throws Error with one line naming what is missing.
  static std::unique_ptr<OffscreenContext> create(ContextKind kind);

  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;
  virtual ~OffscreenContext() = default;

  /// Makes this context current in the calling thread and loads its functions.
  virtual void make_current() = 0;
  [[nodiscard]] virtual GlLoader loader() const = 0;

 protected:
  OffscreenContext() = default;
};

}  // namespace isorelax::render
