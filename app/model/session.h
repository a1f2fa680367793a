#pragma once

#include <array>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/engine.h"
#include "model/undo.h"

namespace isorelax::model {

enum class MessageKind : std::uint8_t { info, warning, error };

/// A line for the user.
struct Message {
  MessageKind kind = MessageKind::info;
  std::string text;
  std::uint64_t number = 0;  ///< counts up: tells a view which ones are new
};

/// What the worker was asked to do to the positions.
enum class Activity : std::uint8_t { idle, loading, running, saving };

/// The only state of the program: the open document, settings, results, history. Everything else shows it.
///
/// Read it freely; only `execute` (command.h) changes it.
struct Session {
  DocumentPtr document;  ///< null before the first file is open
  MeshStatePtr original;
  MeshStatePtr current;
  MeshStatePtr saved;  ///< the state that the file on disk holds

  /// Where the document was saved last; none until it was.
  std::optional<std::filesystem::path> save_path;

  SmoothingSettings smoothing;
  ViewSettings view;

  Activity activity = Activity::idle;
  std::vector<IterationRow> history;
  std::optional<StepSummary> last_step;
  std::optional<RunResult> last_run;
  /// Iterations that a paused run still has to do; 0 when Run starts a new one.
  unsigned remaining = 0;
  /// Counts up whenever the energy gets another meaning.
  unsigned series = 0;

  std::vector<std::string> notes;  ///< what the reader changed and what smoothing leaves out
  std::deque<Message> messages;    ///< newest last, bounded
  UndoList undo;
  /// Extent of each colouring's values over all states since the file was opened.
  std::array<ValueRange, kColorings> run_range{};
  std::optional<Index> selected_triangle;
  std::size_t worst_rank = 0;                 ///< which of the worst triangles is selected, from 1
  std::vector<std::filesystem::path> recent;  ///< newest first
  std::string command_line;                   ///< what was last asked for with CopyCommandLine

  Engine engine;

  /// Whether the current positions are in no file.
  [[nodiscard]] bool has_unsaved_changes() const {
    return current && saved && current->geometry != saved->geometry;
  }
  [[nodiscard]] bool is_running() const { return activity == Activity::running; }
  [[nodiscard]] bool can_smooth() const { return current && activity == Activity::idle; }
  /// The ends of the colour scale under the view's range mode.
  [[nodiscard]] ValueRange color_range() const;

 private:
  friend class Executor;
  MeshStatePtr run_start_;
  std::vector<IterationRow> rows_at_start_;
  unsigned run_iterations_ = 0;
  std::deque<std::function<void(Session&)>> after_run_;
  std::uint64_t message_count_ = 0;
};

}  // namespace isorelax::model
