#include <algorithm>
#include <array>
#include <utility>

#include "ui/panels.h"

namespace isorelax::ui {

void perform_camera_action(const Ui& ui, Action action) {
  constexpr float kZoom = 1.25F;
  const auto found = ui.state.rects.find("viewport");
  if (found == ui.state.rects.end()) return;
  const Rect& viewport = found->second;
  // A twelfth of the viewport's shorter side, as a drag.
  const float step = std::min(viewport.width(), viewport.height()) / 12;
  const float x = 0.5F * viewport.width();
  const float y = 0.5F * viewport.height();
  const std::array<std::pair<Action, Request>, 17> moves{{{Action::turn_left, OrbitView{-step, 0}},
                                                          {Action::turn_right, OrbitView{step, 0}},
                                                          {Action::turn_up, OrbitView{0, -step}},
                                                          {Action::turn_down, OrbitView{0, step}},
                                                          {Action::pan_left, PanView{-step, 0}},
                                                          {Action::pan_right, PanView{step, 0}},
                                                          {Action::pan_up, PanView{0, -step}},
                                                          {Action::pan_down, PanView{0, step}},
                                                          {Action::zoom_in, ZoomView{kZoom, x, y}},
                                                          {Action::zoom_out, ZoomView{1 / kZoom, x, y}},
                                                          {Action::view_front, LookFrom{"front"}},
                                                          {Action::view_back, LookFrom{"back"}},
                                                          {Action::view_left, LookFrom{"left"}},
                                                          {Action::view_right, LookFrom{"right"}},
                                                          {Action::view_top, LookFrom{"top"}},
                                                          {Action::view_bottom, LookFrom{"bottom"}},
                                                          {Action::view_iso, LookFrom{"iso"}}}};
  const auto* move = std::ranges::find(moves, action, &std::pair<Action, Request>::first);
  if (move != moves.end()) ui.request(move->second);
}

}  // namespace isorelax::ui
