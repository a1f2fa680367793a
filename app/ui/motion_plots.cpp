#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "ui/motion_panel.h"
#include "ui/panels.h"
#include "ui/plot.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

using Measured = std::function<double(const MotionEntry&)>;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Percent; of a surface that encloses no volume there is none.
double volume_change(const MotionEntry& moment) {
  return moment.encloses ? 100 * moment.volume_change : kUnknown;
}

double largest_error(const MotionEntry& moment) {
  return moment.error ? moment.error->max : kUnknown;
}

struct MotionFigure {
  std::string_view label, brief, tip;
  Measured value;
  const char* format = "%.2f";
  std::string_view unit{};
};

std::vector<MotionFigure> motion_figures() {
  return {
      {"Smallest angle", "Smallest", "Smallest angle of all triangles.",
       [](const MotionEntry& m) { return m.measure.min_angle_deg; }, "%.2f", "\xC2\xB0"},
      {"Mean smallest", "Mean", "Mean over the triangles of each one's smallest angle.",
       [](const MotionEntry& m) { return m.measure.mean_angle_deg; }, "%.2f", "\xC2\xB0"},
      {"5 % have less", "5 % less", "Smallest angle that 5 % of the triangles do not reach.",
       [](const MotionEntry& m) { return m.measure.angle_p05_deg; }, "%.2f", "\xC2\xB0"},
      {"Under 15\xC2\xB0", "Under 15\xC2\xB0", "Share of triangles with an angle under 15 degrees.",
       [](const MotionEntry& m) { return 100 * m.measure.below_15_deg; }, "%.2f", " %"},
      {"Area ratio", "Areas", "Largest area over the smallest.",
       [](const MotionEntry& m) { return m.measure.area_max_over_min; }, "%.1f", "\xC3\x97"},
      {"Folded edges", "Folds", "Edges over which the surface turns by more than 120 degrees.",
       [](const MotionEntry& m) { return static_cast<double>(m.measure.folded_edges); }, "%.0f"},
      {"Area", "Area", "Of the whole surface, squared units of the file.",
       [](const MotionEntry& m) { return m.measure.area; }, "%.4g", " units\xC2\xB2"},
      {"Volume change", "Volume", "Of the enclosed volume since the start of the motion.", volume_change,
       "%.4f", " %"},
      {"Off the surface", "Off it",
       "Largest distance between the mesh and the surface that the motion made of the start, at vertices and "
       "middles of edges; of tangent moves that of one step. Units of the file.",
       [](const MotionEntry& m) { return m.report.deviation.max; }, "%.3g", " units"},
      {"Error", "Error",
       "Largest distance of a vertex from the exact surface, where that is known. Units of the file.",
       largest_error, "%.3g", " units"},
  };
}

void figure_cell(const Ui& ui, const MotionFigure& figure, double value, ImU32 ink) {
  ImGui::TableNextColumn();
  const std::string number = number_text(figure.format, value);
  std::string text = number + (std::isfinite(value) ? std::string(figure.unit) : "");
  // In a narrow column the number is worth more.
  if (ImGui::CalcTextSize(text.c_str()).x > ImGui::GetContentRegionAvail().x) text = number;
  const float width = ImGui::CalcTextSize(text.c_str()).x;
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0F, ImGui::GetContentRegionAvail().x - width));
  text_in(ui.fonts.text, ink, text);
}

void draw_motion_table(const Ui& ui) {
  const model::Session& s = ui.session;
  const model::Branch& branch = *s.moving();
  if (branch.moments.empty() || !ImGui::BeginTable("motion", 3, ImGuiTableFlags_RowBg)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 1.1F);
  ImGui::TableSetupColumn("start", ImGuiTableColumnFlags_WidthStretch, 1);
  ImGui::TableSetupColumn("now", ImGuiTableColumnFlags_WidthStretch, 1);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const std::string now = "t = " + number_text("%.4g", s.moment().time);
  for (const std::string& title : {std::string("t = 0"), now}) {
    ImGui::TableNextColumn();
    ImGui::PushFont(ui.fonts.small);
    const float width = ImGui::CalcTextSize(title.c_str()).x;
    ImGui::PopFont();
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0F, ImGui::GetContentRegionAvail().x - width));
    text_in(ui.fonts.small, color::kTextFaint, title);
  }
  for (const MotionFigure& figure : motion_figures()) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    draw_figure_label(ui, figure.label, figure.brief, figure.tip);
    figure_cell(ui, figure, figure.value(branch.moments.front()), color::kTextDim);
    figure_cell(ui, figure, figure.value(s.moment()), color::kText);
    mark_area(ui, "figure/" + std::string(figure.label), {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
  }
  ImGui::EndTable();
}

Line line_over_time(const model::Branch& branch, const Measured& value, std::string label, ImU32 ink) {
  Line line{std::move(label), ink, {}, {}};
  bool gap = true;  // where nothing is known
  for (const MotionEntry& moment : branch.moments) {
    const double y = value(moment);
    if (std::isfinite(y)) {
      line.points.emplace_back(static_cast<float>(moment.time), static_cast<float>(y));
      line.new_start.push_back(gap);
    }
    gap = !std::isfinite(y);
  }
  return line;
}

