#pragma once

#include "model/session.h"
#include "render/scene.h"

namespace isorelax::editor {

/// Lays what is known about the step over a scene of the session's mesh: the arrows of the chosen stage, dots
/// in the colours of what limited the vertices, and the selected vertex.
void add_step(const model::Session& session, std::span<const Vec3> positions, render::Scene& scene);

/// The triangle or the vertex that a pick means: a vertex where the point lies near a corner of its triangle.
[[nodiscard]] bool means_vertex(const Vec3& point, const std::array<Vec3, 3>& corners, unsigned nearest);

}  // namespace isorelax::editor
