#include "render/offscreen.h"

#include <string>

#include "mesh/error.h"
#include "render/offscreen_contexts.h"

namespace isorelax::render {

ContextKind parse_context_kind(std::string_view text) {
  if (text == "osmesa") return ContextKind::osmesa;
  if (text == "egl") return ContextKind::egl;
  throw UsageError("context '" + std::string(text) + "' is unknown: give osmesa or egl");
}

std::unique_ptr<OffscreenContext> OffscreenContext::create(ContextKind kind) {
  auto context = kind == ContextKind::osmesa ? create_osmesa_context() : create_egl_context();
  context->make_current();
  return context;
}

}  // namespace isorelax::render
