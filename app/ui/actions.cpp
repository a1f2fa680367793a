#include "ui/panels.h"

namespace isorelax::ui {
namespace {

void set_coloring(const Ui& ui, model::Coloring coloring) {
  model::ViewSettings view = ui.session.view;
  view.coloring = coloring;
  ui.command(model::SetView{view});
}

void perform_file_action(const Ui& ui, Action action) {
  switch (action) {
    case Action::open:
      ask_for_file(ui, FilePurpose::open_mesh);
      break;
    case Action::save:
      // The first time asks for a name: the opened file is not replaced by accident.
      if (ui.session.save_path)
        ui.command(model::SaveFile{*ui.session.save_path});
      else if (ui.session.document)
        ask_for_file(ui, FilePurpose::save_mesh);
      break;
    case Action::save_as:
      if (ui.session.document) ask_for_file(ui, FilePurpose::save_mesh);
      break;
    case Action::save_trace:
      if (ui.session.timeline.empty()) break;
      if (ui.session.timeline.current()->motion)
        ui.command(model::SaveTrace{});  // is told why there is none
      else
        ask_for_file(ui, FilePurpose::save_trace);
      break;
    case Action::save_picture:
      ask_for_file(ui, FilePurpose::save_picture);
      break;
    case Action::quit:
      if (ui.session.would_lose_work()) {
        ui.state.pending = PendingQuit{};
        ui.state.ask_unsaved = true;
      } else {
        ui.request(Quit{});
      }
      break;
    case Action::copy_command_line:
      ImGui::SetClipboardText(model::command_line(ui.session).c_str());
      ui.command(model::CopyCommandLine{});
      break;
    case Action::undo:
      ui.command(model::Undo{});
      break;
    case Action::redo:
      ui.command(model::Redo{});
      break;
    default:
      break;
  }
}

void perform_view_action(const Ui& ui, Action action) {
  model::ViewSettings view = ui.session.view;
  switch (action) {
    case Action::frame:
      ui.request(FrameView{});
      break;
    case Action::wire:
      view.wire = !view.wire;
      ui.command(model::SetView{view});
      break;
    case Action::shading:
      view.shading = view.shading == model::Shading::flat ? model::Shading::smooth : model::Shading::flat;
      ui.command(model::SetView{view});
      break;
    case Action::color_none:
      set_coloring(ui, model::Coloring::none);
      break;
    case Action::color_min_angle:
      set_coloring(ui, model::Coloring::min_angle);
      break;
    case Action::color_max_angle:
      set_coloring(ui, model::Coloring::max_angle);
      break;
    case Action::color_area:
      set_coloring(ui, model::Coloring::relative_area);
      break;
    case Action::color_energy:
      set_coloring(ui, model::Coloring::energy);
      break;
    case Action::compare:
      ui.state.comparison.mode =
          static_cast<CompareMode>((static_cast<int>(ui.state.comparison.mode) + 1) % 6);
      break;
    case Action::copy_view:
      ui.request(CopyView{});
      break;
    case Action::paste_view:
      if (const char* text = ImGui::GetClipboardText()) ui.request(PasteView{text});
      break;
    case Action::hide_panels:
      ui.state.panels_hidden = !ui.state.panels_hidden;
      break;
    case Action::help:
      ui.state.help_wanted = true;
      break;
    default:
      break;
  }
}

void toggle_play(const Ui& ui, int direction) {
  Playing& playing = ui.state.playing;
  playing.due = 0;
  playing.direction = playing.direction != 0 ? 0 : direction;
  if (playing.direction == 0 || ui.session.timeline.empty()) return;
  // At the end of the way it starts over.
  const unsigned at = ui.session.shared_iteration();
  const unsigned last = ui.session.shared_last();
  if (direction > 0 && at >= last) ui.command(model::Seek{0, {}});
  if (direction < 0 && at == 0) ui.command(model::Seek{last, {}});
}

void perform_inspection(const Ui& ui, Action action) {
  const model::Session& s = ui.session;
  switch (action) {
    case Action::to_start:
      ui.command(model::Seek{0, {}});
      break;
    case Action::to_end:
      ui.command(model::Seek{s.shared_last(), {}});
      break;
    case Action::play_forward:
      toggle_play(ui, 1);
      break;
    case Action::play_backward:
      toggle_play(ui, -1);
      break;
    case Action::next_stage:
      ui.command(model::StepStage{1});
      break;
    case Action::previous_stage:
      ui.command(model::StepStage{-1});
      break;
    case Action::reasons: {
      model::ViewSettings view = s.view;
      view.reasons = !view.reasons;
      ui.command(model::SetView{view});
      if (!view.reasons && s.selected_limit) ui.command(model::SelectLimited{});
      break;
    }
    case Action::pin:
      if (s.selected_vertex)
        ui.command(model::TogglePin{*s.selected_vertex});
      else if (s.current)
        ui.command(model::Say{{model::MessageKind::info, "X pins the selected vertex: click on one first."}});
      break;
    case Action::task:
      ui.command(model::SetTask{s.task == model::Task::smooth ? model::Task::move : model::Task::smooth});
      break;
    case Action::tab_quality:
      ui.state.tab = SideTab::quality;
      break;
    case Action::tab_inspect:
      ui.state.tab = SideTab::inspect;
      break;
    case Action::tab_debug:
      ui.state.tab = SideTab::debug;
      break;
    case Action::tab_runs:
      ui.state.tab = SideTab::runs;
      break;
    default:
      break;
  }
}

}  // namespace

void perform(const Ui& ui, Action action) {
  switch (action) {
    case Action::run_pause:
      if (ui.session.is_running())
        ui.command(model::Pause{});
      else
        ui.command(model::Run{});
      break;
    case Action::step:
      ui.command(model::Step{});
      break;
    case Action::step_back:
      ui.command(model::StepBack{});
      break;
    case Action::reset:
      ui.command(model::Reset{});
      break;
    case Action::next_worst:
      ui.command(model::SelectNextWorst{});
      ui.request(FlyToSelection{});
      break;
    default:
      perform_file_action(ui, action);
      perform_inspection(ui, action);
      perform_view_action(ui, action);
      perform_camera_action(ui, action);
  }
}

void open_file(const Ui& ui, const std::filesystem::path& path) {
  if (ui.session.would_lose_work()) {
    ui.state.pending = path;
    ui.state.ask_unsaved = true;
  } else {
    ui.command(model::OpenFile{path});
  }
}

void open_sphere(const Ui& ui, const SphereStart& sphere) {
  if (ui.session.would_lose_work()) {
    ui.state.pending = sphere;
    ui.state.ask_unsaved = true;
  } else {
    ui.command(model::OpenSphere{sphere});
  }
}

}  // namespace isorelax::ui
