#include "ui/inspector_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "ui/plot.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

constexpr std::string_view kDegree = "\xC2\xB0";

std::string percent(double share) {
  return number_text("%.3g", 100 * share) + " %";
}

std::string vector_text(const Vec3& v) {
  return number_text("%.4g", v.x()) + ", " + number_text("%.4g", v.y()) + ", " + number_text("%.4g", v.z());
}

std::string exact_vector(const Vec3& v) {
  return exact_text(v.x()) + " " + exact_text(v.y()) + " " + exact_text(v.z());
}

/// A figure before the step and, where it looks different, after it.
void change_row(const Ui& ui, std::string_view name, std::string_view label, double before, double after,
                std::string_view tip) {
  ValueRow row = number_row(name, label, before, "", tip);
  if (const std::string text = number_text("%.4g", after); text != row.shown) {
    row.shown += " to " + text;
    row.exact += " " + exact_text(after);
  }
  value_row(ui, row);
}

std::string angles_text(const TriangleMoment& state) {
  std::string text;
  for (const double angle : state.angles_deg)
    text += (text.empty() ? "" : ", ") + number_text("%.2f", angle) + std::string(kDegree);
  return text;
}

void vector_row(const Ui& ui, std::string_view name, std::string_view label, const Vec3& v,
                std::string_view tip) {
  value_row(ui, {name, label, vector_text(v), exact_vector(v), tip});
}

// A share of a width as a bar, with a mark where the threshold is.
void measure_row(const Ui& ui, std::string_view name, std::string_view label, const ClassMeasure& measure,
                 std::string_view tip) {
  const bool over = measure.value >= measure.threshold;
  value_row(ui, {name, label,
                 number_text("%.1f", measure.value) + std::string(kDegree) + " of " +
                     number_text("%.0f", measure.threshold) + std::string(kDegree),
                 exact_text(measure.value), tip, over ? color::kWarning : color::kText});
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const double full = 1.5 * measure.threshold;
  const auto x = [&](double value) {
    return low.x + width * static_cast<float>(std::clamp(value / full, 0.0, 1.0));
  };
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float y = std::floor(low.y - ui.px(2));
  draw.AddRectFilled({low.x, y}, {low.x + width, y + ui.px(3)}, color::kControl, ui.px(1.5F));
  draw.AddRectFilled({low.x, y}, {x(measure.value), y + ui.px(3)}, over ? color::kWarning : color::kSecond,
                     ui.px(1.5F));
  draw.AddRectFilled({x(measure.threshold), y - ui.px(2)}, {x(measure.threshold) + ui.px(1.5F), y + ui.px(5)},
                     color::kText);
  ImGui::Dummy({0, ui.px(1)});
}

std::string agreement(double error, double limit) {
  return error < limit ? "agrees" : "differs by " + percent(error);
}

// A share of a triangle's gradient: its number, and bars for both terms.
void share_row(const Ui& ui, const TriangleShare& share, double largest, bool both) {
  const std::string name = "share/" + std::to_string(share.triangle);
  if (link(ui, name, std::to_string(share.triangle))) {
    ui.command(model::SelectTriangle{share.triangle});
    ui.request(FlyToSelection{});
  }
  tooltip(ui, "Inspect this triangle.");
  ImGui::SameLine(ui.px(72));
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::PushID(name.c_str());
  if (ImGui::InvisibleButton("bars", {width, ImGui::GetTextLineHeight()}))
    ImGui::SetClipboardText((exact_vector(share.shape) + "\n" + exact_vector(share.area)).c_str());
  ImGui::PopID();
  const double values[2] = {share.shape.norm(), share.area.norm()};
  tooltip(ui,
          "Shape " + vector_text(share.shape) + (both ? "\nArea " + vector_text(share.area) : std::string()),
          "Click to copy both");
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float number = ui.px(58);
  const float bar = (width - 2 * number) / 2;
  for (int k = 0; k < (both ? 2 : 1); ++k) {
    const float x = low.x + static_cast<float>(k) * (number + bar);
    const std::string text = number_text("%.3g", values[k]);
    draw.AddText({x, low.y}, color::kText, text.c_str());
    const float length = largest > 0 ? bar * static_cast<float>(values[k] / largest) * 0.9F : 0;
    const float y = low.y + 0.5F * ImGui::GetTextLineHeight() - ui.px(3);
    draw.AddRectFilled({x + number, y}, {x + number + length, y + ui.px(6)},
                       k == 0 ? color::kSecond : color::kWarning, ui.px(2));
  }
}

}  // namespace

