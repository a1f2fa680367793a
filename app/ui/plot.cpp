#include "ui/plot.h"

#include <algorithm>
#include <cmath>
#include <ranges>

#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

constexpr ImU32 kGridLine = IM_COL32(255, 255, 255, 16);
constexpr ImU32 kAxis = IM_COL32(255, 255, 255, 40);
constexpr ImU32 kOutline = IM_COL32(190, 197, 210, 200);

std::string short_number(double value, int decimals = 0) {
  const double magnitude = std::abs(value);
  const std::string digits = "%." + std::to_string(decimals);
  if (magnitude >= 1e6 || (magnitude > 0 && magnitude < 1e-3))
    return number_text((digits + "e").c_str(), value);
  if (magnitude >= 1e5) return number_text((digits + "fk").c_str(), value / 1e3);
  return number_text(("%." + std::to_string(5 + decimals) + "g").c_str(), value);
}

// The rectangle of a plot's data, and the way from values to pixels.
struct Frame {
  Rect area;
  double x0 = 0, x1 = 1, y0 = 0, y1 = 1;

  [[nodiscard]] float x(double value) const {
    return area.low.x + static_cast<float>((value - x0) / (x1 - x0)) * area.width();
  }
  [[nodiscard]] float y(double value) const {
    return area.high.y - static_cast<float>(std::clamp((value - y0) / (y1 - y0), 0.0, 1.0)) * area.height();
  }
};

struct KeyEntry {
  std::string_view label;
  ImU32 color;
};

void small_text(const Ui& ui, ImVec2 at, ImU32 color, const std::string& text) {
  ImGui::GetWindowDrawList()->AddText(ui.fonts.small, ui.fonts.small->FontSize,
                                      {std::floor(at.x), std::floor(at.y)}, color, text.c_str());
}

float small_width(const Ui& ui, std::string_view text) {
  return text_width(*ui.fonts.small, text);
}

constexpr float kKeyMark = 14;  // points from a mark to its label
constexpr float kKeyGap = 10;   // and from a label to the next mark

float key_width(const Ui& ui, std::span<const KeyEntry> key) {
  float width = 0;
  for (const KeyEntry& entry : key) width += small_width(ui, entry.label) + ui.px(kKeyMark + kKeyGap);
  return width;
}

// The key ends at (right, top). Where it does not fit, each label has its share of the room.
void draw_key(const Ui& ui, std::span<const KeyEntry> key, ImVec2 right_top, float room) {
  const float line = ui.fonts.small->FontSize;
  const float share =
      key_width(ui, key) <= room ? room : room / static_cast<float>(key.size()) - ui.px(kKeyMark + kKeyGap);
  float x = right_top.x;
  // From the right; clang 14 cannot read this library's std::views::reverse.
  for (std::size_t i = key.size(); i-- > 0;) {
    const std::string label = fitted(*ui.fonts.small, key[i].label, share);
    x -= small_width(ui, label);
    small_text(ui, {x, right_top.y}, color::kTextDim, label);
    x -= ui.px(kKeyMark);
    const float middle = right_top.y + 0.5F * line;
    ImGui::GetWindowDrawList()->AddRectFilled({x, middle - ui.px(1)}, {x + ui.px(9), middle + ui.px(1.5F)},
                                              key[i].color);
    x -= ui.px(kKeyGap);
  }
}

struct PlotPlace {
  std::string name, title;
  float height = 0;
  float labels = 0;  // width of those at the vertical axis
};

