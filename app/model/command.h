#pragma once

#include <filesystem>
#include <string>
#include <variant>

#include "model/session.h"

namespace isorelax::model {

/// Opens a mesh file in place of the document. On failure the document stays.
struct OpenFile {
  std::filesystem::path path;
};
/// Writes the document with its current positions.
struct SaveFile {
  std::filesystem::path path;
};
/// Replaces the smoothing settings. `label` names the change for Undo.
struct SetSmoothing {
  SmoothingSettings settings;
  std::string label;
};
/// The user let go of a control: the next SetSmoothing is an undo entry of its own.
struct EndEdit {};
struct SetView {
  ViewSettings view;
};
/// Runs the set number of iterations, or what a paused run has left.
struct Run {};
/// Stops the run after the iteration that it is in; Run continues.
struct Pause {};
/// One iteration.
struct Step {};
/// Back to the positions of the file.
struct Reset {};
/// Undoes the last step or run; nothing else.
struct StepBack {};
struct Undo {};
struct Redo {};
/// Stops whatever the worker does.
struct Cancel {};
/// Selects the next worse triangle of the coloured quantity; the worst one first.
struct SelectNextWorst {};
struct ClearSelection {};
/// Puts the equivalent `isorelax smooth` command into Session::command_line.
struct CopyCommandLine {};
/// Shows a line to the user.
struct Say {
  Message message;
};
/// Recently opened files, newest first, as kept between two starts of the program.
struct SetRecent {
  std::vector<std::filesystem::path> paths;
};
/// Takes over what the worker has published. Never waits.
struct Collect {};

using Command =
    std::variant<OpenFile, SaveFile, SetSmoothing, EndEdit, SetView, Run, Pause, Step, Reset, StepBack, Undo,
                 Redo, Cancel, SelectNextWorst, ClearSelection, CopyCommandLine, Say, SetRecent, Collect>;

/// The only writer of a session. Returns at once: long work goes to the session's worker, and its results
/// come with a later Collect. Throws nothing; what cannot be done becomes a message.
void execute(Session& session, const Command& command);

/// Executes Collect until the worker is idle: for tests and for pictures without a window.
void finish(Session& session);

/// `isorelax smooth` with the session's file and settings, quoted for a shell.
[[nodiscard]] std::string command_line(const Session& session);

}  // namespace isorelax::model
