#include <algorithm>
#include <array>
#include <cmath>

#include "ui/motion_panel.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

using model::SmoothingSettings;

/// "...": the segment for other values than the usual ones.
constexpr std::string_view kOther = "\xE2\x80\xA6";

// A change to the settings goes out as one command that names it.
void change(const Ui& ui, const SmoothingSettings& settings, std::string label) {
  if (settings != ui.session.smoothing) ui.command(model::SetSmoothing{settings, std::move(label)});
}

void end_edit_after_item(const Ui& ui) {
  if (ImGui::IsItemDeactivated()) ui.command(model::EndEdit{});
}

/// A number with usual values: a segment for each, and one for any other value, which is typed below.
struct Presets {
  std::string_view name, label, tip;
  std::span<const std::string_view> labels;  ///< one more than values, for the other ones
  std::span<const double> values;
  double least, most;
};

/// Whether another one was chosen.
bool draw_presets(const Ui& ui, const Presets& presets, double& value, bool& typed) {
  row_label(ui, presets.label, presets.tip);
  const auto found = std::ranges::find(presets.values, value);
  const bool other = typed || found == presets.values.end();
  const int last = static_cast<int>(presets.values.size());
  const int shown = other ? last : static_cast<int>(found - presets.values.begin());
  const int choice = segmented(ui, presets.name, presets.labels, shown, ImGui::GetContentRegionAvail().x);
  if (choice >= 0) typed = choice == last;
  if (choice >= 0 && choice < last) {
    value = presets.values[static_cast<std::size_t>(choice)];
    return true;
  }
  if (!other) return false;
  row_label(ui, "", presets.tip);
  double number = value;
  const std::string name = std::string(presets.name) + "-typed";
  const bool edited =
      ImGui::InputDouble(("##" + name).c_str(), &number, 0, 0, "%.6g", ImGuiInputTextFlags_CharsScientific) &&
      number >= presets.least && number <= presets.most;
  end_edit_after_item(ui);
  mark(ui, name);
  tooltip(ui, presets.tip);
  if (edited) value = number;
  return edited;
}

// Why what is said of the energy means nothing; empty: it does.
std::string why_no_energy(const model::Session& s) {
  if (s.smoothing.method == model::Method::near_isometry) return {};
  return std::string(model::title(s.smoothing.method)) +
         " smoothing knows no energy: this is of the other solvers.";
}

