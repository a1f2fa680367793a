#include <algorithm>
#include <array>
#include <utility>

#include "model/executor.h"
#include "quality/inverted.h"

namespace isorelax::model {

std::size_t Session::rank_of_worst() const {
  return current && worst_rank_of_ == current->geometry ? worst_rank_ : 0;
}

std::span<const double> Executor::worst_values() {
  const auto by = [&](Coloring coloring) { return s_.current->values(coloring); };
  FaceMetric metric = FaceMetric::shape;
  switch (s_.worst_by) {
    case WorstBy::coloring:
      return by(s_.view.coloring == Coloring::none ? Coloring::min_angle : s_.view.coloring);
    case WorstBy::min_angle:
      return by(Coloring::min_angle);
    case WorstBy::max_angle:
      return by(Coloring::max_angle);
    case WorstBy::area:
      return by(Coloring::relative_area);
    case WorstBy::energy:
      return by(Coloring::energy);
    case WorstBy::shape:
      break;
    case WorstBy::radius_ratio:
      metric = FaceMetric::radius_ratio;
      break;
    case WorstBy::scaled_jacobian:
      metric = FaceMetric::scaled_jacobian;
      break;
    case WorstBy::aspect_ratio:
      metric = FaceMetric::aspect_ratio;
      break;
    case WorstBy::inverted:
      break;
  }
  if (s_.worst_values_of_ != s_.current->geometry || s_.worst_values_by_ != s_.worst_by) {
    const auto& triangles = s_.document->mesh().triangles;
    if (s_.worst_by == WorstBy::inverted) {
      s_.worst_values_.assign(triangles.size(), 0);
      for (const Index t : inverted_triangles(s_.current->positions(), triangles, s_.document->topology))
        s_.worst_values_[t] = 1;
    } else {
      s_.worst_values_ = face_metric(metric, s_.current->positions(), triangles);
    }
    s_.worst_values_of_ = s_.current->geometry;
    s_.worst_values_by_ = s_.worst_by;
  }
  return s_.worst_values_;
}

void Executor::operator()(const SelectNextWorst& /*command*/) {
  if (!s_.current) return;
  const bool by_color = s_.worst_by == WorstBy::coloring;
  const auto values = worst_values();
  if (values.empty()) return;
  const bool small_is_worse =
      s_.worst_by == WorstBy::min_angle || s_.worst_by == WorstBy::radius_ratio ||
      s_.worst_by == WorstBy::scaled_jacobian ||
      (by_color && (s_.view.coloring == Coloring::min_angle || s_.view.coloring == Coloring::none));
  const double sign = small_is_worse ? 1 : -1;  // smaller key: worse
  using Key = std::pair<double, Index>;
  const auto key = [&](Index t) { return Key{sign * values[t], t}; };
  // A triangle that was chosen otherwise is no place to go on from.
  const std::optional<Index> last = s_.rank_of_worst() > 0 ? s_.selected_triangle : std::nullopt;
  std::optional<Key> best;
  for (Index t = 0; t < values.size(); ++t) {
    if (last && key(t) <= key(*last)) continue;
    if (s_.worst_by == WorstBy::inverted && values[t] == 0) continue;
    if (!best || key(t) < *best) best = key(t);
  }
  const std::size_t rank = best ? s_.rank_of_worst() + 1 : 0;
  clear_selection();
  s_.worst_rank_ = rank;
  s_.worst_rank_of_ = s_.current->geometry;
  if (best) s_.selected_triangle = best->second;
  if (!best && s_.worst_by == WorstBy::inverted)
    say(MessageKind::info, "No other triangle lies upside down.");
  ask_about_step();
}

void Executor::operator()(const ClearSelection& /*command*/) {
  clear_selection();
  s_.selected_limit.reset();
}

std::string_view title(WorstBy by) {
  constexpr std::array<std::string_view, kWorstBy> kTitles{
      "what the colours say", "smallest angle",  "largest angle", "area",       "energy", "shape K",
      "radius ratio",         "scaled Jacobian", "aspect ratio",  "upside down"};
  return kTitles.at(static_cast<std::size_t>(by));
}

void Executor::operator()(const SelectVertex& command) {
  if (!s_.document || command.vertex >= s_.document->mesh().vertex_count()) {
    if (s_.document)
      say(MessageKind::info, "There is no vertex " + std::to_string(command.vertex) + ": the last is " +
                                 std::to_string(s_.document->mesh().vertex_count() - 1) + ".");
    return;
  }
  clear_selection();
  s_.selected_vertex = command.vertex;
  ask_about_step();
}

void Executor::operator()(const SelectTriangle& command) {
  if (!s_.document || command.triangle >= s_.document->mesh().triangle_count()) {
    if (s_.document)
      say(MessageKind::info, "There is no triangle " + std::to_string(command.triangle) + ": the last is " +
                                 std::to_string(s_.document->mesh().triangle_count() - 1) + ".");
    return;
  }
  clear_selection();
  s_.selected_triangle = command.triangle;
  ask_about_step();
}

void Executor::clear_selection() {
  s_.selected_triangle.reset();
  s_.selected_vertex.reset();
  s_.worst_rank_ = 0;
  s_.inspection.vertex.reset();
  s_.inspection.triangle.reset();
  s_.inspection.path.reset();
}

void Executor::operator()(const SelectLimited& command) {
  s_.selected_limit = command.bit;
  if (command.bit && !s_.view.reasons) s_.view.reasons = true;
  ask_about_step();
}

void Executor::operator()(const SetWorstBy& command) {
  s_.worst_by = command.by;
  s_.worst_rank_ = 0;
}

void Executor::operator()(const TogglePin& command) {
  if (!s_.document || command.vertex >= s_.document->mesh().vertex_count() || s_.is_running()) return;
  if (s_.moving() != nullptr) {
    say(MessageKind::info, "Vertices of a moving surface cannot be pinned.");
    return;
  }
  SmoothingSettings settings = s_.smoothing;
  const auto at = std::ranges::lower_bound(settings.pinned, command.vertex);
  const bool held = at != settings.pinned.end() && *at == command.vertex;
  if (held)
    settings.pinned.erase(at);
  else
    settings.pinned.insert(at, command.vertex);
  (*this)(SetSmoothing{settings, (held ? "Unpin vertex " : "Pin vertex ") + std::to_string(command.vertex)});
  s_.undo.stop_merging();
}

}  // namespace isorelax::model
