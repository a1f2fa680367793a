#pragma once

#include <span>
#include <string_view>

#include "ui/input.h"

namespace isorelax::ui {

/// What a key, a button or a menu entry asks for.
enum class Action : std::uint8_t {
  run_pause,
  step,
  step_back,
  reset,
  open,
  save,
  save_as,
  save_picture,
  undo,
  redo,
  quit,
  frame,
  wire,
  shading,
  next_worst,
  color_none,
  color_min_angle,
  color_max_angle,
  color_area,
  color_energy,
  hide_panels,
  help,
  copy_command_line,
  copy_view,
  paste_view,
  compare,
  to_start,
  to_end,
  play_forward,
  play_backward,
  next_stage,
  previous_stage,
  reasons,
  tab_quality,
  tab_inspect,
  tab_debug,
  tab_runs,
  pin,
  save_trace,
  task,
  turn_left,
  turn_right,
  turn_up,
  turn_down,
  pan_left,
  pan_right,
  pan_up,
  pan_down,
  zoom_in,
  zoom_out,
  view_front,
  view_back,
  view_left,
  view_right,
  view_top,
  view_bottom,
  view_iso,
};

struct Shortcut {
  Key key;
  Modifiers modifiers;
  Action action;
  std::string_view keys;  ///< as people write it: "Ctrl+Shift+S"
  std::string_view text;  ///< what it does; empty: told by the one before
  std::string_view group;
  std::string_view listed{};  ///< keys that the help page names instead, of several shortcuts
};

/// All shortcuts in the order of the help page.
[[nodiscard]] std::span<const Shortcut> shortcuts();
/// The shortcut of a key press; null when it has none.
[[nodiscard]] const Shortcut* find_shortcut(const KeyChanged& press);
/// The keys of an action as people write them; empty when it has none.
[[nodiscard]] std::string_view keys_of(Action action);

}  // namespace isorelax::ui
