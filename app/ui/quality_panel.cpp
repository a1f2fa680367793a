#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "smoothing/step_record.h"
#include "ui/motion_panel.h"
#include "ui/panels.h"
#include "ui/plot.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

enum class Better : std::uint8_t { larger, smaller, none };

struct Figure {
  std::string_view label{};
  std::string_view brief{};  ///< where that has no room
  std::string_view tip{};
  double before = 0, now = 0;
  const char* format = "%.2f";
  std::string_view unit{};
  Better better = Better::larger;
};

std::array<Figure, 11> figures(const model::Session& session) {
  const model::MeshState& original = *session.original;
  const model::MeshState& current = *session.current;
  const QualityReport& a = original.quality();
  const QualityReport& b = current.quality();
  const double nothing = std::nan("");
  const bool unmoved = current.geometry == original.geometry;
  const bool known = session.surface && session.surface->geometry == current.geometry;
  const double away = unmoved ? 0 : known ? 100 * session.surface->deviation.max : nothing;
  const double volume = unmoved ? 0
                        : known && session.surface->deviation.has_volume
                            ? 100 * session.surface->deviation.volume_change
                            : nothing;
  const bool is_far = known && session.surface->is_over;
  return {{
      {"Smallest angle", "Smallest", "Smallest angle of all triangles.", a.min_angle_deg, b.min_angle_deg,
       "%.2f", "\xC2\xB0"},
      {"Largest angle", "Largest", "Largest angle of all triangles.", a.max_angle_deg, b.max_angle_deg,
       "%.2f", "\xC2\xB0", Better::smaller},
      {"Mean smallest", "Mean", "Mean over the triangles of each one's smallest angle.", a.mean_min_angle_deg,
       b.mean_min_angle_deg, "%.2f", "\xC2\xB0"},
      {"Under 20\xC2\xB0", "Under 20\xC2\xB0", "Share of triangles with an angle under 20 degrees.",
       100 * a.below_20_deg, 100 * b.below_20_deg, "%.2f", " %", Better::smaller},
      {"Under 30\xC2\xB0", "Under 30\xC2\xB0", "Share of triangles with an angle under 30 degrees.",
       100 * a.below_30_deg, 100 * b.below_30_deg, "%.2f", " %", Better::smaller},
      {"Over 120\xC2\xB0", "Over 120\xC2\xB0", "Share of triangles with an angle over 120 degrees.",
       100 * a.above_120_deg, 100 * b.above_120_deg, "%.2f", " %", Better::smaller},
      {"Area spread", "Spread", "Standard deviation of the areas over their mean.", a.area_std_over_mean,
       b.area_std_over_mean, "%.3f", "", Better::smaller},
      {"Inverted", "Inverted", "Triangles that lie upside down.", static_cast<double>(a.inverted),
       static_cast<double>(b.inverted), "%.0f", "", Better::smaller},
      {"Energy", "Energy", "Sum of the energies of all treated triangles; what a run makes smaller.",
       original.energy ? original.energy->total : nothing, current.energy ? current.energy->total : nothing,
       "%.6g", "", Better::smaller},
      {"Off the original", "Off it",
       "Largest distance between the surface and that of the original, of the diagonal of its bounding box. "
       "Of large meshes measured when a run has ended.",
       0, away, "%.3f", " %", is_far ? Better::smaller : Better::none},
      {"Volume change", "Volume",
       "Of the enclosed volume; an open surface has none. Of large meshes measured when a run has ended.",
       known && !session.surface->deviation.has_volume ? nothing : 0, volume, "%.3f", " %", Better::none},
  }};
}

void right_aligned(ImFont* font, const std::string& text, ImU32 color) {
  ImGui::PushFont(font);
  const float width = ImGui::CalcTextSize(text.c_str()).x;
  ImGui::PopFont();
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0F, ImGui::GetContentRegionAvail().x - width));
  text_in(font, color, text);
}

enum class Verdict : std::uint8_t { better, worse };

