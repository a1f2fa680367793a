#include <array>
#include <cmath>
#include <numbers>

#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

// Icons are drawn in a box from -1 to 1, y downwards.
struct Pen {
  ImDrawList& draw;
  ImVec2 center;
  float unit;
  ImU32 color;

  [[nodiscard]] ImVec2 at(float x, float y) const { return {center.x + x * unit, center.y + y * unit}; }
  [[nodiscard]] float width() const { return std::max(1.0F, unit * 0.22F); }
  template <std::size_t N>
  void line(const std::array<ImVec2, N>& points, ImDrawFlags flags = ImDrawFlags_None) const {
    std::array<ImVec2, N> moved;
    for (std::size_t k = 0; k < N; ++k) moved[k] = at(points[k].x, points[k].y);
    draw.AddPolyline(moved.data(), static_cast<int>(N), color, flags, width());
  }
  void bar(float x0, float y0, float x1, float y1) const {
    draw.AddRectFilled(at(x0, y0), at(x1, y1), color, 0.15F * unit);
  }
};

void turn_arrow(const Pen& pen, float side) {
  pen.draw.PathArcTo(pen.at(0, 0.25F), 0.72F * pen.unit, side > 0 ? -std::numbers::pi_v<float> : 0.0F,
                     side > 0 ? 0.25F * std::numbers::pi_v<float> : -1.25F * std::numbers::pi_v<float>, 18);
  pen.draw.PathStroke(pen.color, ImDrawFlags_None, pen.width());
  pen.draw.AddTriangleFilled(pen.at(-side * 0.72F - 0.5F, 0.1F), pen.at(-side * 0.72F + 0.5F, 0.1F),
                             pen.at(-side * 0.72F, 0.75F), pen.color);
}

void draw_document_icon(const Pen& pen, Icon icon) {
  switch (icon) {
    case Icon::open:
      pen.line(std::array<ImVec2, 6>{{{-0.95F, 0.7F},
                                      {-0.95F, -0.65F},
                                      {-0.3F, -0.65F},
                                      {-0.05F, -0.35F},
                                      {0.95F, -0.35F},
                                      {0.95F, 0.7F}}},
               ImDrawFlags_Closed);
      break;
    case Icon::save:
      pen.line(std::array<ImVec2, 2>{{{0, -0.9F}, {0, 0.35F}}});
      pen.line(std::array<ImVec2, 3>{{{-0.5F, -0.1F}, {0, 0.4F}, {0.5F, -0.1F}}});
      pen.line(std::array<ImVec2, 4>{{{-0.9F, 0.35F}, {-0.9F, 0.85F}, {0.9F, 0.85F}, {0.9F, 0.35F}}});
      break;
    case Icon::picture:
      pen.line(std::array<ImVec2, 4>{{{-0.95F, -0.7F}, {0.95F, -0.7F}, {0.95F, 0.7F}, {-0.95F, 0.7F}}},
               ImDrawFlags_Closed);
      pen.line(
          std::array<ImVec2, 5>{{{-0.9F, 0.5F}, {-0.3F, -0.1F}, {0.1F, 0.3F}, {0.45F, 0.0F}, {0.9F, 0.45F}}});
      break;
    default:
      break;
  }
}

void draw_run_icon(const Pen& pen, Icon icon) {
  switch (icon) {
    case Icon::run:
      pen.draw.AddTriangleFilled(pen.at(-0.6F, -0.85F), pen.at(0.9F, 0), pen.at(-0.6F, 0.85F), pen.color);
      break;
    case Icon::pause:
      pen.bar(-0.7F, -0.8F, -0.2F, 0.8F);
      pen.bar(0.2F, -0.8F, 0.7F, 0.8F);
      break;
    case Icon::step:
      pen.draw.AddTriangleFilled(pen.at(-0.8F, -0.8F), pen.at(0.4F, 0), pen.at(-0.8F, 0.8F), pen.color);
      pen.bar(0.45F, -0.8F, 0.8F, 0.8F);
      break;
    case Icon::reset:
    case Icon::step_back:
      pen.draw.AddTriangleFilled(pen.at(0.8F, -0.8F), pen.at(0.8F, 0.8F), pen.at(-0.4F, 0), pen.color);
      pen.bar(-0.8F, -0.8F, -0.45F, 0.8F);
      break;
    case Icon::run_back:
      pen.draw.AddTriangleFilled(pen.at(0.6F, -0.85F), pen.at(0.6F, 0.85F), pen.at(-0.9F, 0), pen.color);
      break;
    case Icon::to_end:
      pen.draw.AddTriangleFilled(pen.at(-0.95F, -0.75F), pen.at(0, 0), pen.at(-0.95F, 0.75F), pen.color);
      pen.draw.AddTriangleFilled(pen.at(-0.05F, -0.75F), pen.at(0.9F, 0), pen.at(-0.05F, 0.75F), pen.color);
      break;
    case Icon::to_start:
      pen.draw.AddTriangleFilled(pen.at(0.95F, -0.75F), pen.at(0.95F, 0.75F), pen.at(0, 0), pen.color);
      pen.draw.AddTriangleFilled(pen.at(0.05F, -0.75F), pen.at(0.05F, 0.75F), pen.at(-0.9F, 0), pen.color);
      break;
    case Icon::undo:
      turn_arrow(pen, 1);
      break;
    case Icon::redo:
      turn_arrow(pen, -1);
      break;
    default:
      break;
  }
}

}  // namespace

void draw_icon(ImDrawList& draw, Icon icon, ImVec2 center, float size, ImU32 color) {
  const Pen pen{draw, center, 0.5F * size, color};
  draw_run_icon(pen, icon);
  draw_document_icon(pen, icon);
  switch (icon) {
    case Icon::frame:
      for (const float x : {-1.0F, 1.0F})
        for (const float y : {-1.0F, 1.0F})
          pen.line(
              std::array<ImVec2, 3>{{{0.9F * x, 0.35F * y}, {0.9F * x, 0.9F * y}, {0.35F * x, 0.9F * y}}});
      pen.bar(-0.22F, -0.22F, 0.22F, 0.22F);
      break;
    case Icon::wire:
      pen.line(std::array<ImVec2, 3>{{{-0.95F, 0.75F}, {0, -0.85F}, {0.95F, 0.75F}}}, ImDrawFlags_Closed);
      pen.line(std::array<ImVec2, 3>{{{-0.47F, -0.05F}, {0.47F, -0.05F}, {0, 0.75F}}}, ImDrawFlags_Closed);
      break;
    case Icon::help:
      pen.draw.PathArcTo(pen.at(0, -0.4F), 0.45F * pen.unit, -std::numbers::pi_v<float>,
                         0.5F * std::numbers::pi_v<float>, 14);
      pen.draw.PathLineTo(pen.at(0, 0.4F));
      pen.draw.PathStroke(color, ImDrawFlags_None, pen.width());
      pen.draw.AddCircleFilled(pen.at(0, 0.82F), 0.16F * pen.unit, color);
      break;
    case Icon::close:
      pen.line(std::array<ImVec2, 2>{{{-0.6F, -0.6F}, {0.6F, 0.6F}}});
      pen.line(std::array<ImVec2, 2>{{{-0.6F, 0.6F}, {0.6F, -0.6F}}});
      break;
    default:
      break;
  }
}

}  // namespace isorelax::ui
