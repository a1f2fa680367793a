#pragma once

#include <imgui.h>

#include <cstdint>
#include <deque>
#include <string>
#include <variant>
#include <vector>

namespace isorelax::ui {

/// The keys that the editor knows. A window maps its library's codes to these.
enum class Key : std::uint8_t {
  none,
  tab,
  left,
  right,
  up,
  down,
  page_up,
  page_down,
  home,
  end,
  insert,
  erase,
  backspace,
  space,
  enter,
  escape,
  a,
  b,
  c,
  f,
  h,
  i,
  m,
  n,
  o,
  p,
  q,
  r,
  s,
  t,
  v,
  w,
  x,
  y,
  z,
  digit1,
  digit2,
  digit3,
  digit4,
  digit5,
  digit6,
  digit7,
  question,
  f1,
  f12,
  count
};

struct Modifiers {
  bool control = false;
  bool shift = false;
  bool alt = false;
  bool operator==(const Modifiers&) const = default;
};

struct PointerMoved {
  float x = 0, y = 0;  ///< pixels, y downwards
};
struct ButtonChanged {
  int button = 0;  ///< 0 left, 1 right, 2 middle
  bool down = false;
};
struct WheelTurned {
  float x = 0, y = 0;
};
struct KeyChanged {
  Key key = Key::none;
  bool down = false;
  Modifiers modifiers;
};
struct TextTyped {
  std::string utf8;
};
using InputEvent = std::variant<PointerMoved, ButtonChanged, WheelTurned, KeyChanged, TextTyped>;

/// Turns events into what one frame of the interface sees. Dear ImGui 1.86 reads the present state of keys
/// and buttons: a click that begins and ends within one frame would be lost, so each change of a key or
/// button that reverses an earlier one waits for the next frame.
class InputQueue {
 public:
  void push(InputEvent event) { events_.push_back(std::move(event)); }
  [[nodiscard]] bool empty() const { return events_.empty(); }
  /// Writes this frame's input to `io` and returns the keys that went down in it. `captured(key)` says which
  /// keys are kept from Dear ImGui because they are shortcuts now.
  template <typename Captured>
  std::vector<KeyChanged> next_frame(ImGuiIO& io, const Captured& captured) {
    std::vector<KeyChanged> pressed;
    changed_keys_.clear();
    changed_buttons_ = 0;
    while (!events_.empty() && fits(events_.front())) {
      if (const auto* key = std::get_if<KeyChanged>(&events_.front())) {
        if (key->down) pressed.push_back(*key);
        apply(io, *key, key->down && captured(*key));
      } else {
        apply(io, events_.front());
      }
      events_.pop_front();
    }
    return pressed;
  }

 private:
  [[nodiscard]] bool fits(const InputEvent& event);
  static void apply(ImGuiIO& io, const InputEvent& event);
  static void apply(ImGuiIO& io, const KeyChanged& event, bool hidden);

  std::deque<InputEvent> events_;
  std::vector<Key> changed_keys_;
  unsigned changed_buttons_ = 0;
};

/// Tells the current context which of its keys are ours. Once per context.
void map_keys(ImGuiIO& io);

}  // namespace isorelax::ui
