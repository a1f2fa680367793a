#include <algorithm>
#include <cmath>
#include <limits>

#include "ui/inspector_parts.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

// A plane seen from above, fitted into a rectangle.
struct Sheet {
  Vec3 origin = Vec3::Zero(), right = Vec3::UnitX(), up = Vec3::UnitY();
  ImVec2 center{0, 0};
  float scale = 1;  // pixels per unit of length

  [[nodiscard]] ImVec2 at(const Vec3& p) const {
    const Vec3 d = p - origin;
    return {center.x + scale * static_cast<float>(d.dot(right)),
            center.y - scale * static_cast<float>(d.dot(up))};
  }
};

// The vertex' tangent plane; where it has none, the plane of the area-weighted normal.
void lay_sheet(const Ui& ui, const VertexExplanation& e, std::span<const Vec3> x, Sheet& sheet) {
  const model::Document& document = *ui.session.document;
  const auto& triangles = document.mesh().triangles;
  Vec3 normal = Vec3::Zero();
  for (const Corner c : document.topology.corners_of(e.vertex)) {
    const Triangle& t = triangles[c / 3];
    normal += area_vector(x[t[0]], x[t[1]], x[t[2]]);
  }
  if (normal.norm() > 0) normal.normalize();
  // From the side from which the viewport sees it, and as it stands there: moves point the same way in both.
  const Looking& looking = ui.state.looking;
  if (normal.dot(looking.toward_eye) < 0) normal = -normal;
  // Of what is seen edge-on, what is farther away is higher up.
  const bool edge_on = std::abs(normal.dot(looking.up)) > 0.99;
  const Vec3 wanted = !edge_on ? looking.up : Vec3(-looking.toward_eye);
  sheet.origin = e.before;
  sheet.up = (wanted - normal * normal.dot(wanted)).normalized();
  sheet.right = sheet.up.cross(normal);
}

void arrow(ImDrawList& draw, ImVec2 from, ImVec2 to, ImU32 ink, float width) {
  const ImVec2 way{to.x - from.x, to.y - from.y};
  const float length = std::hypot(way.x, way.y);
  if (length < 2) return;
  const float head = std::min(4.5F * width, length);
  const ImVec2 along{way.x / length, way.y / length};
  const ImVec2 neck{to.x - head * along.x, to.y - head * along.y};
  draw.AddLine(from, neck, ink, width);
  draw.AddTriangleFilled(to, {neck.x - 0.5F * head * along.y, neck.y + 0.5F * head * along.x},
                         {neck.x + 0.5F * head * along.y, neck.y - 0.5F * head * along.x}, ink);
}

// Words in the colours of what they name, in one line. Returns where it ends.
float key(const Ui& ui, std::initializer_list<std::pair<const char*, ImU32>> entries, ImVec2 at) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (const auto& [label, ink] : entries) {
    draw.AddText(ui.fonts.small, ui.fonts.small->FontSize, at, ink, label);
    at.x += ui.fonts.small->CalcTextSizeA(ui.fonts.small->FontSize, 1e9F, 0, label).x + ui.px(14);
  }
  return at.x;
}

Rect begin_picture(const Ui& ui, const char* name, float height) {
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::Dummy({width, height});
  const Rect rect{low, {low.x + width, low.y + height}};
  ImGui::GetWindowDrawList()->AddRectFilled(rect.low, rect.high, color::kBackdrop, ui.px(6));
  mark_area(ui, name, rect);
  return rect;
}

}  // namespace