// Greys out what means nothing, and says why, for as long as it lives.
class OfEnergy {
 public:
  explicit OfEnergy(const Ui& ui) : ui_(ui), reason_(why_no_energy(ui.session)) {
    low_ = ImGui::GetCursorScreenPos();
    width_ = ImGui::GetContentRegionAvail().x;
    ImGui::BeginDisabled(!reason_.empty());
  }
  ~OfEnergy() {
    ImGui::EndDisabled();
    const ImVec2 high{low_.x + width_, ImGui::GetCursorScreenPos().y};
    if (reason_.empty() || !ImGui::IsMouseHoveringRect(low_, high)) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ui_.px(280));
    ImGui::TextUnformatted(reason_.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
  OfEnergy(const OfEnergy&) = delete;
  OfEnergy& operator=(const OfEnergy&) = delete;

 private:
  const Ui& ui_;
  std::string reason_;
  ImVec2 low_{0, 0};
  float width_ = 0;
};

void draw_solver(const Ui& ui) {
  // The last two know no energy: what others do.
  constexpr std::array<std::string_view, 6> kSolvers{"Automatic", "Jacobi (paper)", "Newton",
                                                     "L-BFGS",    "Laplacian",      "Angle-based"};
  constexpr int kMinimisers = 4;
  constexpr const char* kTip =
      "How each step is found: the paper's Jacobi step, Newton steps of each vertex, L-BFGS over all of "
      "them, or automatically: steps that even the mesh out, Newton steps, then L-BFGS. Laplacian and "
      "angle-based smoothing are there to compare with.";
  SmoothingSettings settings = ui.session.smoothing;
  row_label(ui, "Solver", kTip);
  const bool minimises = settings.method == model::Method::near_isometry;
  const int chosen =
      minimises ? static_cast<int>(settings.solver) : kMinimisers - 1 + static_cast<int>(settings.method);
  const int solver = combo(ui, "solver", kSolvers, chosen);
  tooltip(ui, kTip);
  if (solver >= 0) {
    settings.method = solver < kMinimisers ? model::Method::near_isometry
                                           : static_cast<model::Method>(solver - kMinimisers + 1);
    if (solver < kMinimisers) settings.solver = static_cast<Solver>(solver);
    change(ui, settings, "Solver");
  }
}

void draw_exponent(const Ui& ui) {
  const OfEnergy of_energy(ui);
  SmoothingSettings settings = ui.session.smoothing;
  constexpr std::array<std::string_view, 6> kLabels{"1", "2", "4", "8", "16", kOther};
  constexpr std::array kExponents{1.0, 2.0, 4.0, 8.0, 16.0};
  const Presets exponents{
      "exponent",
      "Exponent",
      "The power p in the sum of E^p: 1 treats all triangles alike, larger powers favour the worst ones. "
      "\xE2\x80\xA6: any from 1 to 64.",
      kLabels,
      kExponents,
      1,
      64};
  if (draw_presets(ui, exponents, settings.exponent, ui.state.typing.exponent))
    change(ui, settings, "Exponent");
}

void draw_mu(const Ui& ui) {
  constexpr const char* kTip =
      "Weight of the area term, 0 to 1; the shape term has the rest. 0 makes good angles and lets areas "
      "differ, "
      "larger values even out the areas.";
  const OfEnergy of_energy(ui);
  SmoothingSettings settings = ui.session.smoothing;
  auto mu = static_cast<float>(settings.mu_a);
  row_label(ui, "Area \xCE\xBC\xE2\x82\x90", kTip);
  if (slider(ui, "mu", mu, 0, 1, "%.2f")) {
    // The number that is shown is the number that is used.
    settings.mu_a = std::round(100.0 * static_cast<double>(mu)) / 100;
    change(ui, settings, "\xCE\xBC\xE2\x82\x90");
  }
  end_edit_after_item(ui);
  mark(ui, "mu");
  tooltip(ui, kTip);
  ImGui::Dummy({0, 0});
  ImGui::SameLine(ui.px(104));
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() - ui.px(6));
  wrapped(ui.fonts.small, color::kTextFaint, model::describe_mu(settings.mu_a));
}

void draw_reference(const Ui& ui) {
  constexpr std::array<std::string_view, 4> kLabels{"Equilateral, mean area", "Equilateral, edge length",
                                                    "Mesh as opened", "Another file"};
  constexpr const char* kTip =
      "The triangles that the mesh's ones ought to look like: equilateral ones, those of the opened mesh, or "
      "those of "
      "a file with the same connectivity.";
  const OfEnergy of_energy(ui);
  SmoothingSettings settings = ui.session.smoothing;
  row_label(ui, "Reference", kTip);
  const int choice = combo(ui, "reference", kLabels, static_cast<int>(settings.reference));
  tooltip(ui, kTip);
  if (choice == static_cast<int>(model::ReferenceKind::file) && settings.reference_file.empty()) {
    ask_for_file(ui, FilePurpose::reference);
  } else if (choice >= 0) {
    settings.reference = static_cast<model::ReferenceKind>(choice);
    change(ui, settings, "Reference");
  }
  if (settings.reference == model::ReferenceKind::edge_length) {
    row_label(ui, "Edge length", "Edge length of the reference triangles, in the units of the file.");
    double length = settings.edge_length;
    if (ImGui::InputDouble("##edge", &length, 0, 0, "%.6g", ImGuiInputTextFlags_CharsScientific) &&
        length > 0) {
      settings.edge_length = length;
      change(ui, settings, "Edge length");
    }
    end_edit_after_item(ui);
    mark(ui, "edge-length");
  } else if (settings.reference == model::ReferenceKind::file) {
    row_label(ui, "File", "A mesh with the same triangles; its positions give the reference.");
    const std::string name = std::filesystem::path(settings.reference_file).filename().string();
    if (button(ui, "reference-file", name, {.width = ImGui::GetContentRegionAvail().x}))
      ask_for_file(ui, FilePurpose::reference);
  }
}

