#include "ui/motion_panel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

constexpr std::array<std::string_view, 5> kPresets{"none", "paper", "accuracy", "balanced", "angles"};

void draw_spheres(const Ui& ui) {
  constexpr std::array<std::size_t, 3> kCounts{1500, 5832, 24000};
  constexpr const char* kTip =
      "Opens the sphere of the paper's second experiment, radius 0.15 about (0.5, 0.75, 0.5), with so many "
      "vertices. Any other mesh moves as well.";
  row_label(ui, "Sphere", kTip);
  const float gap = ui.px(6);
  const float each = std::floor((ImGui::GetContentRegionAvail().x - 2 * gap) / 3);
  // A narrow panel has smaller letters rather than the beginnings of numbers.
  ImGui::PushFont(each < ui.px(54) ? ui.fonts.small : ui.fonts.text);
  for (std::size_t k = 0; k < kCounts.size(); ++k) {
    if (k > 0) ImGui::SameLine(0, gap);
    const bool open = ui.session.document && ui.session.document->sphere &&
                      ui.session.document->sphere->vertices == kCounts[k];
    if (button(ui, "sphere/" + std::to_string(kCounts[k]), std::to_string(kCounts[k]),
               {.look = open ? ButtonLook::pressed : ButtonLook::plain, .width = each})) {
      SphereStart sphere;
      sphere.vertices = kCounts[k];
      open_sphere(ui, sphere);
    }
    tooltip(ui, kTip);
  }
  ImGui::PopFont();
}

void draw_time(const Ui& ui) {
  MotionChoices motion = ui.session.motion;
  constexpr const char* kEndTip =
      "Time at which the motion ends, in the time units of the field. Default: the field's period, else 1.";
  constexpr const char* kStepTip =
      "Length of a time step, in the time units of the field; of the first one where errors choose the "
      "others.";
  row_label(ui, "End, step", "Time at which the motion ends, and the length of a time step.");
  const float gap = ui.px(6);
  const float half = std::floor(0.5F * (ImGui::GetContentRegionAvail().x - gap));
  ImGui::SetNextItemWidth(half);
  double end = end_time(motion);
  if (number_field(ui, "until", end) && end > 0 && std::isfinite(end)) {
    motion.until.reset();
    if (end != end_time(motion)) motion.until = end;
    change_motion(ui, motion, "End");
  }
  tooltip(ui, kEndTip);
  ImGui::SameLine(0, gap);
  ImGui::SetNextItemWidth(half);
  double step = motion.step;
  if (number_field(ui, "time-step", step) && step > 0 && std::isfinite(step)) {
    motion.step = step;
    change_motion(ui, motion, "Time step");
  }
  tooltip(ui, kStepTip);
  if (motion.field.kind == FieldKind::normal) return;
  constexpr std::array<std::string_view, 4> kLabels{"Fixed", "1e-4", "1e-6", "1e-8"};
  constexpr std::array kTolerances{0.0, 1e-4, 1e-6, 1e-8};
  constexpr const char* kErrorTip =
      "Fixed steps, or steps chosen such that the estimated error of each stays below this share of the "
      "start's "
      "bounding-box diagonal.";
  row_label(ui, "Step error", kErrorTip);
  int chosen = -1;
  for (int k = 0; k < 4; ++k)
    if (motion.tolerance.value_or(0) == kTolerances[static_cast<std::size_t>(k)]) chosen = k;
  const int choice = segmented(ui, "step-error", kLabels, chosen, ImGui::GetContentRegionAvail().x);
  tooltip(ui, kErrorTip);
  if (choice < 0) return;
  motion.tolerance.reset();
  if (choice > 0) motion.tolerance = kTolerances[static_cast<std::size_t>(choice)];
  change_motion(ui, motion, "Step error");
}

Redistribution redistribution_of(const MotionChoices& motion) {
  return motion.redistribute.value_or(motion_preset(motion.preset).redistribution);
}

constexpr std::string_view kEdge = "equilateral:";

// Options of another way to redistribute would be refused.
void drop_what_does_not_fit(MotionChoices& motion) {
  const Redistribution way = redistribution_of(motion);
  if (way != Redistribution::tangent) motion.solver.reset(), motion.mu.reset();
  if (way != Redistribution::carrier) motion.keep_volume.reset();
  if (way == Redistribution::carrier && motion.reference.starts_with(kEdge)) motion.reference = "equilateral";
}

void draw_preset(const Ui& ui) {
  constexpr std::array<std::string_view, 5> kLabels{"None", "Paper's", "Accuracy", "Balanced", "Angles"};
  constexpr const char* kTip =
      "None: vertices go with the flow. Paper's: as printed, face offsetting and a Jacobi step in tangent "
      "planes. "
      "Accuracy, Balanced, Angles: on the surface that the motion makes of the start, with less and less "
      "weight "
      "on its finest parts.";
  MotionChoices motion = ui.session.motion;
  row_label(ui, "Preset", kTip);
  const auto found = std::ranges::find(kPresets, motion.preset);
  const int choice = combo(ui, "preset", kLabels, static_cast<int>(found - kPresets.begin()));
  tooltip(ui, kTip);
  if (choice < 0) return;
  motion.preset = kPresets.at(static_cast<std::size_t>(choice));
  motion.redistribute.reset();
  motion.method.reset();
  motion.iterations.reset();
  drop_what_does_not_fit(motion);
  change_motion(ui, motion, "Preset");
}

