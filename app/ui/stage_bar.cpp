#include <algorithm>
#include <array>
#include <cmath>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

using model::Stage;
using model::StageKind;

constexpr float kRoomForButtons = 596;  // right edge from which on they fit, in points

struct StageButton {
  std::string label;
  std::string_view tip;
  Stage stage;
  bool on = false;
  bool enabled = true;
};

// The record of the shown step with its rounds; null while nobody has looked inside it.
const StepRecord* record_of(const model::Session& s) {
  const auto& view = s.inspection.step;
  const model::Cursor& cursor = s.timeline.cursor;
  const bool known = view && view->record->detail && view->at.branch == cursor.branch &&
                     view->at.iteration == cursor.iteration;
  return known ? view->record.get() : nullptr;
}

// Which round of its kind a pass is, and how many there are.
std::string round_label(const model::StepSummary* step, const model::Session& s, Limit why,
                        std::string_view name, std::optional<Stage>& first) {
  const unsigned total = step == nullptr ? 0 : why == kLimitFold ? step->fold_passes : step->energy_passes;
  unsigned at = 0;
  if (const StepRecord* record = record_of(s)) {
    unsigned seen = 0;
    const auto& passes = record->detail->passes;
    for (unsigned k = 0; k < passes.size(); ++k) {
      if ((passes[k].why == kLimitEnergy) != (why == kLimitEnergy)) continue;
      ++seen;
      if (!first) first = Stage{StageKind::control, k};
      if (s.timeline.cursor.stage == Stage{StageKind::control, k}) at = seen;
    }
  } else if (total > 0) {
    // Which round that is is only known with the record: looking at any brings it (find_guard).
    first = Stage{StageKind::control, 0};
  }
  if (total == 0) return std::string(name);
  return std::string(name) + " " + (at > 0 ? std::to_string(at) + "/" : "") + std::to_string(total);
}

std::vector<StageButton> stage_buttons(const model::Session& s) {
  const auto& chosen = s.timeline.cursor.stage;
  const model::StepSummary* step = s.timeline.step(s.timeline.cursor.branch, s.timeline.cursor.iteration);
  const auto plain = [&](std::string label, std::string_view tip, StageKind kind) {
    return StageButton{std::move(label), tip, Stage{kind}, chosen == Stage{kind}};
  };
  std::vector<StageButton> buttons{
      plain("Gradient", "Downhill: minus the gradient of the energy. Lengths compare with each other only.",
            StageKind::gradient),
      plain("Tangent", "What of it lies in the tangent plane, or along the ridge.", StageKind::tangent),
      plain("Proposed", "The move that the solver makes of it.", StageKind::proposed)};
  for (const Limit why : {kLimitFold, kLimitEnergy}) {
    std::optional<Stage> first;
    std::string label = round_label(step, s, why, why == kLimitFold ? "Control" : "Guard", first);
    const bool on = label.find('/') != std::string::npos;
    buttons.push_back(
        {std::move(label),
         why == kLimitFold
             ? "Rounds of the step control: what folds, or goes too far from the surface, is cut back."
             : "Rounds of the energy guard: where the energy rose is cut back.",
         first.value_or(Stage{}), on, first.has_value()});
  }
  buttons.push_back(plain("Moved", "The move that was made.", StageKind::moved));
  return buttons;
}

// Goes on from the round that brought the record to the first one of the guard.
void find_guard(const Ui& ui) {
  const model::Session& s = ui.session;
  if (s.timeline.cursor.stage != Stage{StageKind::control, 0}) ui.state.seeks_guard = false;
  const StepRecord* record = record_of(s);
  if (!ui.state.seeks_guard || record == nullptr) return;
  ui.state.seeks_guard = false;
  const auto& passes = record->detail->passes;
  const auto found = std::ranges::find(passes, kLimitEnergy, &ControlPass::why);
  if (found != passes.end())
    ui.command(model::SetStage{Stage{StageKind::control, static_cast<unsigned>(found - passes.begin())}});
}

void choose_stage(const Ui& ui, const StageButton& b) {
  ui.command(model::SetStage{b.on ? std::nullopt : std::optional(b.stage)});
  ui.state.seeks_guard = !b.on && b.label.starts_with("Guard") && record_of(ui.session) == nullptr;
}

void draw_stage_buttons(const Ui& ui, float right) {
  constexpr std::array<float, 6> kWidths{58, 56, 62, 74, 62, 50};
  const auto buttons = stage_buttons(ui.session);
  float width = 0;
  for (const float w : kWidths) width += ui.px(w);
  ImGui::SameLine(std::max(ImGui::GetCursorPosX(), right - width), 0);
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + width, low.y + ui.px(26)}, color::kControl,
                                            ImGui::GetStyle().FrameRounding);
  for (std::size_t k = 0; k < buttons.size(); ++k) {
    const StageButton& b = buttons[k];
    if (k > 0) ImGui::SameLine(0, 0);
    const std::string name = "stage/" + b.label.substr(0, b.label.find(' '));
    if (small_button(ui, name, b.label,
                     {.look = b.on ? ButtonLook::pressed : ButtonLook::quiet,
                      .width = ui.px(kWidths.at(k)),
                      .height = ui.px(26),
                      .enabled = b.enabled && !ui.session.is_running()}))
      choose_stage(ui, b);
    tooltip(ui, b.enabled ? b.tip : "Nothing was cut back in this step.", keys_of(Action::next_stage));
  }
}

// The same where there is no room for buttons.
void draw_stage_menu(const Ui& ui, float right) {
  ImGui::SameLine(0, ui.px(8));
  const float width = right - ImGui::GetCursorPosX();
  if (width < ui.px(60)) return;
  const auto buttons = stage_buttons(ui.session);
  const auto chosen = std::ranges::find(buttons, true, &StageButton::on);
  ImGui::PushFont(ui.fonts.small);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                      {ui.px(8), std::floor(0.5F * (ui.px(26) - ui.fonts.small->FontSize))});
  ImGui::BeginDisabled(ui.session.is_running());
  std::vector<MenuEntry> entries{{"Whole step"}};
  for (const StageButton& b : buttons) entries.push_back({b.label, b.enabled});
  const int at = chosen == buttons.end() ? 0 : static_cast<int>(chosen - buttons.begin()) + 1;
  ImGui::SetNextItemWidth(width);
  const int choice = menu(ui, "stage", entries, at);
  ImGui::EndDisabled();
  ImGui::PopStyleVar();
  ImGui::PopFont();
  tooltip(ui, "A stage of the step.", keys_of(Action::next_stage));
  if (choice == 0)
    ui.command(model::SetStage{});
  else if (choice > 0 && choice != at)
    choose_stage(ui, buttons[static_cast<std::size_t>(choice) - 1]);
}

}  // namespace

void draw_stages(const Ui& ui, float right) {
  find_guard(ui);
  if (right > ui.px(kRoomForButtons))
    draw_stage_buttons(ui, right);
  else
    draw_stage_menu(ui, right);
}

}  // namespace isorelax::ui
