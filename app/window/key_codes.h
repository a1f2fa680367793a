#pragma once

#include "ui/input.h"

namespace isorelax::window {

/// The editor's name of a GLFW key; Key::none for one that it does not know.
[[nodiscard]] ui::Key key_of(int glfw_key);
/// From GLFW's bits.
[[nodiscard]] ui::Modifiers modifiers_of(int glfw_mods);

}  // namespace isorelax::window
