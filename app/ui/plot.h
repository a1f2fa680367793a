#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ui/ui_state.h"

namespace isorelax::ui {

/// Round numbers (1, 2 or 5 times a power of ten apart) inside low..high, about `wanted` of them.
[[nodiscard]] std::vector<double> round_ticks(double low, double high, int wanted);

/// Labels of ascending ticks, with as many digits as tell them apart.
[[nodiscard]] std::vector<std::string> tick_labels(std::span<const double> ticks);

struct Bars {
  std::string name{};  ///< identity, and what a test finds
  std::string title{};
  std::string unit{};  ///< of the horizontal axis
  std::span<const std::size_t> now{}, before{};
  double low = 0, high = 1;
  std::vector<double> ticks{};
  std::size_t above_now = 0, above_before = 0;  ///< beyond `high`: told in the read-out of the last bar
};
/// Bars of what is over an outline of what was, with a read-out under the pointer.
void draw_bars(const Ui& ui, const Bars& bars, float height);

struct Line {
  std::string label{};
  ImU32 color = color::kAccent;
  std::vector<ImVec2> points{};   ///< iteration (or time) and value, ascending
  std::vector<bool> new_start{};  ///< the point begins a piece of its own
};
enum class PlotScale : std::uint8_t { linear, logarithmic };
struct LinePlot {
  std::string name{};
  std::string title{};
  std::string format = "%.4g";  ///< of the read-out
  std::string unit{};
  std::vector<Line> lines{};
  PlotScale scale = PlotScale::linear;
  double low = 0, high = 1;
  std::vector<double> ticks{};     ///< empty: round numbers
  std::optional<double> marker{};  ///< a place that is marked
  // The horizontal axis.
  std::string x_name = "Iteration";
  std::string x_format = "%.0f";
  double x_end = 10;          ///< at least so far
  bool whole_numbers = true;  ///< only these are written at it
};
/// Sets scale and range so that all lines have room; over some decades on a logarithmic scale.
void fit_range(LinePlot& plot);
/// Lines over iterations or time, with a read-out under the pointer.
void draw_lines(const Ui& ui, const LinePlot& plot, float height);

}  // namespace isorelax::ui
