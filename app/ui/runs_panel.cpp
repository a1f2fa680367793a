#include <algorithm>
#include <array>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

constexpr std::size_t kMostBeside = 3;
constexpr float kBesideButton = 60;  // points
constexpr float kRemoveButton = 24;

std::string range_text(const model::Branch& branch) {
  if (branch.motion) {
    const double time = branch.moments.empty() ? 0 : branch.moments.back().time;
    return counted(branch.steps.size(), "step", "steps") + ", to t = " + number_text("%.4g", time);
  }
  return branch.start == 0 ? counted(branch.tip(), "iteration", "iterations")
                           : "from " + std::to_string(branch.start) + " to " + std::to_string(branch.tip());
}

void toggle_beside(const Ui& ui, unsigned branch) {
  std::vector<unsigned> shown = ui.session.shown_branches;
  if (std::erase(shown, branch) == 0) shown.push_back(branch);
  ui.command(model::ShowBranches{std::move(shown)});
}

// Beside the present run or not, and away with it, at the right of its row.
void draw_branch_buttons(const Ui& ui, unsigned k, ImVec2 at) {
  const model::Session& s = ui.session;
  const std::string name = "branch/" + std::to_string(k);
  if (k != s.timeline.cursor.branch) {
    ImGui::SetCursorScreenPos(at);
    const bool beside = std::ranges::find(s.shown_branches, k) != s.shown_branches.end();
    if (small_button(ui, name + "/beside", beside ? "Hide" : "Beside",
                     {.look = beside ? ButtonLook::pressed : ButtonLook::plain,
                      .width = ui.px(kBesideButton),
                      .enabled = beside || s.shown_branches.size() < kMostBeside}))
      toggle_beside(ui, k);
    tooltip(ui, "Show it beside the present run, at the same iteration and with the same camera.");
  }
  ImGui::SetCursorScreenPos({at.x + ui.px(kBesideButton + 4), at.y});
  const std::string kept = why_kept(s, k);
  if (small_button(ui, name + "/remove", "",
                   {.icon = Icon::close,
                    .look = ButtonLook::quiet,
                    .width = ui.px(kRemoveButton),
                    .enabled = kept.empty()}))
    ui.command(model::RemoveRun{k});
  tooltip(ui, kept.empty() ? "Remove this run. Can be undone." : kept);
}

void draw_branch(const Ui& ui, unsigned k) {
  const model::Session& s = ui.session;
  const model::Branch& branch = s.timeline.branches[k];
  const bool present = k == s.timeline.cursor.branch;
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float buttons = ui.px(8 + kBesideButton + 4 + kRemoveButton);
  const float width = ImGui::GetContentRegionAvail().x - buttons;
  const float height = ui.px(44);
  if (button(ui, "branch/" + std::to_string(k), "",
             {.look = present ? ButtonLook::pressed : ButtonLook::quiet, .width = width, .height = height}))
    ui.command(model::Seek{s.shared_iteration(), k});
  tooltip(ui, present ? "This run is shown." : "Show this run, with its settings.");
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled({low.x + ui.px(8), low.y + ui.px(9)}, {low.x + ui.px(12), low.y + ui.px(35)},
                     color::kBranches[k % std::size(color::kBranches)], ui.px(2));
  const float room = width - ui.px(22 + 6);
  const std::string name = fitted(*ui.fonts.text, s.timeline.numbered_name(k), room);
  draw.AddText({low.x + ui.px(22), low.y + ui.px(5)}, color::kText, name.c_str());
  const std::string range = fitted(*ui.fonts.small, range_text(branch), room);
  draw.AddText(ui.fonts.small, ui.fonts.small->FontSize, {low.x + ui.px(22), low.y + ui.px(24)},
               color::kTextFaint, range.c_str());
  const ImVec2 below = ImGui::GetCursorScreenPos();
  draw_branch_buttons(ui, k, {low.x + width + ui.px(8), low.y + ui.px(10)});
  ImGui::SetCursorScreenPos(below);
}