// Title at the left, key at the right or below it; reserves the plot's place. Returns the data's rectangle.
Rect begin_plot(const Ui& ui, const PlotPlace& place, std::span<const KeyEntry> key) {
  const float line = ui.fonts.small->FontSize;
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::GetWindowDrawList()->AddText(ui.fonts.heading, line, low, color::kTextDim, place.title.c_str());
  const float beside = width - text_width(*ui.fonts.heading, place.title) - ui.px(4);
  const bool below = key_width(ui, key) > beside;
  const float top = below ? low.y + line + ui.px(2) : low.y;
  draw_key(ui, key, {low.x + width, top}, below ? width : beside);
  mark_area(ui, place.name + "/key",
            {{low.x + width - std::min(width, key_width(ui, key)), top}, {low.x + width, top + line}});
  mark_area(ui, place.name + "/title", {low, {low.x + width - beside - ui.px(4), low.y + line}});
  const std::string id = "##plot-" + place.name;
  ImGui::InvisibleButton(id.c_str(), {width, place.height});
  const ImVec2 high = ImGui::GetItemRectMax();
  const Rect area{{low.x + std::max(ui.px(42), place.labels + ui.px(7)), top + line + ui.px(8)},
                  {high.x - ui.px(4), high.y - line - ui.px(5)}};
  mark_area(ui, place.name, area);
  return area;
}

void draw_x_tick(const Ui& ui, const Frame& frame, double value, const std::string& text) {
  const float x = frame.x(value);
  const float width = small_width(ui, text);
  const float at =
      std::clamp(x - 0.5F * width, frame.area.low.x - 0.5F * width, frame.area.high.x + ui.px(4) - width);
  small_text(ui, {at, frame.area.high.y + ui.px(4)}, color::kTextFaint, text);
  ImGui::GetWindowDrawList()->AddLine({x, frame.area.high.y}, {x, frame.area.high.y + ui.px(3)}, kAxis);
}

void draw_y_tick(const Ui& ui, const Frame& frame, double value, const std::string& text) {
  const float y = std::floor(frame.y(value)) + 0.5F;
  ImGui::GetWindowDrawList()->AddLine({frame.area.low.x, y}, {frame.area.high.x, y}, kGridLine);
  small_text(ui, {frame.area.low.x - ui.px(6) - small_width(ui, text), y - 0.55F * ui.fonts.small->FontSize},
             color::kTextFaint, text);
}

void read_out(const Ui& ui, std::string_view first, std::span<const std::pair<std::string, ImU32>> lines) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(10), ui.px(8)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(8), ui.px(3)});
  ImGui::BeginTooltip();
  text_in(ui.fonts.small, color::kTextDim, first);
  for (const auto& [text, color] : lines) text_in(ui.fonts.text, color, text);
  ImGui::EndTooltip();
  ImGui::PopStyleVar(2);
}

void draw_line(ImDrawList& draw, const Frame& frame, const Line& line, PlotScale scale, float width) {
  const auto value = [&](float y) {
    return scale == PlotScale::logarithmic ? std::log10(std::max(1e-300, double{y})) : y;
  };
  std::vector<ImVec2> piece;
  const auto flush = [&] {
    if (piece.size() > 1)
      draw.AddPolyline(piece.data(), static_cast<int>(piece.size()), line.color, ImDrawFlags_None, width);
    else if (piece.size() == 1)
      draw.AddCircleFilled(piece[0], 1.6F * width, line.color);
    piece.clear();
  };
  for (std::size_t k = 0; k < line.points.size(); ++k) {
    if (line.new_start[k]) flush();
    const ImVec2 at{frame.x(line.points[k].x), frame.y(value(line.points[k].y))};
    // Points that fall on one pixel column add nothing.
    if (piece.empty() || at.x - piece.back().x >= 0.5F || k + 1 == line.points.size()) piece.push_back(at);
  }
  flush();
}

void hover_lines(const Ui& ui, const Frame& frame, const LinePlot& plot) {
  if (!ImGui::IsItemHovered() || plot.lines.empty() || plot.lines.front().points.empty()) return;
  const auto& points = plot.lines.front().points;
  const float x = ImGui::GetIO().MousePos.x;
  const auto nearest =
      std::ranges::min_element(points, {}, [&](const ImVec2& p) { return std::abs(frame.x(p.x) - x); });
  const float at = std::floor(frame.x(nearest->x)) + 0.5F;
  ImGui::GetWindowDrawList()->AddLine({at, frame.area.low.y}, {at, frame.area.high.y}, kAxis);
  std::vector<std::pair<std::string, ImU32>> lines;
  for (const Line& line : plot.lines) {
    // Lines may begin and end elsewhere than the first one.
    const auto own = std::ranges::find(line.points, nearest->x, &ImVec2::x);
    if (own == line.points.end()) continue;
    lines.emplace_back(line.label + "  " + number_text(plot.format.c_str(), own->y) + plot.unit, line.color);
  }
  read_out(ui, plot.x_name + " " + number_text(plot.x_format.c_str(), nearest->x), lines);
}

}  // namespace