void draw_boundary(const Ui& ui) {
  constexpr std::array<std::string_view, 3> kLabels{"Fixed", "Slide", "Free"};
  constexpr const char* kTip =
      "What vertices on the border of the surface may do: stay, slide along the border, or move like all "
      "others.";
  row_label(ui, "Boundary", kTip);
  SmoothingSettings settings = ui.session.smoothing;
  const int choice = segmented(ui, "boundary", kLabels, static_cast<int>(settings.boundary),
                               ImGui::GetContentRegionAvail().x);
  if (choice < 0) return;
  settings.boundary = static_cast<BoundaryRule>(choice);
  change(ui, settings, "Boundary");
}

void draw_features(const Ui& ui) {
  constexpr std::array<std::string_view, 3> kLabels{"Auto", "None", "Angle"};
  constexpr const char* kTip =
      "Creases that are kept: found with the built-in thresholds, none, or all that turn by more than an "
      "angle.";
  row_label(ui, "Features", kTip);
  SmoothingSettings settings = ui.session.smoothing;
  const int choice = segmented(ui, "features", kLabels, static_cast<int>(settings.features),
                               ImGui::GetContentRegionAvail().x);
  if (choice >= 0) {
    settings.features = static_cast<model::FeatureRule>(choice);
    change(ui, settings, "Features");
  }
  if (settings.features != model::FeatureRule::angle) return;
  row_label(ui, "Crease angle", "Dihedral turn from which an edge is a crease, in degrees.");
  auto angle = static_cast<float>(settings.feature_deg);
  if (slider(ui, "feature-angle", angle, 5, 120, "%.0f\xC2\xB0")) {
    settings.feature_deg = std::round(static_cast<double>(angle));
    change(ui, settings, "Crease angle");
  }
  end_edit_after_item(ui);
  mark(ui, "feature-angle");
}

void draw_reach(const Ui& ui) {
  constexpr std::array<std::string_view, 4> kLabels{"Near", "Wide", "Any", "Typed"};
  constexpr const char* kTip =
      "How far the surface may go from the mesh as opened. Near: the mean of edge length times dihedral "
      "angle; wide: 0.3 % of the diagonal, more where the mesh is coarse; any: all the way; or typed.";
  row_label(ui, "Stay within", kTip);
  SmoothingSettings settings = ui.session.smoothing;
  const int choice =
      segmented(ui, "reach", kLabels, static_cast<int>(settings.reach), ImGui::GetContentRegionAvail().x);
  if (choice >= 0) {
    settings.reach = static_cast<model::Reach>(choice);
    change(ui, settings, "Stay within");
  }
  if (settings.reach != model::Reach::typed) return;
  row_label(ui, "Distance",
            "Largest distance from the mesh as opened, in percent of its bounding-box diagonal.");
  double percent = 100 * settings.max_deviation;
  if (ImGui::InputDouble("##max-deviation", &percent, 0, 0, "%.4g %%", ImGuiInputTextFlags_CharsScientific) &&
      percent >= 0) {
    settings.max_deviation = percent / 100;
    change(ui, settings, "Distance");
  }
  end_edit_after_item(ui);
  mark(ui, "max-deviation");
}

void draw_polish(const Ui& ui) {
  constexpr std::array<std::string_view, 4> kLabels{"Off", "Worst", "Mean", "Both"};
  constexpr const char* kTip =
      "A last stage after the run, as a branch of its own. Worst: raises the smallest angles and lowers the "
      "largest, the worst triangles first. Mean: raises the mean of the triangles' smallest angles, while "
      "the "
      "worst stay as good as they are. Both: one after the other.";
  row_label(ui, "Polish", kTip);
  SmoothingSettings settings = ui.session.smoothing;
  const int choice =
      segmented(ui, "polish", kLabels, static_cast<int>(settings.polish), ImGui::GetContentRegionAvail().x);
  if (choice < 0) return;
  settings.polish = static_cast<model::Polish>(choice);
  change(ui, settings, "Polish");
}

