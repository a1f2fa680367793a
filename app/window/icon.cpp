#include "window/icon.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <png.h>

#include <string_view>
#include <vector>

#include "window/embedded.h"

namespace isorelax::window {

void set_icon(GLFWwindow* window) {
  const std::string_view bytes = embedded_file("isorelax.png");
  png_image picture{};
  picture.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&picture, bytes.data(), bytes.size()) == 0) return;
  picture.format = PNG_FORMAT_RGBA;
  std::vector<unsigned char> pixels(PNG_IMAGE_SIZE(picture));
  if (png_image_finish_read(&picture, nullptr, pixels.data(), 0, nullptr) == 0) return;
  const GLFWimage icon{static_cast<int>(picture.width), static_cast<int>(picture.height), pixels.data()};
  glfwSetWindowIcon(window, 1, &icon);
}

}  // namespace isorelax::window