std::vector<double> round_ticks(double low, double high, int wanted) {
  std::vector<double> ticks;
  if (!(high > low) || wanted < 1) return ticks;
  const double raw = (high - low) / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10 * power;
  for (const double m : {1.0, 2.0, 5.0})
    if (m * power >= raw * (1 - 1e-9)) {
      step = m * power;
      break;
    }
  for (double n = std::ceil(low / step - 1e-9) + 0.0; n * step <= high + 1e-9 * step; ++n)
    ticks.push_back(n * step);
  return ticks;
}

std::vector<std::string> tick_labels(std::span<const double> ticks) {
  constexpr int kMostDecimals = 12;
  std::vector<std::string> labels;
  for (int decimals = 0; decimals <= kMostDecimals; ++decimals) {
    labels.clear();
    for (const double tick : ticks) labels.push_back(short_number(tick, decimals));
    // Ticks ascend: equal ones are neighbours.
    if (std::ranges::adjacent_find(labels) == labels.end()) break;
  }
  return labels;
}

void fit_range(LinePlot& plot) {
  double low = INFINITY;
  double high = -INFINITY;
  for (const Line& line : plot.lines)
    for (const ImVec2& point : line.points) {
      if (!std::isfinite(point.y)) continue;
      low = std::min(low, double{point.y});
      high = std::max(high, double{point.y});
    }
  if (low > high) return;
  const bool wide = low > 0 && high > 20 * low;
  plot.scale = wide ? PlotScale::logarithmic : PlotScale::linear;
  const double pad = std::max(0.08 * (high - low), 1e-3 * std::abs(high));
  plot.low = wide ? low * 0.9 : low - pad;
  plot.high = wide ? high * 1.1 : high + pad;
}

void draw_bars(const Ui& ui, const Bars& bars, float height) {
  constexpr ImU32 kFill = IM_COL32(242, 140, 79, 190);
  const std::array key{KeyEntry{"current", kFill}, KeyEntry{"original", kOutline}};
  Frame frame{begin_plot(ui, {bars.name, bars.title, height}, key), bars.low, bars.high, 0, 1};
  if (frame.area.height() < 8 || bars.now.empty()) return;
  frame.y1 = static_cast<double>(std::max<std::size_t>(
      {1, *std::ranges::max_element(bars.now), *std::ranges::max_element(bars.before)}));
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  std::vector<double> counts = round_ticks(0, frame.y1, 2);
  if (counts.size() < 2) counts = round_ticks(0, frame.y1, 3);
  for (const double t : counts) draw_y_tick(ui, frame, t, short_number(t));
  for (const double t : bars.ticks)
    draw_x_tick(ui, frame, t, short_number(t) + (t == bars.ticks.back() ? bars.unit : ""));
  const double bin = (bars.high - bars.low) / static_cast<double>(bars.now.size());
  std::vector<ImVec2> outline{{frame.area.low.x, frame.area.high.y}};
  for (std::size_t k = 0; k < bars.now.size(); ++k) {
    const double from = bars.low + bin * static_cast<double>(k);
    const float x0 = frame.x(from);
    const float x1 = frame.x(from + bin);
    if (bars.now[k] > 0)
      draw.AddRectFilled(
          {x0 + 0.5F, std::min(frame.y(static_cast<double>(bars.now[k])), frame.area.high.y - 1)},
          {x1 - 0.5F, frame.area.high.y}, kFill);
    const float y = frame.y(static_cast<double>(bars.before[k]));
    outline.insert(outline.end(), {{x0, y}, {x1, y}});
  }
  outline.push_back({frame.area.high.x, frame.area.high.y});
  draw.AddPolyline(outline.data(), static_cast<int>(outline.size()), kOutline, ImDrawFlags_None,
                   ui.px(1.25F));
  draw.AddLine({frame.area.low.x, frame.area.high.y}, frame.area.high, kAxis);
  if (!ImGui::IsItemHovered()) return;
  const double at = (ImGui::GetIO().MousePos.x - frame.area.low.x) / frame.area.width();
  if (at < 0 || at >= 1) return;
  const auto k = static_cast<std::size_t>(at * static_cast<double>(bars.now.size()));
  const double from = bars.low + bin * static_cast<double>(k);
  std::string range = short_number(from) + " to " + short_number(from + bin) + bars.unit;
  if (k + 1 == bars.now.size() && bars.above_now + bars.above_before > 0)
    range += ", beyond: " + count_text(bars.above_now) + " (was " + count_text(bars.above_before) + ")";
  const std::array lines{std::pair{"current  " + count_text(bars.now[k]), color::kAccent},
                         std::pair{"original  " + count_text(bars.before[k]), color::kText}};
  read_out(ui, range, lines);
}

