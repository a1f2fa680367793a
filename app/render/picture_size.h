#pragma once

#include <string_view>

#include "render/camera.h"
#include "render/colormap.h"

namespace isorelax::render {

/// "1280x720". Throws UsageError.
PictureSize parse_size(std::string_view text);
/// "LO:HI" with LO < HI. Throws UsageError.
Range parse_range(std::string_view text);

}  // namespace isorelax::render