void draw_ring(const Ui& ui, const VertexExplanation& e, float height) {
  const auto& step = ui.session.inspection.step;
  if (!step) return;
  const std::vector<Vec3>& x = *step->before;
  const auto& triangles = ui.session.document->mesh().triangles;
  const Rect rect = begin_picture(ui, "ring", height);
  Sheet sheet;
  lay_sheet(ui, e, x, sheet);
  sheet.center = {rect.center().x, rect.center().y - ui.px(6)};
  double reach = 0;
  for (const Corner c : ui.session.document->topology.corners_of(e.vertex))
    for (const Index v : triangles[c / 3]) reach = std::max(reach, (x[v] - e.before).norm());
  if (!(reach > 0)) return;
  sheet.scale = static_cast<float>((0.5 * height - ui.px(20)) / reach);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.PushClipRect(rect.low, rect.high, true);
  for (const Corner c : ui.session.document->topology.corners_of(e.vertex)) {
    const Triangle& t = triangles[c / 3];
    const ImVec2 a = sheet.at(x[t[0]]);
    const ImVec2 b = sheet.at(x[t[1]]);
    const ImVec2 d = sheet.at(x[t[2]]);
    const bool sets = c / 3 == e.set_by;
    draw.AddTriangleFilled(a, b, d, sets ? faded(color::kWorse, 0.35F) : color::kControl);
    draw.AddTriangle(a, b, d, sets ? color::kWorse : color::kTextFaint, ui.px(1.2F));
  }
  if (const auto& path = ui.session.inspection.path; path && path->positions.size() > 1) {
    std::vector<ImVec2> way;
    for (const Vec3& p : path->positions) way.push_back(sheet.at(p));
    draw.AddPolyline(way.data(), static_cast<int>(way.size()), faded(color::kText, 0.35F), ImDrawFlags_None,
                     ui.px(1));
  }
  const ImVec2 at = sheet.at(e.before);
  // The gradient is no length: it fills a fixed part of the picture.
  if (e.tangent.norm() > 0)
    arrow(draw, at, sheet.at(e.before - 0.55 * reach * e.gradient / e.gradient.norm()),
          faded(color::kStages[0], 0.55F), ui.px(1.2F));
  // Small moves are drawn larger, and that is said.
  double factor = 1;
  while (e.proposed.norm() > 0 && factor < 1e9 && 10 * factor * e.proposed.norm() < 0.9 * reach) factor *= 10;
  arrow(draw, at, sheet.at(e.before + factor * e.proposed), color::kStages[2], ui.px(1.6F));
  arrow(draw, at, sheet.at(e.before + factor * (e.after - e.before)), color::kStages[4], ui.px(2.2F));
  draw.AddCircleFilled(at, ui.px(4), color::kText);
  draw.PopClipRect();
  const float line = rect.high.y - ui.px(20);
  const float end =
      key(ui, {{"downhill", color::kTextDim}, {"proposed", color::kStages[2]}, {"moved", color::kStages[4]}},
          {rect.low.x + ui.px(10), line});
  if (factor <= 1) return;
  const std::string text = "moves \xC3\x97 " + number_text("%.0f", factor);
  const float left = std::floor(rect.high.x - ui.px(10) - text_width(*ui.fonts.small, text));
  const float y = left < end ? rect.low.y + ui.px(8) : line;  // at the top where the line is full
  draw.AddText(ui.fonts.small, ui.fonts.small->FontSize, {left, y}, color::kTextDim, text.c_str());
  mark_area(ui, "ring-factor", {{left, y}, {rect.high.x - ui.px(10), y + ui.fonts.small->FontSize}});
  mark_area(ui, "ring-key", {{rect.low.x + ui.px(10), line}, {end, line + ui.fonts.small->FontSize}});
}

void draw_triangles(const Ui& ui, const TriangleExplanation& e, float height) {
  const Rect rect = begin_picture(ui, "triangles", height);
  double reach = 0;
  for (const FlatTriangle& points : {e.before.outline, e.after.outline, e.reference})
    for (const auto& p : points)
      for (const auto& q : points) reach = std::max({reach, std::abs(p[0] - q[0]), std::abs(p[1] - q[1])});
  if (!(reach > 0)) return;
  const float scale = static_cast<float>(std::min(0.27 * rect.width(), 1.0 * height - ui.px(48)) / reach);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const auto show = [&](const FlatTriangle& points, float middle, ImU32 ink, const char* label) {
    std::array<ImVec2, 3> at;
    const auto [left, right] = std::minmax({points[0][0], points[1][0], points[2][0]});
    const auto [low, high] = std::minmax({points[0][1], points[1][1], points[2][1]});
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = {middle + scale * static_cast<float>(points[k][0] - 0.5 * (left + right)),
               rect.center().y - ui.px(6) - scale * static_cast<float>(points[k][1] - 0.5 * (low + high))};
    draw.AddTriangleFilled(at[0], at[1], at[2], faded(ink, 0.25F));
    draw.AddTriangle(at[0], at[1], at[2], ink, ui.px(1.5F));
    const float width = ui.fonts.small->CalcTextSizeA(ui.fonts.small->FontSize, 1e9F, 0, label).x;
    draw.AddText(ui.fonts.small, ui.fonts.small->FontSize,
                 {std::floor(middle - 0.5F * width), rect.high.y - ui.px(20)}, color::kTextDim, label);
  };
  show(e.before.outline, rect.low.x + 0.18F * rect.width(), color::kTextDim, "before");
  show(e.after.outline, rect.low.x + 0.5F * rect.width(), color::kAccent, "after");
  show(e.reference, rect.low.x + 0.82F * rect.width(), color::kSecond, "its reference");
}

}  // namespace isorelax::ui
