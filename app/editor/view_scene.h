#pragma once

#include "model/session.h"
#include "render/camera.h"
#include "render/scene.h"
#include "view/scene.h"

namespace isorelax::editor {

/// A state of a mesh, and the one that differences and arrows start from; null: none.
struct Shown {
  model::DocumentPtr document;
  model::MeshStatePtr state;
  model::MeshStatePtr against;
};

/// The session's mesh as the renderer wants it. Remembers which content it saw last, so that nothing is
/// uploaded twice.
class ViewScene {
 public:
  /// The scene of what is shown, under a view. The spans in it live as long as the states and until the next
  /// call.
  const render::Scene& make(const Shown& shown, const view::View& view);

 private:
  // Content is never changed in place: another address is another content while the owner is kept here.
  model::DocumentPtr document_;
  std::shared_ptr<const model::Geometry> geometry_;
  model::MeshStatePtr against_;
  std::shared_ptr<const model::EnergyState> energy_;
  view::ColorBy color_ = view::ColorBy::none;
  bool difference_ = false;
  render::Revision triangles_ = 0, positions_ = 0, values_ = 0;
  std::vector<double> change_;
  view::Depiction depiction_;
};

/// The camera that looks at a vertex from along its normal, close enough to see its neighbours.
render::Camera look_at_vertex(const render::Camera& camera, const model::Session& session, Index vertex);
/// The camera that looks at a triangle from along its normal, close enough to see its neighbours.
render::Camera look_at_triangle(const render::Camera& camera, const model::Session& session, Index triangle);

}  // namespace isorelax::editor
