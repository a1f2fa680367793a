#pragma once

#include <span>
#include <string>
#include <string_view>

#include "ui/ui_state.h"

namespace isorelax::ui {

/// Small pictures drawn with lines, so that they are sharp at any scale.
enum class Icon : std::uint8_t {
  none,
  run,
  pause,
  step,
  reset,
  step_back,
  run_back,
  to_end,
  to_start,
  open,
  save,
  picture,
  undo,
  redo,
  frame,
  wire,
  help,
  close
};

enum class ButtonLook : std::uint8_t { plain, accent, quiet, pressed };

enum class ButtonAlign : std::uint8_t { center, left };

struct ButtonStyle {
  Icon icon = Icon::none;
  ButtonLook look = ButtonLook::plain;
  float width = 0;   ///< pixels; 0: as wide as its content
  float height = 0;  ///< pixels; 0: a control's height
  ButtonAlign align = ButtonAlign::center;
  bool enabled = true;
  bool stop = true;  ///< Tab stops at it
};

/// Notes where the widget just drawn is, under a name that tests and keyboard focus use.
void mark(const Ui& ui, std::string_view name);
/// The same for a rectangle that is no widget: no stop for the keyboard.
void mark_area(const Ui& ui, std::string_view name, const Rect& rect);

/// A button with an icon and a label (either may be missing); `name` is its identity. True when pressed.
bool button(const Ui& ui, std::string_view name, std::string_view label, const ButtonStyle& style = {});
/// The width that such a button takes when none is given, in pixels.
float button_width(const Ui& ui, std::string_view label, Icon icon);

/// Choices side by side, one of them pressed: one stop for Tab, left and right choose. The new choice, or -1.
/// Where a label would be cut, a combo box.
int segmented(const Ui& ui, std::string_view name, std::span<const std::string_view> labels, int chosen,
              float width);

/// Draws an icon of side `size` pixels around a centre.
void draw_icon(ImDrawList& draw, Icon icon, ImVec2 center, float size, ImU32 color);

/// Seconds that the pointer rests on a control before its tooltip appears.
inline constexpr float kTooltipDelay = 0.5F;

/// Small capitals over a group of controls, with a line above unless it is the first.
void heading(const Ui& ui, std::string_view text);
/// Begins a row: the label at the left, the next control takes the rest of the width.
void row_label(const Ui& ui, std::string_view label, std::string_view tip);
/// Explains the last item after the pointer rested on it; `keys` may be empty.
void tooltip(const Ui& ui, std::string_view text, std::string_view keys = {});
/// A slider over the rest of the row, its number beside it, where the handle does not cover it. True when
/// changed.
bool slider(const Ui& ui, std::string_view name, float& value, float low, float high, const char* format);
/// A combo box over labels; the new choice, or -1.
int combo(const Ui& ui, std::string_view name, std::span<const std::string_view> labels, int chosen);
struct MenuEntry {
  std::string label;
  bool enabled = true;
};
/// The same where not everything can be chosen at all times.
int menu(const Ui& ui, std::string_view name, std::span<const MenuEntry> entries, int chosen);
void text_in(ImFont* font, ImU32 color, std::string_view text);

/// A number or a few words beside their name, over the whole width. A click copies `exact`.
struct ValueRow {
  std::string_view name{};  ///< identity, and what a test finds
  std::string_view label{};
  std::string shown{};
  std::string exact{};  ///< with all digits; empty: as shown
  std::string_view tip{};
  ImU32 color = color::kText;
};
void value_row(const Ui& ui, const ValueRow& row);
/// What a figure in a table is called: the brief name where the other has no room.
void draw_figure_label(const Ui& ui, std::string_view label, std::string_view brief, std::string_view tip);
/// The number with four digits and with all of them, and a unit behind.
[[nodiscard]] ValueRow number_row(std::string_view name, std::string_view label, double value,
                                  std::string_view unit, std::string_view tip);
/// All digits that the number needs to be the same again.
[[nodiscard]] std::string exact_text(double value);
/// A button of small text, for strips of them.
bool small_button(const Ui& ui, std::string_view name, std::string_view label, const ButtonStyle& style = {});
/// A link: text that can be clicked.
bool link(const Ui& ui, std::string_view name, std::string_view label);
/// Text over as many lines as it takes.
void wrapped(ImFont* font, ImU32 color, std::string_view text);

/// A text with the place of a mistake underlined, and what is wrong below; `column` counts from 1.
void draw_mistake(const Ui& ui, const std::string& text, std::size_t column, const std::string& reason);

/// Width of a text in a font, in pixels.
[[nodiscard]] float text_width(const ImFont& font, std::string_view text);
/// The text, or as much of it as fits into a width with an ellipsis behind.
[[nodiscard]] std::string fitted(const ImFont& font, std::string_view text, float width);

/// "1 234 567": groups of three with thin gaps.
[[nodiscard]] std::string count_text(std::size_t count);
/// "1 triangle", "2 triangles".
[[nodiscard]] std::string counted(std::size_t count, std::string_view one, std::string_view more);
/// printf-like number text for one double.
[[nodiscard]] std::string number_text(const char* format, double value);

}  // namespace isorelax::ui