// Before a number, for eyes that do not tell its colours: a tick, or an exclamation mark. Returns its place.
Rect draw_verdict(const Ui& ui, const Rect& number, Verdict verdict) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 at{number.low.x - ui.px(10), number.center().y};
  const float r = ui.px(3.5F);
  const float width = ui.px(1.75F);
  if (verdict == Verdict::better) {
    const std::array<ImVec2, 3> tick{
        {{at.x - r, at.y}, {at.x - 0.25F * r, at.y + 0.8F * r}, {at.x + r, at.y - r}}};
    draw.AddPolyline(tick.data(), static_cast<int>(tick.size()), color::kBetter, ImDrawFlags_None, width);
  } else {
    draw.AddLine({at.x, at.y - 1.3F * r}, {at.x, at.y + 0.2F * r}, color::kWorse, width);
    draw.AddCircleFilled({at.x, at.y + 1.1F * r}, 0.6F * width, color::kWorse);
  }
  return {{at.x - r, at.y - r}, {at.x + r, at.y + r}};
}

void draw_figure(const Ui& ui, const Figure& f) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  draw_figure_label(ui, f.label, f.brief, f.tip);
  const auto text = [&](double value) {
    return number_text(f.format, value) + (std::isfinite(value) ? std::string(f.unit) : "");
  };
  ImGui::TableNextColumn();
  right_aligned(ui.fonts.text, text(f.before), color::kTextDim);
  ImGui::TableNextColumn();
  // Compared as shown: a difference that cannot be read is none.
  const bool same = text(f.before) == text(f.now);
  const bool better = f.better == Better::larger ? f.now > f.before : f.now < f.before;
  const bool plain = same || f.better == Better::none || !std::isfinite(f.now);
  const ImU32 ink = plain ? color::kText : better ? color::kBetter : color::kWorse;
  right_aligned(ui.fonts.text, text(f.now), ink);
  const Rect number{ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
  const std::string name = "figure/" + std::string(f.label);
  mark_area(ui, name, number);
  if (plain) return;
  tooltip(ui, better ? "Better than the original." : "Worse than the original.");
  mark_area(ui, name + (better ? "/better" : "/worse"),
            draw_verdict(ui, number, better ? Verdict::better : Verdict::worse));
}

void draw_table(const Ui& ui) {
  if (!ImGui::BeginTable("quality", 3, ImGuiTableFlags_RowBg)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 1.1F);
  ImGui::TableSetupColumn("original", ImGuiTableColumnFlags_WidthStretch, 1);
  ImGui::TableSetupColumn("current", ImGuiTableColumnFlags_WidthStretch, 1);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  for (const char* title : {"original", "current"}) {
    ImGui::TableNextColumn();
    right_aligned(ui.fonts.small, title, color::kTextFaint);
  }
  for (const Figure& f : figures(ui.session)) draw_figure(ui, f);
  ImGui::EndTable();
}

// A coloured edge for the run, as in its picture and in the plots.
void draw_run_name(const Ui& ui, unsigned branch) {
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetTextLineHeight();
  ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + ui.px(4), low.y + height},
                                            color::kBranches[branch % std::size(color::kBranches)]);
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ui.px(10));
  const std::string name = ui.session.timeline.numbered_name(branch);
  text_in(ui.fonts.text, branch == ui.session.timeline.cursor.branch ? color::kText : color::kTextDim,
          fitted(*ui.fonts.text, name, ImGui::GetContentRegionAvail().x));
}

void draw_run_row(const Ui& ui, unsigned branch, const QualityReport& quality) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  draw_run_name(ui, branch);
  const std::array values{quality.min_angle_deg, quality.max_angle_deg, quality.mean_min_angle_deg};
  constexpr std::array<const char*, 3> kNames{"/smallest", "/largest", "/mean"};
  for (std::size_t k = 0; k < values.size(); ++k) {
    ImGui::TableNextColumn();
    right_aligned(ui.fonts.text, number_text("%.2f", values[k]) + "\xC2\xB0", color::kText);
    mark_area(ui, "run-figure/" + std::to_string(branch) + kNames[k],
              {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
  }
}

// What the runs beside each other have come to, at the iteration that is shown of each.
void draw_run_table(const Ui& ui) {
  const model::Session& s = ui.session;
  if (s.other_states.empty() || s.other_states.size() != s.shown_branches.size()) return;
  heading(ui, "RUNS AT ITERATION " + std::to_string(s.shared_iteration()));
  if (!ImGui::BeginTable("run-figures", 4, ImGuiTableFlags_RowBg)) return;
  constexpr std::array<const char*, 4> kTitles{"", "smallest", "largest", "mean"};
  for (const char* title : kTitles)
    ImGui::TableSetupColumn(title, ImGuiTableColumnFlags_WidthStretch, *title == '\0' ? 2.1F : 1);
  ImGui::TableNextRow();
  for (const char* title : kTitles) {
    ImGui::TableNextColumn();
    right_aligned(ui.fonts.small, title, color::kTextFaint);
  }
  std::vector<std::pair<unsigned, const model::MeshState*>> rows{{s.timeline.cursor.branch, s.current.get()}};
  for (std::size_t k = 0; k < s.other_states.size(); ++k)
    rows.emplace_back(s.shown_branches[k], s.other_states[k].get());
  std::ranges::sort(rows);
  for (const auto& [branch, state] : rows) draw_run_row(ui, branch, state->quality());
  ImGui::EndTable();
  heading(ui, "THE PRESENT RUN");
}

}  // namespace