void draw_iterations(const Ui& ui) {
  SmoothingSettings settings = ui.session.smoothing;
  row_label(ui, "Iterations", "How many steps a run may do.");
  int iterations = static_cast<int>(settings.iterations);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(10), ui.px(6)});
  // In a narrow panel the number has the room of the buttons.
  const int step = ImGui::GetContentRegionAvail().x < ui.px(130) ? 0 : 10;
  if (ImGui::InputInt("##iterations", &iterations, step, 10 * step)) {
    settings.iterations = static_cast<unsigned>(std::clamp(iterations, 1, 1000000));
    change(ui, settings, "Iterations");
  }
  ImGui::PopStyleVar();
  end_edit_after_item(ui);
  mark(ui, "iterations");

  constexpr std::array<std::string_view, 5> kLabels{"Off", "1e-4", "1e-6", "1e-8", kOther};
  constexpr std::array kTolerances{0.0, 1e-4, 1e-6, 1e-8};
  const Presets tolerances{
      "tolerance",
      "Tolerance",
      "A run ends when the gradient, the decrease of the energy or the largest move has fallen below this "
      "share of its start, of the energy, or of the mean edge length. \xE2\x80\xA6: any from 0 to 1.",
      kLabels,
      kTolerances,
      0,
      1};
  if (draw_presets(ui, tolerances, settings.tolerance, ui.state.typing.tolerance))
    change(ui, settings, "Tolerance");
}

// What Run does.
void draw_task(const Ui& ui) {
  constexpr std::array<std::string_view, 2> kTasks{"Smooth", "Move"};
  ImGui::BeginDisabled(ui.session.is_running());
  const int choice =
      segmented(ui, "task", kTasks, static_cast<int>(ui.session.task), ImGui::GetContentRegionAvail().x);
  ImGui::EndDisabled();
  tooltip(ui, "Smooth the mesh, or carry it by a motion and redistribute its vertices on the way.",
          keys_of(Action::task));
  if (choice >= 0) ui.command(model::SetTask{static_cast<model::Task>(choice)});
}

// A moving surface at its end goes nowhere.
bool has_arrived(const model::Session& s) {
  if (s.task != model::Task::move || !s.continues_branch()) return false;
  const model::Branch& branch = *s.timeline.current();
  return s.timeline.cursor.iteration == branch.tip() && !branch.moments.empty() &&
         branch.moments.back().time >= branch.until;
}

// "Run", "Continue", ...: what a press does.
std::string run_label(const model::Session& s) {
  if (s.is_running()) return "Pause";
  if (s.task == model::Task::smooth) return s.remaining > 0 ? "Continue" : "Run";
  if (has_arrived(s)) return "Arrived at its end";
  const bool begun = s.continues_branch() && s.timeline.cursor.iteration > s.timeline.current()->start;
  return begun ? "Continue" : "Run";
}

void draw_run_buttons(const Ui& ui) {
  const model::Session& s = ui.session;
  const bool running = s.is_running();
  const bool moves = s.task == model::Task::move;
  // Without a mesh the paper's sphere moves.
  const bool takes_sphere = moves && !s.document && s.activity == model::Activity::idle;
  const bool can_run = takes_sphere || (s.can_smooth() && !has_arrived(s));
  const float height = ui.px(34);
  const float width = ImGui::GetContentRegionAvail().x;
  const float gap = ui.px(8);
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + ui.px(2));
  if (button(ui, "run", run_label(s),
             {.icon = running ? Icon::pause : Icon::run,
              .look = ButtonLook::accent,
              .width = width,
              .height = height,
              .enabled = running || can_run}))
    perform(ui, Action::run_pause);
  tooltip(ui,
          has_arrived(s) ? "It has arrived at its end: set a later one, another motion, or go back in time."
          : running      ? "Stop after this step."
          : moves        ? "Carry the surface to the end of its time."
                         : "Smooth up to the number of iterations.",
          keys_of(Action::run_pause));
  const float each = std::floor((width - 2 * gap) / 3);
  if (button(ui, "step", "Step", {.icon = Icon::step, .width = each, .height = height, .enabled = can_run}))
    perform(ui, Action::step);
  tooltip(ui, moves ? "One time step." : "One iteration.", keys_of(Action::step));
  ImGui::SameLine(0, gap);
  const bool moved = s.current && s.current->geometry != s.original->geometry;
  if (button(ui, "reset", "Reset", {.icon = Icon::reset, .width = each, .height = height, .enabled = moved}))
    perform(ui, Action::reset);
  tooltip(ui, "Back to the mesh as opened. Can be undone.", keys_of(Action::reset));
  ImGui::SameLine(0, gap);
  if (button(ui, "copy-command-line", "Copy CLI",
             {.width = width - 2 * (gap + each), .height = height, .enabled = s.document != nullptr}))
    perform(ui, Action::copy_command_line);
  tooltip(ui, "Copy what was done, or else these settings, as a command line: the same for a shell.",
          keys_of(Action::copy_command_line));
}

