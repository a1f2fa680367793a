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
struct Run {
  unsigned steps = 0;  ///< of a moving surface; 0: to its end
};
/// Stops the run after the iteration that it is in; Run continues.
struct Pause {};
/// One iteration.
struct Step {};
/// Says whether Run smooths or moves. Whoever begins to move sees areas, unless the colours were chosen.
struct SetTask {
  Task task = Task::smooth;
};
/// Replaces what decides how a surface moves, and turns to moving. `label` names the change for Undo.
struct SetMotion {
  MotionChoices motion;
  std::string label;
};
/// Opens a sphere in place of the document.
struct OpenSphere {
  SphereStart sphere;
};
/// Turns to moving and makes so many steps; 0: to its end.
struct Move {
  unsigned steps = 0;
};
/// Back to the positions of the file.
struct Reset {};
/// One iteration back on the timeline.
struct StepBack {};
struct Undo {};
struct Redo {};
/// Stops whatever the worker does.
struct Cancel {};
/// Selects the next worse triangle by what SetWorstBy says; the worst one first.
struct SelectNextWorst {};
struct ClearSelection {};
/// Puts the equivalent `isorelax smooth` command into Session::command_line.
struct CopyCommandLine {};
/// Shows a line to the user.
struct Say {
  Message message;
};
/// Shows an iteration of a branch, none: of the present one. A run that goes on is paused first.
struct Seek {
  unsigned iteration = 0;
  std::optional<unsigned> branch;
};
/// Shows a stage inside the step that led to the present iteration; none: what came of it.
struct SetStage {
  std::optional<Stage> stage;
};
/// To the next stage, over the ends of iterations: 1 or -1.
struct StepStage {
  int direction = 1;
};
struct SelectVertex {
  Index vertex = 0;
};
struct SelectTriangle {
  Index triangle = 0;
};
/// Marks the vertices that the shown step was limited for by this bit of Limit; none: no longer.
struct SelectLimited {
  std::optional<unsigned> bit;
};
/// What SelectNextWorst goes by.
struct SetWorstBy {
  WorstBy by = WorstBy::coloring;
};
/// Holds a vertex in later runs, or lets it go.
struct TogglePin {
  Index vertex = 0;
};
/// All breakpoints, as they are to be: a text that cannot be read stays, with its mistake.
struct SetBreakpoints {
  std::vector<Breakpoint> breakpoints;
};
/// Memory for full step records, in bytes.
struct SetStepBudget {
  std::size_t bytes = StepStore::kDefaultBudget;
};
/// Branches shown beside the present one, at the same iteration: up to three.
struct ShowBranches {
  std::vector<unsigned> branches;
};
/// Takes a branch from the timeline that no other one left (why_kept). Can be undone.
struct RemoveRun {
  unsigned branch = 0;
};
/// Where two branches part.
struct CompareBranches {
  unsigned first = 0, second = 0;
};
/// Runs the three methods from here and shows them side by side.
struct Teach {};
/// Writes the present branch as a trace file.
struct SaveTrace {
  std::filesystem::path path;
};
/// Opens a recorded run in place of the document.
struct OpenTrace {
  std::filesystem::path path;
};
/// Adds a recorded run of the same mesh to the timeline.
struct AddTrace {
  std::filesystem::path path;
};
/// Recently opened files, newest first, as kept between two starts of the program.
struct SetRecent {
  std::vector<std::filesystem::path> paths;
};
/// Takes over what the worker has published. Never waits.
struct Collect {};

using Command =
    std::variant<OpenFile, SaveFile, SetSmoothing, EndEdit, SetView, Run, Pause, Step, Reset, StepBack, Undo,
                 Redo, Cancel, SelectNextWorst, ClearSelection, CopyCommandLine, Say, SetRecent, Collect,
                 Seek, SetStage, StepStage, SelectVertex, SelectTriangle, SelectLimited, SetWorstBy,
                 TogglePin, SetBreakpoints, SetStepBudget, ShowBranches, CompareBranches, Teach, SaveTrace,
                 OpenTrace, AddTrace, SetTask, SetMotion, OpenSphere, Move, RemoveRun>;

/// The only writer of a session. Returns at once: long work goes to the session's worker, and its results
/// come with a later Collect. Throws nothing; what cannot be done becomes a message.
void execute(Session& session, const Command& command);

/// Why a run cannot be removed now, a sentence; empty: it can.
[[nodiscard]] std::string why_kept(const Session& session, unsigned run);

/// Executes Collect until the worker is idle: for tests and for pictures without a window.
void finish(Session& session);

/// `isorelax smooth`, or `isorelax advect`, with the session's file and settings, quoted for a shell: of a
/// run that was stopped or stepped the steps made so far. Its output is a file that is not there yet.
[[nodiscard]] std::string command_line(const Session& session);

}  // namespace isorelax::model