std::string limit_text(std::uint16_t limits) {
  std::string text;
  for (unsigned bit = 0; bit < kLimitBits; ++bit)
    if ((limits >> bit & 1U) != 0)
      text += (text.empty() ? "" : ", ") + std::string(limit_name(limit_of_bit(bit)));
  return text.empty() ? "nothing" : text;
}

std::string why_sentence(const VertexExplanation& e) {
  const auto has = [&](Limit limit) { return (e.limits & limit) != 0; };
  const double asked = e.displacement.norm();
  if (asked == 0) {
    if (has(kLimitPinned)) return "It stays: it is pinned.";
    if (has(kLimitConverged)) return "It stays: it asks for no move worth making.";
    if (has(kLimitSurface)) return "It stays: it would leave the surface by more than is allowed.";
    if (has(kLimitCorner)) return "It stays: it is a corner, which has no direction to move in.";
    if (has(kLimitBoundary)) return "It stays: it is on the border of the surface, which is held.";
    if (has(kLimitRidge)) return "It stays: it is on a ridge that is held.";
    return "It stays: nothing asks it to move.";
  }
  std::string why;
  if (e.set_by != kNone)
    why = "triangle " + std::to_string(e.set_by) + " would have folded or become too sharp";
  else if (has(kLimitFold))
    why = "triangles at many vertices would have folded or become too sharp";
  if (has(kLimitSurface))
    why += std::string(why.empty() ? "" : ", and ") + "the surface would have gone too far from where it was";
  if (has(kLimitEnergy)) why += std::string(why.empty() ? "" : ", and ") + "the energy would have risen";
  const std::string where = e.dimensions == 1 ? " along its line" : "";
  if (e.alpha == 0) return "It was stopped: " + why + ".";
  std::string text = "It moves by " + number_text("%.4g", e.alpha * asked) + where + ", ";
  if (e.alpha == 1 && has(kLimitSurface))
    return text + "sliding along the largest distance from the surface.";
  if (e.alpha == 1) return text + "all that it asked for.";
  return text + percent(e.alpha) + " of what it asked for: further, " + why + ".";
}

std::string triangle_sentence(const TriangleExplanation& e) {
  if (!e.treated) return "It takes no part: it is flawed, and its vertices are held.";
  const double from = e.before.metrics.min_angle_deg, to = e.after.metrics.min_angle_deg;
  const double change = to - from;
  const std::string how = std::abs(change) < 0.005 ? "stays at " : change > 0 ? "rises from " : "falls from ";
  std::string text = "Its smallest angle " + how + number_text("%.2f", from) + std::string(kDegree);
  if (std::abs(change) >= 0.005) text += " to " + number_text("%.2f", to) + std::string(kDegree);
  return text + " in this step.";
}

void draw_move_section(const Ui& ui, const VertexExplanation& e) {
  heading(ui, "MOVE");
  value_row(ui, number_row("move/proposed", "Proposed", e.proposed.norm(), "",
                           "Length of the move that the solver asked for, in units of the file."));
  if ((e.displacement - e.proposed).norm() > 1e-9 * e.proposed.norm())
    value_row(ui, number_row("move/bent", "Bent to the surface", e.displacement.norm(), "",
                             "Its length once it leads back to the surface as it was."));
  if (e.proposed.norm() > 0 && e.tangent.norm() > 0) {
    const double cosine = -e.proposed.dot(e.tangent) / (e.proposed.norm() * e.tangent.norm());
    const double angle = 180 / std::numbers::pi * std::acos(std::clamp(cosine, -1.0, 1.0));
    value_row(ui, {"move/downhill", "Angle to downhill", number_text("%.1f", angle) + std::string(kDegree),
                   exact_text(angle),
                   "Between the proposed move and minus the gradient in the tangent space. Above 90 degrees "
                   "it points uphill: methods without an energy may, so may single vertices of L-BFGS and of "
                   "the steps that even the mesh out.",
                   angle > 90 ? color::kWorse : color::kText});
  }
  value_row(ui, {"move/alpha", "Accepted share \xCE\xB1", percent(e.alpha), exact_text(e.alpha),
                 "Share of the move that the step control and the energy guard left."});
  value_row(ui, number_row("move/made", "Moved by", e.alpha * e.displacement.norm(), "",
                           "Length of the move that was made, in units of the file."));
  value_row(ui, {"move/limits",
                 "Limited by",
                 limit_text(e.limits),
                 {},
                 "What kept it from its gradient's move.",
                 e.limits == 0 ? color::kText : color::kWarning});
  if (e.set_by != kNone) {
    ImGui::AlignTextToFramePadding();
    text_in(ui.fonts.text, color::kTextDim, "Share set by");
    const std::string label = "triangle " + std::to_string(e.set_by);
    ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(label.c_str()).x);
    if (link(ui, "set-by", label)) {
      ui.command(model::SelectTriangle{e.set_by});
      ui.request(FlyToSelection{});
    }
  }
  vector_row(ui, "move/before", "From", e.before, "Position before the step, in units of the file.");
  vector_row(ui, "move/after", "To", e.after, "Position after the step.");
}

