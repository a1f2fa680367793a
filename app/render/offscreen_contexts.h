#pragma once

#include <memory>

#include "render/offscreen.h"

namespace isorelax::render {

/// The implementations of OffscreenContext, not yet current. Throw Error.
std::unique_ptr<OffscreenContext> create_osmesa_context();
std::unique_ptr<OffscreenContext> create_egl_context();

}  // namespace isorelax::render