void draw_range(const Ui& ui, model::ViewSettings& view) {
  constexpr std::array<std::string_view, 3> kLabels{"Run", "Current", "Typed"};
  constexpr const char* kTip =
      "The ends of the colour scale: fit for all iterations, so that colours can be compared; fit for the "
      "present state; "
      "or typed. Values outside are grey. A change has its own ends, with 0 in the middle.";
  row_label(ui, "Range", kTip);
  const int choice =
      segmented(ui, "range", kLabels, static_cast<int>(view.range_mode), ImGui::GetContentRegionAvail().x);
  if (choice >= 0) view.range_mode = static_cast<model::RangeMode>(choice);
  if (view.range_mode != model::RangeMode::typed) return;
  model::ValueRange& typed = view.typed[static_cast<std::size_t>(view.coloring)];
  row_label(ui, "From, to", "Both ends of the colour scale.");
  std::array<float, 2> ends{static_cast<float>(typed.low), static_cast<float>(typed.high)};
  if (ImGui::InputFloat2("##typed", ends.data(), "%.4g") && ends[0] < ends[1]) typed = {ends[0], ends[1]};
  mark(ui, "typed-range");
}

void draw_display(const Ui& ui) {
  constexpr std::array<std::string_view, 6> kMaps{"Automatic", "viridis", "cividis",
                                                  "inferno",   "magma",   "blue-orange"};
  model::ViewSettings view = ui.session.view;
  draw_range(ui, view);
  row_label(ui, "Colours",
            "A perceptually uniform colour map; Automatic takes the one that suits the quantity.");
  const auto found = std::ranges::find(kMaps, view.color_map);
  const int map =
      combo(ui, "color-map", kMaps, found == kMaps.end() ? 0 : static_cast<int>(found - kMaps.begin()));
  if (map >= 0) view.color_map = map == 0 ? "" : std::string(kMaps[static_cast<std::size_t>(map)]);
  ImGui::Dummy({0, 0});
  ImGui::SameLine(ui.px(104));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(3), ui.px(3)});
  ImGui::Checkbox("Reversed", &view.reversed);
  mark(ui, "reversed");
  ImGui::SameLine(0, ui.px(14));
  ImGui::Checkbox("Legend", &view.legend);
  mark(ui, "legend");
  ImGui::PopStyleVar();
  if (view != ui.session.view) ui.command(model::SetView{view});
}

}  // namespace

void draw_settings(const Ui& ui) {
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, ui.px(5)});
  draw_task(ui);
  if (ui.session.task == model::Task::move) {
    draw_motion_settings(ui);
  } else {
    ImGui::BeginDisabled(ui.session.is_running());
    draw_solver(ui);
    draw_exponent(ui);
    draw_mu(ui);
    draw_reference(ui);
    draw_boundary(ui);
    draw_features(ui);
    draw_reach(ui);
    draw_iterations(ui);
    draw_polish(ui);
    ImGui::EndDisabled();
  }
  draw_run_buttons(ui);
  heading(ui, "COLOURS");
  draw_display(ui);
  ImGui::PopStyleVar();
}

void draw_settings_panel(const Ui& ui, const Rect& rect) {
  begin_panel("settings", rect);
  draw_settings(ui);
  ImGui::End();
}

}  // namespace isorelax::ui