void draw_gradient_section(const Ui& ui, const VertexExplanation& e) {
  heading(ui, "GRADIENT");
  value_row(ui, number_row("gradient/norm", "Length", e.gradient.norm(), "",
                           "2-norm of the energy's gradient, energy per length."));
  value_row(ui, number_row("gradient/tangent", "In the tangent space", e.tangent.norm(), "",
                           "Length of what can be followed."));
  vector_row(ui, "gradient/vector", "Vector", e.gradient, "All three components.");
  const bool shares_agree = e.share_error < kShareErrorLimit;
  const bool quotient_agrees = e.quotient_error < kQuotientErrorLimit;
  value_row(ui, {"check/shares", "Sum of its triangles", agreement(e.share_error, kShareErrorLimit),
                 exact_text(e.share_error),
                 "The gradients of its triangles by the plain formulas, added up, against the step's record. "
                 "A difference is a fault in the program.",
                 shares_agree ? color::kBetter : color::kWorse});
  value_row(ui, {"check/quotient", "Difference quotient", agreement(e.quotient_error, kQuotientErrorLimit),
                 exact_text(e.quotient_error),
                 "The energy measured a little to each side, against the step's record. A difference is a "
                 "fault in the formulas.",
                 quotient_agrees ? color::kBetter : color::kWorse});
  if (e.shares.empty()) return;
  double largest = 0;
  bool both = false;
  for (const TriangleShare& s : e.shares) {
    largest = std::max({largest, s.shape.norm(), s.area.norm()});
    both = both || s.area.norm() > 0;
  }
  ImGui::Dummy({0, ui.px(2)});
  text_in(ui.fonts.small, color::kTextFaint, "triangle");
  ImGui::SameLine(ui.px(72));
  text_in(ui.fonts.small, color::kSecond, "shape term");
  if (both) {
    ImGui::SameLine(ui.px(72) + 0.5F * (ImGui::GetContentRegionMax().x - ui.px(72)));
    text_in(ui.fonts.small, color::kWarning, "area term");
  }
  for (const TriangleShare& s : e.shares) share_row(ui, s, largest, both);
}

void draw_class_section(const Ui& ui, const VertexExplanation& e) {
  heading(ui, "CLASS");
  constexpr std::array<std::string_view, 3> kFreedom{"nowhere", "along a line", "in a plane"};
  value_row(ui,
            {"class/name",
             std::string_view("Class"),
             std::string(to_string(e.tangent_class)) + ", moves " + std::string(kFreedom.at(e.dimensions)),
             {},
             "Decided on the mesh as opened, before anything moves."});
  value_row(ui, {"class/margin", "Margin", number_text("%.1f", e.margin_deg) + std::string(kDegree),
                 exact_text(e.margin_deg), "How far what decided is from another class."});
  measure_row(ui, "class/spread", "Spread of normals", e.spread,
              "2 atan sqrt(l2 / l1) of the eigenvalues; from the threshold on a crease may run here.");
  measure_row(
      ui, "class/edge", "Sharpest edge", e.sharpest_edge,
      "Largest dihedral turn of its edges; a flat face that is meshed ends in a ridge from 2 degrees on.");
  measure_row(ui, "class/defect", "Angle defect", e.angle_defect,
              "2 pi minus the sum of angles; from the threshold on a corner.");
  measure_row(ui, "class/turn", "Turn of its line", e.turn,
              "Of the ridge or border through it; from the threshold on a corner.");
  value_row(ui, {"class/eigenvalues", "Eigenvalues", vector_text(e.eigenvalues), exact_vector(e.eigenvalues),
                 "Of the normal covariance, area-weighted, in squared units of length."});
  for (std::size_t k = 0; k < e.basis.size(); ++k)
    vector_row(ui, k == 0 ? "class/basis1" : "class/basis2", k == 0 ? "Tangent 1" : "Tangent 2", e.basis[k],
               "Unit vector of the tangent space.");
}