void draw_motion_reference(const Ui& ui) {
  constexpr std::array<std::string_view, 4> kLabels{"Mesh at the start", "Equilateral, mean area",
                                                    "Another file", "Equilateral, edge length"};
  constexpr const char* kTip =
      "What triangles ought to look like: as in the mesh in which the motion begins, equilateral, or as in a "
      "file "
      "with the same vertices.";
  MotionChoices motion = ui.session.motion;
  const bool edge = motion.reference.starts_with(kEdge);
  const int present = motion.reference == "initial"       ? 0
                      : motion.reference == "equilateral" ? 1
                      : edge                              ? 3
                                                          : 2;
  row_label(ui, "Reference", kTip);
  // Carrier moves scale references to the mesh's area.
  const std::size_t count = redistribution_of(motion) == Redistribution::carrier ? 3 : 4;
  const int choice = combo(ui, "motion-reference", std::span(kLabels).first(count), present);
  tooltip(ui, kTip);
  if (choice == 2) {
    ask_for_file(ui, FilePurpose::motion_reference);
  } else if (choice >= 0 && choice != present) {
    motion.reference = choice == 0 ? "initial" : choice == 1 ? "equilateral" : "equilateral:0.01";
    change_motion(ui, motion, "Reference");
  }
  if (edge) {
    row_label(ui, "Edge length", "Edge length of the reference triangles, in the units of the file.");
    double length = std::strtod(motion.reference.c_str() + kEdge.size(), nullptr);
    if (number_field(ui, "motion-edge", length) && length > 0 && std::isfinite(length)) {
      motion.reference = std::string(kEdge) + exact_text(length);
      change_motion(ui, motion, "Edge length");
    }
  } else if (present == 2) {
    row_label(ui, "File", "A mesh with the same vertices; its positions give the reference.");
    if (button(ui, "motion-reference-file", std::filesystem::path(motion.reference).filename().string(),
               {.width = ImGui::GetContentRegionAvail().x}))
      ask_for_file(ui, FilePurpose::motion_reference);
  }
}

void draw_when(const Ui& ui) {
  MotionChoices motion = ui.session.motion;
  constexpr const char* kEveryTip = "Vertices are redistributed after every step, every second, every k-th.";
  row_label(ui, "After every", kEveryTip);
  int every = static_cast<int>(motion.every);
  if (ImGui::InputScalar("##every", ImGuiDataType_S32, &every) && every > 0) {
    motion.every = static_cast<unsigned>(every);
    change_motion(ui, motion, "Every");
  }
  end_motion_edit(ui);
  mark(ui, "every");
  tooltip(ui, kEveryTip);
  constexpr const char* kBelowTip =
      "Only about triangles with an angle under this many degrees; at 0 everywhere.";
  row_label(ui, "Only below", kBelowTip);
  auto below = static_cast<float>(motion.only_below_deg);
  const char* format = below > 0 ? "%.0f\xC2\xB0" : "everywhere";
  if (ImGui::SliderFloat("##only-below", &below, 0, 60, format, ImGuiSliderFlags_AlwaysClamp)) {
    motion.only_below_deg = std::round(static_cast<double>(below));
    change_motion(ui, motion, "Only below");
  }
  end_motion_edit(ui);
  mark(ui, "only-below");
  tooltip(ui, kBelowTip);
}

// One of the preset's ways, or another: the first label is the preset's.
template <typename Value, std::size_t N>
bool choose_way(const Ui& ui, const char* name, std::string_view label, std::string_view tip,
                const std::array<std::string_view, N>& titles, Value usual, std::optional<Value>& value) {
  const std::string first = "Preset's: " + std::string(titles.at(static_cast<std::size_t>(usual)));
  std::array<std::string_view, N + 1> labels;
  labels[0] = first;
  std::ranges::copy(titles, labels.begin() + 1);
  row_label(ui, label, tip);
  const int choice = combo(ui, name, labels, value ? static_cast<int>(*value) + 1 : 0);
  tooltip(ui, tip);
  if (choice < 0) return false;
  value.reset();
  if (choice > 0) value = static_cast<Value>(choice - 1);
  return true;
}

