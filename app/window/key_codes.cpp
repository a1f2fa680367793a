#include "window/key_codes.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <utility>

namespace isorelax::window {

ui::Key key_of(int glfw_key) {
  using ui::Key;
  constexpr std::array kCodes{
      std::pair{GLFW_KEY_TAB, Key::tab},
      std::pair{GLFW_KEY_LEFT, Key::left},
      std::pair{GLFW_KEY_RIGHT, Key::right},
      std::pair{GLFW_KEY_UP, Key::up},
      std::pair{GLFW_KEY_DOWN, Key::down},
      std::pair{GLFW_KEY_PAGE_UP, Key::page_up},
      std::pair{GLFW_KEY_PAGE_DOWN, Key::page_down},
      std::pair{GLFW_KEY_HOME, Key::home},
      std::pair{GLFW_KEY_END, Key::end},
      std::pair{GLFW_KEY_INSERT, Key::insert},
      std::pair{GLFW_KEY_DELETE, Key::erase},
      std::pair{GLFW_KEY_BACKSPACE, Key::backspace},
      std::pair{GLFW_KEY_SPACE, Key::space},
      std::pair{GLFW_KEY_ENTER, Key::enter},
      std::pair{GLFW_KEY_KP_ENTER, Key::enter},
      std::pair{GLFW_KEY_ESCAPE, Key::escape},
      std::pair{GLFW_KEY_A, Key::a},
      std::pair{GLFW_KEY_B, Key::b},
      std::pair{GLFW_KEY_C, Key::c},
      std::pair{GLFW_KEY_F, Key::f},
      std::pair{GLFW_KEY_H, Key::h},
      std::pair{GLFW_KEY_I, Key::i},
      std::pair{GLFW_KEY_M, Key::m},
      std::pair{GLFW_KEY_N, Key::n},
      std::pair{GLFW_KEY_O, Key::o},
      std::pair{GLFW_KEY_P, Key::p},
      std::pair{GLFW_KEY_Q, Key::q},
      std::pair{GLFW_KEY_R, Key::r},
      std::pair{GLFW_KEY_S, Key::s},
      std::pair{GLFW_KEY_T, Key::t},
      std::pair{GLFW_KEY_V, Key::v},
      std::pair{GLFW_KEY_W, Key::w},
      std::pair{GLFW_KEY_X, Key::x},
      std::pair{GLFW_KEY_Y, Key::y},
      std::pair{GLFW_KEY_Z, Key::z},
      std::pair{GLFW_KEY_1, Key::digit1},
      std::pair{GLFW_KEY_2, Key::digit2},
      std::pair{GLFW_KEY_3, Key::digit3},
      std::pair{GLFW_KEY_4, Key::digit4},
      std::pair{GLFW_KEY_5, Key::digit5},
      std::pair{GLFW_KEY_6, Key::digit6},
      std::pair{GLFW_KEY_7, Key::digit7},
      std::pair{GLFW_KEY_F1, Key::f1},
      std::pair{GLFW_KEY_F12, Key::f12},
  };
  const auto* found = std::ranges::find(kCodes, glfw_key, [](const auto& code) { return code.first; });
  return found == kCodes.end() ? Key::none : found->second;
}

ui::Modifiers modifiers_of(int glfw_mods) {
  return {.control = (glfw_mods & (GLFW_MOD_CONTROL | GLFW_MOD_SUPER)) != 0,
          .shift = (glfw_mods & GLFW_MOD_SHIFT) != 0,
          .alt = (glfw_mods & GLFW_MOD_ALT) != 0};
}

}  // namespace isorelax::window