void draw_histograms(const Ui& ui, float height) {
  const model::Geometry& before = *ui.session.original->geometry;
  const model::Geometry& now = *ui.session.current->geometry;
  draw_bars(ui,
            {.name = "angle-histogram",
             .title = "SMALLEST ANGLES",
             .unit = "\xC2\xB0",
             .now = now.min_angle.counts,
             .before = before.min_angle.counts,
             .low = now.min_angle.low,
             .high = now.min_angle.high,
             .ticks = {0, 15, 30, 45, 60}},
            height);
  draw_bars(ui,
            {.name = "area-histogram",
             .title = "AREAS OVER THE MEAN",
             .unit = "\xC3\x97",
             .now = now.relative_area.counts,
             .before = before.relative_area.counts,
             .low = now.relative_area.low,
             .high = now.relative_area.high,
             .ticks = {0, 1, 2, 3},
             .above_now = now.relative_area.above,
             .above_before = before.relative_area.above},
            height);
}

namespace {

Line make_line(const std::vector<model::IterationRow>& rows, double model::IterationRow::*field,
               std::string label, ImU32 color) {
  Line line{std::move(label), color, {}, {}};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    line.points.emplace_back(static_cast<float>(rows[k].iteration), static_cast<float>(rows[k].*field));
    line.new_start.push_back(k == 0 || rows[k].series != rows[k - 1].series);
  }
  return line;
}

// The runs beside the present one in the colours of the timeline.
void add_runs_beside(const Ui& ui, double model::IterationRow::*field, LinePlot& plot) {
  const model::Timeline& timeline = ui.session.timeline;
  if (ui.session.shown_branches.empty() || timeline.empty()) return;
  const auto ink = [](unsigned branch) { return color::kBranches[branch % std::size(color::kBranches)]; };
  plot.lines.front().label = timeline.current()->name;
  plot.lines.front().color = ink(timeline.cursor.branch);
  for (const unsigned branch : ui.session.shown_branches)
    plot.lines.push_back(
        make_line(timeline.rows(branch), field, timeline.branches[branch].name, ink(branch)));
}

void draw_history(const Ui& ui, float height) {
  const auto& rows = ui.session.history;
  // As long as what was done.
  const double end = ui.session.timeline.empty() ? 10 : 1;
  LinePlot energy{.name = "energy-plot", .title = "ENERGY", .format = "%.7g", .x_end = end};
  energy.marker = ui.session.current->iteration;
  energy.lines.push_back(make_line(rows, &model::IterationRow::energy, "energy", color::kAccent));
  add_runs_beside(ui, &model::IterationRow::energy, energy);
  fit_range(energy);
  draw_lines(ui, energy, height);
  LinePlot angles{.name = "angle-plot",
                  .title = "WORST ANGLES",
                  .format = "%.2f",
                  .unit = "\xC2\xB0",
                  .low = 0,
                  .high = 180,
                  .ticks = {0, 60, 120, 180},
                  .x_end = end};
  angles.marker = ui.session.current->iteration;
  angles.lines.push_back(make_line(rows, &model::IterationRow::min_angle_deg, "smallest", color::kAccent));
  if (ui.session.shown_branches.empty()) {
    angles.lines.push_back(make_line(rows, &model::IterationRow::max_angle_deg, "largest", color::kSecond));
  } else {
    angles.title = "SMALLEST ANGLE";
    angles.high = 60;
    angles.ticks = {0, 20, 40, 60};
    add_runs_beside(ui, &model::IterationRow::min_angle_deg, angles);
  }
  draw_lines(ui, angles, height);
}

}  // namespace

