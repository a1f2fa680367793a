#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "motion/expression_field.h"
#include "ui/motion_panel.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

void change_field(const Ui& ui, const FieldSpec& field) {
  MotionChoices motion = ui.session.motion;
  motion.field = field;
  // Motion along normals takes fixed steps.
  if (field.kind == FieldKind::normal) motion.tolerance.reset();
  change_motion(ui, motion, "Field");
}

void number_of_field(const Ui& ui, const char* name, std::string_view label, std::string_view tip,
                     double FieldSpec::*number, bool positive) {
  FieldSpec field = ui.session.motion.field;
  row_label(ui, label, tip);
  double value = field.*number;
  const bool changed = number_field(ui, name, value);
  tooltip(ui, tip);
  if (!changed || !std::isfinite(value) || (positive && !(value > 0))) return;
  field.*number = value;
  change_field(ui, field);
}

void vector_of_field(const Ui& ui, const char* name, std::string_view label, std::string_view tip,
                     Vec3 RigidMotion::*vector) {
  FieldSpec field = ui.session.motion.field;
  row_label(ui, label, tip);
  const std::string id = "##" + std::string(name);
  Vec3 value = field.rigid.*vector;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemInnerSpacing, {ui.px(4), 0});
  const bool changed =
      ImGui::InputScalarN(id.c_str(), ImGuiDataType_Double, value.data(), 3, nullptr, nullptr, "%.4g");
  ImGui::PopStyleVar();
  end_motion_edit(ui);
  mark(ui, name);
  tooltip(ui, tip);
  if (!changed || !value.allFinite()) return;
  field.rigid.*vector = value;
  change_field(ui, field);
}

// What is wrong with an expression, and where; nothing below one that can be read.
void draw_expression_mistake(const Ui& ui, const std::string& name, const std::string& text) {
  std::size_t column = 1;
  std::string reason = "expected an expression in x, y, z and t";
  if (!text.empty()) {
    try {
      const Expression sound(text);
      return;
    } catch (const ExpressionError& error) {
      column = error.column();
      reason = error.reason();
    }
  }
  ImGui::Dummy({0, 0});
  ImGui::SameLine(ui.px(104));
  ImGui::BeginGroup();
  draw_mistake(ui, text, column, reason);
  ImGui::EndGroup();
  mark_area(ui, name + "-mistake", {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
}

bool expression_field(const Ui& ui, const char* name, std::string_view label, std::string& text) {
  constexpr const char* kTip =
      "An expression in x, y, z and t: + - * / ^, sin, cos, exp, sqrt, abs, min, max, ?: and pi. Length "
      "units "
      "over time units.";
  row_label(ui, label, kTip);
  const std::string id = "##" + std::string(name);
  const bool changed = ImGui::InputText(id.c_str(), &text);
  end_motion_edit(ui);
  mark(ui, name);
  tooltip(ui, kTip);
  draw_expression_mistake(ui, name, text);
  std::erase(text, ';');  // it separates the three of them
  return changed;
}

void draw_expressions(const Ui& ui) {
  constexpr std::array kNames{"field-u", "field-v", "field-w"};
  constexpr std::array<std::string_view, 3> kLabels{"Along x", "Along y", "Along z"};
  FieldSpec field = ui.session.motion.field;
  bool changed = false;
  for (std::size_t k = 0; k < 3; ++k)
    changed = expression_field(ui, kNames[k], kLabels[k], field.expressions[k]) || changed;
  if (changed) change_field(ui, field);
}

}  // namespace

void draw_motion_field(const Ui& ui) {
  constexpr const char* kTip =
      "What moves the surface: the paper's Eq. (10), which comes back after its period; the deformation of "
      "LeVeque "
      "and Enright; a rigid motion; a shear; a speed along the normal; three expressions; a sampled file.";
  std::array<std::string_view, 7> labels;
  for (std::size_t k = 0; k < labels.size(); ++k) labels[k] = model::title(static_cast<FieldKind>(k));
  FieldSpec field = ui.session.motion.field;
  row_label(ui, "Field", kTip);
  const int choice = combo(ui, "field", labels, static_cast<int>(field.kind));
  tooltip(ui, kTip);
  if (choice == static_cast<int>(FieldKind::file) && field.path.empty()) {
    ask_for_file(ui, FilePurpose::field);
  } else if (choice >= 0) {
    field.kind = static_cast<FieldKind>(choice);
    change_field(ui, field);
    return;
  }
  switch (field.kind) {
    case FieldKind::paper:
    case FieldKind::enright:
      number_of_field(ui, "field-period", "Period",
                      "Time after which everything is back where it was; the motion reverses at half of it.",
                      &FieldSpec::period, true);
      break;
    case FieldKind::rigid:
      vector_of_field(ui, "field-rotation", "Turning",
                      "Angular velocity about x, y and z, radians over time.", &RigidMotion::rotation);
      vector_of_field(ui, "field-centre", "About", "A point of the axis, in the units of the file.",
                      &RigidMotion::centre);
      vector_of_field(ui, "field-velocity", "Going", "Velocity along x, y and z, length units over time.",
                      &RigidMotion::velocity);
      break;
    case FieldKind::shear:
      number_of_field(ui, "field-rate", "Rate", "The velocity is this rate times y, along x; one over time.",
                      &FieldSpec::rate, false);
      break;
    case FieldKind::normal:
      if (expression_field(ui, "field-speed", "Speed", field.speed)) change_field(ui, field);
      break;
    case FieldKind::expressions:
      draw_expressions(ui);
      break;
    case FieldKind::file:
      row_label(ui, "File", "A velocity sampled on a grid: VTK legacy text, STRUCTURED_POINTS with VECTORS.");
      if (button(ui, "field-file", std::filesystem::path(field.path).filename().string(),
                 {.width = ImGui::GetContentRegionAvail().x}))
        ask_for_file(ui, FilePurpose::field);
      tooltip(ui, field.path);
      break;
  }
}

}  // namespace isorelax::ui
