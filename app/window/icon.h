#pragma once

struct GLFWwindow;

namespace isorelax::window {

/// Gives the window the program's icon (assets/icon).
void set_icon(GLFWwindow* window);

}  // namespace isorelax::window