namespace {

std::vector<double> value_ticks(const LinePlot& plot) {
  if (!plot.ticks.empty()) return plot.ticks;
  if (plot.scale == PlotScale::linear) return round_ticks(plot.low, plot.high, 3);
  std::vector<double> ticks;
  const double low = std::log10(plot.low);
  const double high = std::log10(plot.high);
  for (double e = std::ceil(low); e <= high; e += std::max(1.0, std::floor((high - low) / 3)))
    ticks.push_back(std::pow(10.0, e));
  return ticks;
}

double last_of(const LinePlot& plot) {
  double last = plot.x_end;
  for (const Line& line : plot.lines)
    if (!line.points.empty()) last = std::max(last, static_cast<double>(line.points.back().x));
  return last;
}

}  // namespace

void draw_lines(const Ui& ui, const LinePlot& plot, float height) {
  std::vector<KeyEntry> key;
  if (plot.lines.size() > 1)
    for (const Line& line : plot.lines) key.push_back({line.label, line.color});
  const std::vector<double> ticks = value_ticks(plot);
  std::vector<std::string> labels = tick_labels(ticks);
  float widest = 0;
  for (std::string& label : labels) widest = std::max(widest, small_width(ui, label += plot.unit));
  Frame frame{begin_plot(ui, {plot.name, plot.title, height, widest}, key), 0, last_of(plot), plot.low,
              plot.high};
  if (frame.area.height() < 8) return;
  const bool logarithmic = plot.scale == PlotScale::logarithmic;
  if (logarithmic) {
    frame.y0 = std::log10(plot.low);
    frame.y1 = std::log10(plot.high);
  }
  for (std::size_t k = 0; k < ticks.size(); ++k)
    draw_y_tick(ui, frame, logarithmic ? std::log10(ticks[k]) : ticks[k], labels[k]);
  for (const double t : round_ticks(0, frame.x1, 4))
    if (!plot.whole_numbers || t == std::floor(t)) draw_x_tick(ui, frame, t, short_number(t));
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddLine({frame.area.low.x, frame.area.high.y}, frame.area.high, kAxis);
  for (const Line& line : plot.lines) draw_line(draw, frame, line, plot.scale, ui.px(1.75F));
  // At the end it says nothing.
  if (plot.marker && *plot.marker<frame.x1&& * plot.marker> 0) {
    const float x = std::floor(frame.x(*plot.marker)) + 0.5F;
    draw.AddLine({x, frame.area.low.y}, {x, frame.area.high.y}, faded(color::kText, 0.45F), ui.px(1));
  }
  hover_lines(ui, frame, plot);
}

}  // namespace isorelax::ui
