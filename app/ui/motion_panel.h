#pragma once

#include "ui/ui_state.h"

namespace isorelax::ui {

/// What decides how a surface moves: the start, the field and its time, the redistribution.
void draw_motion_settings(const Ui& ui);
/// The field with its numbers and texts, a mistake under the text that it is in.
void draw_motion_field(const Ui& ui);
/// A change of the motion goes out as one command that names it.
void change_motion(const Ui& ui, const MotionChoices& motion, std::string label);
/// A number in a row of its own, taken over while it is typed; `name` is its identity. True when it changed.
bool number_field(const Ui& ui, const char* name, double& value);
/// Ends the undo entry of the control that was drawn last.
void end_motion_edit(const Ui& ui);

/// Figures and plots over the time of a moving surface. Precondition: session.moving().
void draw_motion_quality(const Ui& ui);
/// The selected vertex or triangle of a moving surface. Precondition: session.moving().
void draw_moving_vertex(const Ui& ui);
void draw_moving_triangle(const Ui& ui);

}  // namespace isorelax::ui