void draw_path_section(const Ui& ui) {
  const auto& path = ui.session.inspection.path;
  if (!path || path->positions.size() < 2) return;
  heading(ui, "HISTORY");
  Line distance{"distance", color::kAccent, {}, {}};
  double highest = 0;
  for (std::size_t k = 0; k < path->positions.size(); ++k) {
    const double d = (path->positions[k] - path->positions.front()).norm();
    highest = std::max(highest, d);
    distance.points.emplace_back(static_cast<float>(k), static_cast<float>(d));
    distance.new_start.push_back(k == 0);
  }
  draw_lines(ui,
             {.name = "path-plot",
              .title = "DISTANCE FROM WHERE IT STARTED",
              .lines = {std::move(distance)},
              .high = highest > 0 ? 1.08 * highest : 1,
              .marker = ui.session.timeline.cursor.iteration},
             ui.px(120));
}

void draw_triangle_sections(const Ui& ui, const TriangleExplanation& e) {
  heading(ui, "CORNERS");
  for (std::size_t k = 0; k < 3; ++k) {
    const CornerMove& corner = e.corners.at(k);
    const std::string label = "vertex " + std::to_string(corner.vertex);
    if (link(ui, "corner/" + std::to_string(k), label)) {
      ui.command(model::SelectVertex{corner.vertex});
      ui.request(FlyToSelection{});
    }
    tooltip(ui, "Inspect this vertex.");
    const double length = corner.move.norm();
    std::string what = length > 0 ? "moves " + number_text("%.3g", length) : "stays";
    if (corner.limits != 0) what += ": " + limit_text(corner.limits);
    const float right = ImGui::GetContentRegionMax().x;
    const std::string shown = fitted(*ui.fonts.text, what, right - ui.px(82));
    ImGui::SameLine(right - text_width(*ui.fonts.text, shown));
    text_in(ui.fonts.text, color::kText, shown);
    if (shown != what) tooltip(ui, what);
  }
  const TriangleMoment &was = e.before, &is = e.after;
  heading(ui, "ENERGY");
  change_row(ui, "triangle/shape", "Shape K", was.shape, is.shape, "2 for the shape of the reference.");
  change_row(ui, "triangle/area-term", "Area S", was.area, is.area, "2 for the area of the reference.");
  change_row(ui, "triangle/energy", "Energy E", was.energy, is.energy, "(1 - mu) K + mu S");
  heading(ui, "SIZE AND SHAPE");
  value_row(ui,
            {"triangle/angles", "Angles before", angles_text(was), {}, "At its corners, before the step."});
  value_row(ui, {"triangle/angles-after", "after", angles_text(is), {}, "At its corners, after the step."});
  change_row(ui, "triangle/area", "Area", was.metrics.area, is.metrics.area, "Squared units of the file.");
  value_row(ui, number_row("triangle/reference-area", "Reference's area", e.reference_area, "",
                           "Squared units of the file."));
  change_row(ui, "triangle/ratio", "Area over reference", was.metrics.area / e.reference_area,
             is.metrics.area / e.reference_area, "1 is what the area term asks for.");
  change_row(ui, "triangle/most", "Singular value of A", was.singular_values[0], is.singular_values[0],
             "Larger singular value of A, which maps the reference to the triangle.");
  change_row(ui, "triangle/least", "and the smaller", was.singular_values[1], is.singular_values[1],
             "Smaller singular value of A.");
}

}  // namespace isorelax::ui