void draw_difference(const Ui& ui) {
  const model::Session& s = ui.session;
  const auto count = static_cast<int>(s.timeline.branches.size());
  if (count < 2) return;
  heading(ui, "COMPARE TWO RUNS");
  std::vector<std::string> names;
  names.reserve(s.timeline.branches.size());
  for (int k = 0; k < count; ++k) names.push_back(s.timeline.numbered_name(static_cast<unsigned>(k)));
  const std::vector<std::string_view> labels(names.begin(), names.end());
  int& with = ui.state.typing.compare_with;
  const int present = static_cast<int>(s.timeline.cursor.branch);
  with = std::clamp(with, 0, count - 1);
  if (with == present) with = present == 0 ? 1 : 0;
  row_label(ui, "With", "The run that the present one is compared with.");
  const int choice = combo(ui, "compare-run", labels, with);
  if (choice >= 0 && choice != present) with = choice;
  if (button(ui, "find-parting", "Find where they part",
             {.width = ImGui::GetContentRegionAvail().x, .enabled = !s.is_running()}))
    ui.command(model::CompareBranches{static_cast<unsigned>(present), static_cast<unsigned>(with)});
  tooltip(ui, "The first iteration and vertex that differ in a bit.");
  if (!s.comparison) return;
  const TraceDifference& found = s.comparison->difference;
  const std::string both =
      "Runs " + std::to_string(s.comparison->first + 1) + " and " + std::to_string(s.comparison->second + 1);
  if (!found.parting) {
    wrapped(
        ui.fonts.text, color::kBetter,
        both + " are the same to the bit for " + std::to_string(found.common_iterations) + " iterations.");
    mark_area(ui, "parting", {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
    return;
  }
  wrapped(ui.fonts.text, color::kText,
          both + " part at iteration " + std::to_string(found.parting->iteration) + ": " +
              counted(found.parting->vertices, "vertex differs", "vertices differ") + " there, by up to " +
              number_text("%.3g", found.parting->largest) + "; in the end by " +
              number_text("%.3g", found.distance_at_end) + ".");
  mark_area(ui, "parting", {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
  if (link(ui, "parting-vertex", "Go to vertex " + std::to_string(found.parting->vertex))) {
    ui.command(model::Seek{static_cast<unsigned>(found.parting->iteration), s.comparison->first});
    ui.command(model::SelectVertex{found.parting->vertex});
    ui.request(FlyToSelection{});
    ui.state.tab = SideTab::inspect;
  }
}

void draw_traces(const Ui& ui) {
  const model::Session& s = ui.session;
  heading(ui, "TRACES");
  const bool moves = !s.timeline.empty() && s.timeline.current()->motion;
  const float half = std::floor(0.5F * (ImGui::GetContentRegionAvail().x - ui.px(8)));
  if (button(ui, "save-trace", "Save trace",
             {.icon = Icon::save, .width = half, .enabled = !s.timeline.empty() && !moves}))
    perform(ui, Action::save_trace);
  tooltip(
      ui,
      moves ? "A trace is of a smoother. isorelax advect writes the states of a moving surface; its command "
              "line can be copied."
            : "The present run as one file: input, settings, every iteration to the bit.",
      keys_of(Action::save_trace));
  ImGui::SameLine(0, ui.px(8));
  if (button(ui, "add-trace", "Add trace", {.icon = Icon::open, .width = half}))
    ask_for_file(ui, FilePurpose::add_trace);
  tooltip(ui, "A recorded run of this mesh, beside those that are here.");
  if (button(ui, "save-script", "Save what was done as a script",
             {.look = ButtonLook::quiet, .width = ImGui::GetContentRegionAvail().x}))
    ask_for_file(ui, FilePurpose::save_script);
  tooltip(ui, "isorelax script FILE does it again, without a window: for a report of a fault.");
}

void draw_memory(const Ui& ui) {
  constexpr std::array<std::string_view, 5> kLabels{"64 MB", "256 MB", "1 GB", "4 GB", "16 GB"};
  constexpr std::array<std::size_t, 5> kShifts{26, 28, 30, 32, 34};
  const model::Session& s = ui.session;
  heading(ui, "MEMORY FOR STEPS");
  int chosen = -1;
  for (std::size_t k = 0; k < kShifts.size(); ++k)
    if (s.step_budget == std::size_t{1} << kShifts[k]) chosen = static_cast<int>(k);
  const int choice = segmented(ui, "step-budget", kLabels, chosen, ImGui::GetContentRegionAvail().x);
  if (choice >= 0)
    ui.command(model::SetStepBudget{std::size_t{1} << kShifts.at(static_cast<std::size_t>(choice))});
  const std::string used = number_text("%.3g", static_cast<double>(s.step_memory.bytes) / (1U << 20U));
  wrapped(ui.fonts.small, color::kTextFaint,
          count_text(s.step_memory.records) + " full step records take " + used +
              " MB. Positions of all iterations are kept; steps older than the budget are done again, to the "
              "bit, when they are asked for.");
}

void draw_teach(const Ui& ui) {
  if (button(ui, "teach", "Compare the three methods",
             {.width = ImGui::GetContentRegionAvail().x, .enabled = ui.session.can_smooth()}))
    ui.command(model::Teach{});
  tooltip(ui,
          "Runs Laplacian, angle-based and near-isometry smoothing from here and shows them side by side.");
}

}  // namespace

void draw_runs(const Ui& ui) {
  const model::Session& s = ui.session;
  heading(ui, "RUNS");
  if (s.timeline.empty())
    wrapped(ui.fonts.text, color::kTextDim,
            "Every run is recorded. Go to any iteration, change a setting and run: that begins a branch.");
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, ui.px(3)});
  for (unsigned k = 0; k < s.timeline.branches.size(); ++k) draw_branch(ui, k);
  ImGui::PopStyleVar();
  ImGui::Dummy({0, ui.px(2)});
  if (s.task == model::Task::smooth) draw_teach(ui);
  draw_difference(ui);
  draw_traces(ui);
  draw_memory(ui);
}

}  // namespace isorelax::ui
