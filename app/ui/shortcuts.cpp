#include "ui/shortcuts.h"

#include <algorithm>
#include <array>

namespace isorelax::ui {
namespace {

constexpr Modifiers kPlain{};
constexpr Modifiers kControl{.control = true};
constexpr Modifiers kShift{.shift = true};
constexpr Modifiers kControlShift{.control = true, .shift = true};

constexpr std::string_view kSmoothing = "Smoothing and moving";
constexpr std::string_view kInspect = "Inspect";
constexpr std::string_view kView = "View";
constexpr std::string_view kFile = "File and edit";

constexpr std::array kShortcuts{
    Shortcut{Key::space, kPlain, Action::run_pause, "Space", "Run or pause", kSmoothing},
    Shortcut{Key::m, kPlain, Action::task, "M", "Smooth or move", kSmoothing},
    Shortcut{Key::right, kPlain, Action::step, "Right", "One iteration, or time step, on", kSmoothing},
    Shortcut{Key::left, kPlain, Action::step_back, "Left", "One back", kSmoothing},
    Shortcut{Key::right, kShift, Action::next_stage, "Shift+Right", "To the next stage of the step",
             kSmoothing},
    Shortcut{Key::left, kShift, Action::previous_stage, "Shift+Left", "To the stage before", kSmoothing},
    Shortcut{Key::home, kPlain, Action::to_start, "Home", "To the mesh as opened", kSmoothing},
    Shortcut{Key::end, kPlain, Action::to_end, "End", "To the last iteration", kSmoothing},
    Shortcut{Key::p, kPlain, Action::play_forward, "P", "Play or halt the timeline", kSmoothing},
    Shortcut{Key::p, kShift, Action::play_backward, "Shift+P", "Play it backwards", kSmoothing},
    Shortcut{Key::n, kPlain, Action::next_worst, "N", "Fly to the next worst triangle", kInspect},
    Shortcut{Key::r, kPlain, Action::reasons, "R", "Colour by what limited the vertices", kInspect},
    Shortcut{Key::x, kPlain, Action::pin, "X", "Pin or unpin the selected vertex", kInspect},
    Shortcut{Key::q, kPlain, Action::tab_quality, "Q", "Quality", kInspect},
    Shortcut{Key::i, kPlain, Action::tab_inspect, "I", "Inspector", kInspect},
    Shortcut{Key::b, kPlain, Action::tab_debug, "B", "Reasons and breakpoints", kInspect},
    Shortcut{Key::t, kPlain, Action::tab_runs, "T", "Runs and traces", kInspect},
    Shortcut{Key::c, kControlShift, Action::copy_command_line, "Ctrl+Shift+C", "Copy as command line",
             kSmoothing},
    Shortcut{Key::digit1, kPlain, Action::color_min_angle, "1", "Colour by smallest angle", kView},
    Shortcut{Key::digit2, kPlain, Action::color_max_angle, "2", "Colour by largest angle", kView},
    Shortcut{Key::digit3, kPlain, Action::color_area, "3", "Colour by area", kView},
    Shortcut{Key::digit4, kPlain, Action::color_energy, "4", "Colour by energy", kView},
    Shortcut{Key::digit5, kPlain, Action::color_none, "5", "No colours", kView},
    Shortcut{Key::f, kPlain, Action::frame, "F", "Frame the mesh", kView},
    Shortcut{Key::left, kControl, Action::turn_left, "Ctrl+Left", "Orbit", kView, "Ctrl+Arrows"},
    Shortcut{Key::right, kControl, Action::turn_right, "Ctrl+Right", "", kView},
    Shortcut{Key::up, kControl, Action::turn_up, "Ctrl+Up", "", kView},
    Shortcut{Key::down, kControl, Action::turn_down, "Ctrl+Down", "", kView},
    Shortcut{Key::left, kControlShift, Action::pan_left, "Ctrl+Shift+Left", "Pan", kView, "Ctrl+Shift+Arr."},
    Shortcut{Key::right, kControlShift, Action::pan_right, "Ctrl+Shift+Right", "", kView},
    Shortcut{Key::up, kControlShift, Action::pan_up, "Ctrl+Shift+Up", "", kView},
    Shortcut{Key::down, kControlShift, Action::pan_down, "Ctrl+Shift+Down", "", kView},
    Shortcut{Key::page_up, kPlain, Action::zoom_in, "PageUp", "Zoom in", kView},
    Shortcut{Key::page_down, kPlain, Action::zoom_out, "PageDown", "Zoom out", kView},
    Shortcut{Key::digit1, kControl, Action::view_front, "Ctrl+1", "From the front, the back,", kView,
             "Ctrl+1, 2"},
    Shortcut{Key::digit2, kControl, Action::view_back, "Ctrl+2", "", kView},
    Shortcut{Key::digit3, kControl, Action::view_left, "Ctrl+3", "the left, the right,", kView, "Ctrl+3, 4"},
    Shortcut{Key::digit4, kControl, Action::view_right, "Ctrl+4", "", kView},
    Shortcut{Key::digit5, kControl, Action::view_top, "Ctrl+5", "above, below,", kView, "Ctrl+5, 6"},
    Shortcut{Key::digit6, kControl, Action::view_bottom, "Ctrl+6", "", kView},
    Shortcut{Key::digit7, kControl, Action::view_iso, "Ctrl+7", "or isometrically", kView},
    Shortcut{Key::w, kPlain, Action::wire, "W", "Show or hide the edges", kView},
    Shortcut{Key::s, kPlain, Action::shading, "S", "Flat or smooth shading", kView},
    Shortcut{Key::c, kPlain, Action::compare, "C", "Compare: the next way", kView},
    Shortcut{Key::c, kControl, Action::copy_view, "Ctrl+C", "Copy the view as text", kView},
    Shortcut{Key::v, kControl, Action::paste_view, "Ctrl+V", "Paste a view", kView},
    Shortcut{Key::h, kPlain, Action::hide_panels, "H", "Hide or show the panels", kView},
    Shortcut{Key::o, kControl, Action::open, "Ctrl+O", "Open a mesh", kFile},
    Shortcut{Key::s, kControl, Action::save, "Ctrl+S", "Save the mesh", kFile},
    Shortcut{Key::s, kControlShift, Action::save_as, "Ctrl+Shift+S", "Save under another name", kFile},
    Shortcut{Key::t, kControl, Action::save_trace, "Ctrl+T", "Save the run as a trace", kFile},
    Shortcut{Key::f12, kPlain, Action::save_picture, "F12", "Save a picture", kFile},
    Shortcut{Key::p, kControl, Action::save_picture, "Ctrl+P", "Save a picture", kFile},
    Shortcut{Key::z, kControl, Action::undo, "Ctrl+Z", "Undo", kFile},
    Shortcut{Key::z, kControlShift, Action::redo, "Ctrl+Shift+Z", "Redo", kFile},
    Shortcut{Key::q, kControl, Action::quit, "Ctrl+Q", "Quit", kFile},
    Shortcut{Key::question, kPlain, Action::help, "?", "This page", kFile},
    Shortcut{Key::f1, kPlain, Action::help, "F1", "This page", kFile},
};

}  // namespace

std::span<const Shortcut> shortcuts() {
  return kShortcuts;
}

const Shortcut* find_shortcut(const KeyChanged& press) {
  Modifiers modifiers = press.modifiers;
  if (press.key == Key::question) modifiers.shift = false;  // part of typing it on many keyboards
  const auto* found = std::ranges::find_if(
      kShortcuts, [&](const Shortcut& s) { return s.key == press.key && s.modifiers == modifiers; });
  return found == kShortcuts.end() ? nullptr : found;
}

std::string_view keys_of(Action action) {
  const auto* found = std::ranges::find(kShortcuts, action, &Shortcut::action);
  return found == kShortcuts.end() ? std::string_view{} : found->keys;
}

}  // namespace isorelax::ui
