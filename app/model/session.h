#pragma once

#include <array>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/engine.h"
#include "model/timeline.h"
#include "model/undo.h"
#include "quality/triangle_metrics.h"

namespace isorelax::model {

enum class MessageKind : std::uint8_t { info, warning, error };

/// A line for the user.
struct Message {
  MessageKind kind = MessageKind::info;
  std::string text;
  Topic topic = Topic::other;
  std::uint64_t number = 0;  ///< counts up: tells a view which ones are new
};

/// What the worker was asked to do to the positions.
enum class Activity : std::uint8_t { idle, loading, running, saving };

/// What "the next worst triangle" means.
enum class WorstBy : std::uint8_t {
  coloring,  ///< what the colours say
  min_angle,
  max_angle,
  area,  ///< the largest
  energy,
  shape,
  radius_ratio,
  scaled_jacobian,
  aspect_ratio,
  inverted  ///< those that lie upside down, and no others
};
inline constexpr std::size_t kWorstBy = 10;
/// "smallest angle", ...: for people.
[[nodiscard]] std::string_view title(WorstBy by);

/// What is known about the step that is looked at.
struct Inspection {
  std::optional<StepView> step;
  std::optional<VertexExplanation> vertex;
  std::optional<TriangleExplanation> triangle;
  std::optional<VertexPath> path;
  std::optional<GradientCheck> check;  ///< of all vertices; none for large meshes, where it takes too long
  // Of a moving surface.
  std::optional<MovingVertex> moving_vertex;
  std::optional<MovingTriangle> moving_triangle;
  std::optional<MovingPath> moving_path;
  std::string unknown;  ///< why a triangle is not measured against its reference
};

/// The only state of the program: the open document, settings, results, history. Everything else shows it.
///
/// Read it freely; only `execute` (command.h) changes it.
struct Session {
  DocumentPtr document;  ///< null before the first file is open
  MeshStatePtr original;
  MeshStatePtr current;
  /// What files on disk hold, as far as it was read or written here, by their whole names.
  std::map<std::filesystem::path, std::shared_ptr<const Geometry>> on_disk;

  /// Where the document was saved last; none until it was.
  std::optional<std::filesystem::path> save_path;

  Task task = Task::smooth;
  SmoothingSettings smoothing;
  MotionChoices motion;
  ViewSettings view;

  Activity activity = Activity::idle;
  std::vector<IterationRow> history;
  std::optional<StepSummary> last_step;  ///< the one that led to what is shown
  std::optional<RunResult> last_run;
  std::uint64_t last_run_number = 0;       ///< of the newest message when it ended: later ones are news
  std::optional<SurfaceMeasured> surface;  ///< at the end of the last run
  std::string broken_by;                   ///< the breakpoint that ended the last run; empty: none
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
  std::optional<Index> selected_vertex;
  std::optional<unsigned> selected_limit;  ///< a bit of Limit
  WorstBy worst_by = WorstBy::coloring;
  std::vector<std::filesystem::path> recent;  ///< newest first
  std::string command_line;                   ///< what was last asked for with CopyCommandLine

  Timeline timeline;
  Inspection inspection;
  std::vector<Breakpoint> breakpoints;
  std::deque<BreakHit> hits;  ///< newest last, bounded
  std::size_t step_budget = StepStore::kDefaultBudget;
  StepMemory step_memory;
  std::vector<unsigned> shown_branches;    ///< beside the present one
  std::vector<MeshStatePtr> other_states;  ///< theirs
  std::optional<Compared> comparison;

  Engine engine;

  /// Whether the current positions are in no file.
  [[nodiscard]] bool has_unsaved_changes() const;
  /// Whether this file holds them.
  [[nodiscard]] bool is_saved_in(const std::filesystem::path& path) const;
  /// Whether that, or what was recorded since a mesh or a trace was saved last, would be lost.
  [[nodiscard]] bool would_lose_work() const;
  /// Which of the worst triangles the selected one is, from 1; 0 for none of them, and as soon as the mesh
  /// is another.
  [[nodiscard]] std::size_t rank_of_worst() const;
  [[nodiscard]] bool is_running() const { return activity == Activity::running; }
  [[nodiscard]] bool can_smooth() const { return current && activity == Activity::idle; }
  /// Whether another iteration than the one on screen was asked for.
  [[nodiscard]] bool is_seeking() const { return seeking_; }
  /// The iteration that views beside each other share: a later one than the present run's where that has
  /// ended.
  [[nodiscard]] unsigned shared_iteration() const;
  /// The last one that a branch and those that would stand beside it lead to.
  [[nodiscard]] unsigned shared_last(unsigned branch) const;
  /// The same of the present one.
  [[nodiscard]] unsigned shared_last() const {
    return timeline.empty() ? 0 : shared_last(timeline.cursor.branch);
  }
  /// Whether a run from here goes on with the present branch, or over what is recorded of it; else it begins
  /// a branch.
  [[nodiscard]] bool continues_branch() const;
  /// The moving surface that is shown; null while it is the mesh as opened or smoothed.
  [[nodiscard]] const Branch* moving() const;
  /// What is known about the shown moment of it. Precondition: moving().
  [[nodiscard]] const MotionEntry& moment() const;
  /// The ends of the colour scale under the view's range mode.
  [[nodiscard]] ValueRange color_range() const;

 private:
  friend class Executor;
  MeshStatePtr run_start_;
  std::vector<IterationRow> rows_at_start_;
  unsigned run_iterations_ = 0;
  bool measure_surface_later_ = false;
  bool surface_is_news_ = false;  // where a run has ended; elsewhere on the timeline it was told before
  bool then_polish_ = false;      // once the solver has done its steps
  Cursor cursor_at_start_;
  std::vector<Cursor> taught_;  // where Teach has come to
  bool teaching_ = false;
  std::optional<RunsChange::View> before_teaching_;  // until it is noted for Undo
  std::size_t runs_before_teaching_ = 0;
  unsigned beside_at_ = 0;  // iteration that was asked for last, over all runs that are shown
  unsigned scan_to_ = 0;
  std::function<void(Session&)> after_scan_;  // where no breakpoint stopped it
  bool seeking_ = false;
  std::uint64_t request_count_ = 0;
  std::uint64_t inspect_number_ = 0, seek_number_ = 0, follow_number_ = 0;
  std::vector<double> worst_values_;  // of worst_values_of_ by worst_values_by_
  std::shared_ptr<const Geometry> worst_values_of_;
  WorstBy worst_values_by_ = WorstBy::coloring;
  std::size_t worst_rank_ = 0;
  std::shared_ptr<const Geometry> worst_rank_of_;
  std::deque<std::function<void(Session&)>> when_idle_;
  std::uint64_t message_count_ = 0;
  std::size_t kept_steps_ = 0;  // recorded when a mesh or a trace was saved last
};

}  // namespace isorelax::model