void draw_quality(const Ui& ui) {
  if (ui.session.moving() != nullptr) return draw_motion_quality(ui);
  draw_run_table(ui);
  draw_table(ui);
  ImGui::Separator();
  ImGui::Dummy({0, ui.px(1)});
  // The four plots share what is left; a low window scrolls instead of squeezing them.
  const float left = ImGui::GetContentRegionAvail().y - 3 * ImGui::GetStyle().ItemSpacing.y;
  const float height = std::clamp(std::floor(left / 4), ui.px(84), ui.px(190));
  draw_histograms(ui, height);
  draw_history(ui, height);
}

void draw_side_panel(const Ui& ui, const Rect& rect, bool folded) {
  constexpr std::array<std::string_view, 5> kTabs{"Quality", "Inspect", "Debug", "Runs", "Settings"};
  begin_panel("side", rect);
  // The settings have a panel of their own again.
  if (!folded && ui.state.tab == SideTab::settings) ui.state.tab = SideTab::quality;
  const std::span<const std::string_view> tabs(kTabs.data(), folded ? kTabs.size() : kTabs.size() - 1);
  ImGui::PushFont(folded ? ui.fonts.small : ui.fonts.text);
  const int choice =
      segmented(ui, "tab", tabs, static_cast<int>(ui.state.tab), ImGui::GetContentRegionAvail().x);
  ImGui::PopFont();
  if (choice >= 0) ui.state.tab = static_cast<SideTab>(choice);
  ImGui::Dummy({0, ui.px(2)});
  if (!ui.session.current && ui.state.tab != SideTab::settings) {
    text_in(ui.fonts.text, color::kTextFaint, "No mesh is open.");
    ImGui::End();
    return;
  }
  // Every tab keeps its own place when it is scrolled.
  ImGui::BeginChild(kTabs.at(static_cast<std::size_t>(ui.state.tab)).data(), {0, 0});
  switch (ui.state.tab) {
    case SideTab::quality:
      draw_quality(ui);
      break;
    case SideTab::inspect:
      draw_inspector(ui);
      break;
    case SideTab::debug:
      draw_debug(ui);
      break;
    case SideTab::runs:
      draw_runs(ui);
      break;
    case SideTab::settings:
      draw_settings(ui);
      break;
  }
  ImGui::EndChild();
  ImGui::End();
}

namespace {

/// "; 52 vertices were limited by the boundary, 3 by folds".
std::string limits_sentence(const model::StepSummary& step) {
  constexpr std::array<std::string_view, 8> kWords{"by pins",         "as corners",         "to ridges",
                                                   "by the boundary", "by folds",           "by the energy",
                                                   "by the surface",  "by having converged"};
  std::string text;
  for (std::size_t bit = 0; bit < step.limits.size(); ++bit) {
    const std::size_t count = step.limits[bit];
    if (count == 0) continue;
    text += text.empty() ? "; " : ", ";
    text += count_text(count);
    if (text.find("limited") == std::string::npos)
      text += count == 1 ? " vertex was limited" : " vertices were limited";
    text += " " + std::string(kWords.at(bit));
  }
  return text;
}

/// "43 iterations": all that the run has, however often it was stopped on the way.
std::string run_length(const model::Session& session) {
  const model::Branch* branch = session.timeline.current();
  unsigned count = session.last_run->iterations;
  if (branch != nullptr && session.last_run->stopped != StopReason::fixed)
    count = branch->tip() - (branch->kind == PartKind::polish ? branch->start : 0);
  return std::to_string(count) + (count == 1 ? " iteration" : " iterations");
}

}  // namespace

std::string describe_last_run(const model::Session& session) {
  if (const model::Branch* branch = session.moving()) return branch->ended;
  if (!session.last_run) return {};
  const RunResult& run = *session.last_run;
  const model::Branch* branch = session.timeline.current();
  const bool polished = branch != nullptr && branch->kind == PartKind::polish;
  // A step is no run that came to the end of its number.
  const bool stepped =
      run.stopped == StopReason::iterations && run.iterations == 1 && session.smoothing.iterations > 1;
  std::string text = !session.broken_by.empty()
                         ? "Stopped at iteration " + std::to_string(session.current->iteration) + ", where " +
                               session.broken_by
                     : run.stopped == StopReason::cancelled
                         ? "Paused after " + run_length(session)
                         : (polished ? "Polished in " : "Stopped after ") + run_length(session) + ": " +
                               (stepped ? "one step was made" : std::string(to_string(run.stopped)));
  return session.last_step ? text + limits_sentence(*session.last_step) : text;
}

}  // namespace isorelax::ui