struct TimePlot {
  LinePlot plot;
  std::vector<std::pair<std::string, Measured>> lines;
};

// Where several surfaces move side by side, each has the colour of its run, and the first line is compared.
void add_lines(const Ui& ui, TimePlot& time_plot) {
  const model::Session& s = ui.session;
  const auto& branches = s.timeline.branches;
  LinePlot& plot = time_plot.plot;
  std::vector<unsigned> beside;
  for (const unsigned branch : s.shown_branches)
    if (branches[branch].motion) beside.push_back(branch);
  const auto ink = [](unsigned branch) { return color::kBranches[branch % std::size(color::kBranches)]; };
  const auto& [label, value] = time_plot.lines.front();
  if (!beside.empty()) {
    plot.lines.push_back(line_over_time(*s.moving(), value, s.moving()->name, ink(s.timeline.cursor.branch)));
    for (const unsigned branch : beside)
      plot.lines.push_back(line_over_time(branches[branch], value, branches[branch].name, ink(branch)));
    return;
  }
  constexpr std::array kInks{color::kAccent, color::kSecond};
  for (std::size_t k = 0; k < time_plot.lines.size(); ++k)
    plot.lines.push_back(line_over_time(*s.moving(), time_plot.lines[k].second, time_plot.lines[k].first,
                                        kInks.at(k % kInks.size())));
}

// A little more than what the lines need, and never nothing.
void fit_values(LinePlot& plot, double least_span) {
  double low = 0;
  double high = 0;
  for (const Line& line : plot.lines)
    for (const ImVec2& p : line.points) {
      low = std::min(low, double{p.y});
      high = std::max(high, double{p.y});
    }
  if (plot.scale == PlotScale::logarithmic) {
    plot.low = 1;
    plot.high = std::max(10.0, 1.3 * high);
    return;
  }
  const double span = std::max(high - low, least_span);
  plot.low = low < 0 ? low - 0.08 * span : 0;
  plot.high = plot.low + 1.16 * span;
}

void draw_over_time(const Ui& ui, TimePlot time_plot, double least_span, float height) {
  LinePlot& plot = time_plot.plot;
  plot.x_name = "t =";
  plot.x_format = "%.4g";
  plot.x_end = ui.session.moving()->until;
  plot.whole_numbers = false;
  plot.marker = ui.session.moment().time;
  add_lines(ui, time_plot);
  if (least_span > 0) fit_values(plot, least_span);
  draw_lines(ui, plot, height);
}

bool knows_error(const model::Branch& branch) {
  return std::ranges::any_of(branch.moments, [](const MotionEntry& m) { return m.error.has_value(); });
}

}  // namespace

void draw_motion_quality(const Ui& ui) {
  draw_motion_table(ui);
  ImGui::Separator();
  ImGui::Dummy({0, ui.px(1)});
  const float left = ImGui::GetContentRegionAvail().y - 3 * ImGui::GetStyle().ItemSpacing.y;
  const float height = std::clamp(std::floor(left / 4), ui.px(84), ui.px(170));
  constexpr const char* kDegrees = "\xC2\xB0";
  draw_over_time(ui,
                 {{.name = "motion-angles",
                   .title = "SMALLEST ANGLES",
                   .format = "%.2f",
                   .unit = kDegrees,
                   .low = 0,
                   .high = 60,
                   .ticks = {0, 20, 40, 60}},
                  {{"mean", [](const MotionEntry& m) { return m.measure.mean_angle_deg; }},
                   {"smallest", [](const MotionEntry& m) { return m.measure.min_angle_deg; }}}},
                 0, height);
  draw_over_time(ui,
                 {{.name = "motion-share", .title = "SHARE UNDER 15\xC2\xB0, %", .format = "%.2f"},
                  {{"share", [](const MotionEntry& m) { return 100 * m.measure.below_15_deg; }}}},
                 1, height);
  draw_over_time(ui,
                 {{.name = "motion-areas",
                   .title = "LARGEST AREA OVER SMALLEST",
                   .format = "%.4g",
                   .unit = "\xC3\x97",
                   .scale = PlotScale::logarithmic},
                  {{"ratio", [](const MotionEntry& m) { return m.measure.area_max_over_min; }}}},
                 1, height);
  if (ui.session.moment().encloses)
    draw_over_time(ui,
                   {{.name = "motion-volume", .title = "VOLUME CHANGE, %", .format = "%.4g"},
                    {{"volume", volume_change}}},
                   0.01, height);
  TimePlot off{{.name = "motion-off", .title = "OFF THE SURFACE", .format = "%.3g"},
               {{"largest", [](const MotionEntry& m) { return m.report.deviation.max; }},
                {"mean", [](const MotionEntry& m) { return m.report.deviation.mean; }}}};
  draw_over_time(ui, std::move(off), 1e-12, height);
  if (knows_error(*ui.session.moving()))
    draw_over_time(ui,
                   {{.name = "motion-error", .title = "ERROR AGAINST THE EXACT SURFACE", .format = "%.3g"},
                    {{"error", largest_error}}},
                   1e-12, height);
  draw_histograms(ui, height);
}

}  // namespace isorelax::ui
