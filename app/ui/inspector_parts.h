#pragma once

#include "ui/panels.h"

namespace isorelax::ui {

/// Why the vertex moved in this step, or did not, in a sentence or two.
[[nodiscard]] std::string why_sentence(const VertexExplanation& e);
/// What this step does to the triangle.
[[nodiscard]] std::string triangle_sentence(const TriangleExplanation& e);
/// The names of the bits of Limit, with commas between; "nothing" for none.
[[nodiscard]] std::string limit_text(std::uint16_t limits);

/// The triangles around a vertex, flat in its tangent plane, before the step, with the moves of its stages
/// and the way it came.
void draw_ring(const Ui& ui, const VertexExplanation& e, float height);
/// A triangle before and after a step and its reference triangle, to one scale.
void draw_triangles(const Ui& ui, const TriangleExplanation& e, float height);

/// The sections of the inspector.
void draw_move_section(const Ui& ui, const VertexExplanation& e);
void draw_gradient_section(const Ui& ui, const VertexExplanation& e);
void draw_class_section(const Ui& ui, const VertexExplanation& e);
void draw_path_section(const Ui& ui);
void draw_triangle_sections(const Ui& ui, const TriangleExplanation& e);

}  // namespace isorelax::ui
