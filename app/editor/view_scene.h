#pragma once

#include "model/session.h"
#include "render/camera.h"
#include "render/scene.h"

namespace isorelax::editor {

/// The session's mesh as the renderer wants it. Remembers which content it saw last, so that nothing is
/// uploaded twice.
class ViewScene {
 public:
  /// The scene as the session is now. The spans in it live as long as the session's states. Precondition:
  /// session.current.
  render::Scene make(const model::Session& session, float pixels_per_point);

 private:
  // Content is never changed in place: another address is another content while the owner is kept here.
  model::DocumentPtr document_;
  std::shared_ptr<const model::Geometry> geometry_;
  std::shared_ptr<const model::EnergyState> energy_;
  model::Coloring coloring_ = model::Coloring::none;
  render::Revision triangles_ = 0, positions_ = 0, values_ = 0;
};

/// The camera that looks at a triangle from along its normal, close enough to see its neighbours.
render::Camera look_at_triangle(const render::Camera& camera, const model::Session& session, Index triangle);

}  // namespace isorelax::editor