void draw_tangent_moves(const Ui& ui, MotionChoices& motion) {
  constexpr std::array<std::string_view, 4> kSolvers{"Automatic", "Jacobi", "Newton", "L-BFGS"};
  constexpr const char* kSolverTip = "How tangent moves are found.";
  row_label(ui, "Solver", kSolverTip);
  const auto usual = motion_preset(motion.preset).solver;
  const int solver = combo(ui, "motion-solver", kSolvers, static_cast<int>(motion.solver.value_or(usual)));
  tooltip(ui, kSolverTip);
  if (solver >= 0) {
    motion.solver = static_cast<Solver>(solver);
    change_motion(ui, motion, "Solver");
  }
  constexpr const char* kMuTip = "Of tangent moves: weight of areas against angles, 0 to 1.";
  row_label(ui, "Area \xCE\xBC\xE2\x82\x90", kMuTip);
  auto mu = static_cast<float>(motion.mu.value_or(0.5));
  if (slider(ui, "motion-mu", mu, 0, 1, "%.2f")) {
    motion.mu = std::round(100.0 * static_cast<double>(mu)) / 100;
    change_motion(ui, motion, "\xCE\xBC\xE2\x82\x90");
  }
  end_motion_edit(ui);
  mark(ui, "motion-mu");
  tooltip(ui, kMuTip);
}

void draw_volume(const Ui& ui, MotionChoices& motion) {
  constexpr std::array<std::string_view, 2> kRules{"Keep", "Free"};
  constexpr const char* kTip =
      "Keep: the mesh gets the volume that the motion leaves the start's, by moves along normals. Free: "
      "vertices "
      "stay on the surface.";
  row_label(ui, "Volume", kTip);
  const int choice = segmented(ui, "volume", kRules, motion.keep_volume.value_or(true) ? 0 : 1,
                               ImGui::GetContentRegionAvail().x);
  tooltip(ui, kTip);
  if (choice < 0) return;
  motion.keep_volume.reset();
  if (choice == 1) motion.keep_volume = false;
  change_motion(ui, motion, "Volume");
}

void draw_details(const Ui& ui) {
  constexpr std::array<std::string_view, 3> kMoves{"none", "tangent", "carrier"};
  constexpr std::array<std::string_view, 2> kMethods{"Runge-Kutta", "offset faces"};
  MotionChoices motion = ui.session.motion;
  const MovingSurfaceOptions preset = motion_preset(motion.preset);
  if (choose_way(ui, "moves", "Moves",
                 "How vertices are redistributed: not at all; in tangent planes of the mesh itself, which "
                 "drifts; or "
                 "on the surface that the motion makes of the start mesh, the carrier.",
                 kMoves, preset.redistribution, motion.redistribute)) {
    drop_what_does_not_fit(motion);
    change_motion(ui, motion, "Moves");
  }
  if (motion.field.kind != FieldKind::normal &&
      choose_way(ui, "method", "Method",
                 "Runge-Kutta: every vertex goes with the flow. Face offsetting: faces do, and vertices are "
                 "where they "
                 "meet.",
                 kMethods, preset.integration, motion.method))
    change_motion(ui, motion, "Method");
  const Redistribution way = redistribution_of(motion);
  if (way == Redistribution::none) return;
  constexpr const char* kTip = "Moves after each step.";
  row_label(ui, "Iterations", kTip);
  const bool tangent = way == Redistribution::tangent;
  int iterations =
      static_cast<int>(motion.iterations.value_or(tangent ? preset.iterations : preset.carrier.iterations));
  if (ImGui::InputScalar("##motion-iterations", ImGuiDataType_S32, &iterations) && iterations > 0) {
    motion.iterations = static_cast<unsigned>(iterations);
    change_motion(ui, motion, "Iterations");
  }
  end_motion_edit(ui);
  mark(ui, "motion-iterations");
  tooltip(ui, kTip);
  if (tangent)
    draw_tangent_moves(ui, motion);
  else
    draw_volume(ui, motion);
}

}  // namespace

void change_motion(const Ui& ui, const MotionChoices& motion, std::string label) {
  ui.command(model::SetMotion{motion, std::move(label)});
}

void end_motion_edit(const Ui& ui) {
  if (ImGui::IsItemDeactivated()) ui.command(model::EndEdit{});
}

bool number_field(const Ui& ui, const char* name, double& value) {
  const std::string id = "##" + std::string(name);
  const bool changed = ImGui::InputDouble(id.c_str(), &value, 0, 0, "%.6g");
  end_motion_edit(ui);
  mark(ui, name);
  return changed;
}

void draw_motion_settings(const Ui& ui) {
  draw_spheres(ui);
  ImGui::BeginDisabled(ui.session.is_running());
  draw_motion_field(ui);
  draw_time(ui);
  heading(ui, "REDISTRIBUTION");
  draw_preset(ui);
  draw_motion_reference(ui);
  if (redistribution_of(ui.session.motion) != Redistribution::none) draw_when(ui);
  if (ImGui::TreeNodeEx("motion-details", ImGuiTreeNodeFlags_NoTreePushOnOpen, "Details")) {
    mark(ui, "motion-details");
    draw_details(ui);
  } else {
    mark(ui, "motion-details");
  }
  ImGui::EndDisabled();
}

}  // namespace isorelax::ui
