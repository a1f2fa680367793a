#include <algorithm>

#include "ui/panels.h"

namespace isorelax::ui {
namespace {

constexpr float kZoom = 1.25F;

}  // namespace

void perform_camera_action(const Ui& ui, Action action) {
  const auto found = ui.state.rects.find("viewport");
  if (found == ui.state.rects.end()) return;
  const Rect& viewport = found->second;
  // A twelfth of the viewport's shorter side, as a drag.
  const float step = std::min(viewport.width(), viewport.height()) / 12;
  const ImVec2 middle{0.5F * viewport.width(), 0.5F * viewport.height()};
  switch (action) {
    case Action::turn_left:
      ui.request(OrbitView{-step, 0});
      break;
    case Action::turn_right:
      ui.request(OrbitView{step, 0});
      break;
    case Action::turn_up:
      ui.request(OrbitView{0, -step});
      break;
    case Action::turn_down:
      ui.request(OrbitView{0, step});
      break;
    case Action::pan_left:
      ui.request(PanView{-step, 0});
      break;
    case Action::pan_right:
      ui.request(PanView{step, 0});
      break;
    case Action::pan_up:
      ui.request(PanView{0, -step});
      break;
    case Action::pan_down:
      ui.request(PanView{0, step});
      break;
    case Action::zoom_in:
      ui.request(ZoomView{kZoom, middle.x, middle.y});
      break;
    case Action::zoom_out:
      ui.request(ZoomView{1 / kZoom, middle.x, middle.y});
      break;
    case Action::view_front:
      ui.request(LookFrom{"front"});
      break;
    case Action::view_back:
      ui.request(LookFrom{"back"});
      break;
    case Action::view_left:
      ui.request(LookFrom{"left"});
      break;
    case Action::view_right:
      ui.request(LookFrom{"right"});
      break;
    case Action::view_top:
      ui.request(LookFrom{"top"});
      break;
    case Action::view_bottom:
      ui.request(LookFrom{"bottom"});
      break;
    case Action::view_iso:
      ui.request(LookFrom{"iso"});
      break;
    default:
      break;
  }
}

}  // namespace isorelax::ui
