#pragma once

#include <string>

#include "cli/json.h"
#include "cli/motion_table.h"
#include "render/image.h"

namespace isorelax::cli {

/// The table for people, with goals and what was tried.
[[nodiscard]] std::string motion_text(const MotionTable& table);
[[nodiscard]] Json motion_json(const MotionTable& table);
/// Every preset (a row) at a quarter, a half and the whole of the period, on one camera and one range of
/// areas.
[[nodiscard]] render::Image motion_picture(const MotionTable& table);

}  // namespace isorelax::cli
