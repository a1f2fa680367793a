#include "ui/input.h"

#include <algorithm>
#include <array>
#include <utility>

namespace isorelax::ui {
namespace {

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <typename... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

}  // namespace

// Pointer moves after a change of a button wait too: a press belongs to the place where it happened.
bool InputQueue::fits(const InputEvent& event) {
  return std::visit(Overloaded{[&](const PointerMoved&) { return changed_buttons_ == 0; },
                               [&](const ButtonChanged& e) {
                                 const unsigned bit = 1U << static_cast<unsigned>(e.button);
                                 if ((changed_buttons_ & bit) != 0) return false;
                                 changed_buttons_ |= bit;
                                 return true;
                               },
                               [](const WheelTurned&) { return true; },
                               [&](const KeyChanged& e) {
                                 if (std::ranges::find(changed_keys_, e.key) != changed_keys_.end())
                                   return false;
                                 changed_keys_.push_back(e.key);
                                 return true;
                               },
                               [](const TextTyped&) { return true; }},
                    event);
}

void InputQueue::apply(ImGuiIO& io, const InputEvent& event) {
  std::visit(Overloaded{[&](const PointerMoved& e) {
                          io.MousePos = {e.x, e.y};
                        },
                        [&](const ButtonChanged& e) { io.MouseDown[e.button] = e.down; },
                        [&](const WheelTurned& e) {
                          io.MouseWheelH += e.x;
                          io.MouseWheel += e.y;
                        },
                        [](const KeyChanged&) {},
                        [&](const TextTyped& e) { io.AddInputCharactersUTF8(e.utf8.c_str()); }},
             event);
}

void InputQueue::apply(ImGuiIO& io, const KeyChanged& event, bool hidden) {
  io.KeyCtrl = event.modifiers.control;
  io.KeyShift = event.modifiers.shift;
  io.KeyAlt = event.modifiers.alt;
  if (!hidden) io.KeysDown[static_cast<std::size_t>(event.key)] = event.down;
}

void map_keys(ImGuiIO& io) {
  constexpr std::array<std::pair<ImGuiKey, Key>, 22> kMap{{
      {ImGuiKey_Tab, Key::tab},
      {ImGuiKey_LeftArrow, Key::left},
      {ImGuiKey_RightArrow, Key::right},
      {ImGuiKey_UpArrow, Key::up},
      {ImGuiKey_DownArrow, Key::down},
      {ImGuiKey_PageUp, Key::page_up},
      {ImGuiKey_PageDown, Key::page_down},
      {ImGuiKey_Home, Key::home},
      {ImGuiKey_End, Key::end},
      {ImGuiKey_Insert, Key::insert},
      {ImGuiKey_Delete, Key::erase},
      {ImGuiKey_Backspace, Key::backspace},
      {ImGuiKey_Space, Key::space},
      {ImGuiKey_Enter, Key::enter},
      {ImGuiKey_Escape, Key::escape},
      {ImGuiKey_A, Key::a},
      {ImGuiKey_C, Key::c},
      {ImGuiKey_V, Key::v},
      {ImGuiKey_X, Key::x},
      {ImGuiKey_Y, Key::y},
      {ImGuiKey_Z, Key::z},
      {ImGuiKey_KeyPadEnter, Key::enter},
  }};
  for (const auto& [imgui, key] : kMap) io.KeyMap[imgui] = static_cast<int>(key);
}

}  // namespace isorelax::ui
