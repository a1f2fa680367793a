#pragma once

#include "model/session.h"
#include "render/camera.h"
#include "view/view.h"

namespace isorelax::editor {

/// What the window shows, as a view: `isorelax render --camera` makes the same picture of it. What the
/// session has no setting for (background, arrows, figures, ...) is that of `base`: the view that was pasted
/// last. Precondition: session.current.
[[nodiscard]] view::View view_of(const model::Session& session, const view::View& base,
                                 const render::Camera& camera, render::PictureSize size, float points);

/// The session's name for what a view colours by.
[[nodiscard]] model::Coloring coloring_of(view::ColorBy color);

/// The session's settings that a view asks for; what it leaves open stays as it is.
[[nodiscard]] model::ViewSettings settings_of(const view::View& view, const model::ViewSettings& present);

}  // namespace isorelax::editor
