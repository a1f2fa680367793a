#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "model/breakpoint.h"
#include "model/mesh_state.h"
#include "motion/motion_run.h"
#include "smoothing/explain.h"
#include "smoothing/run.h"
#include "surface/deviation.h"
#include "trace/trace_diff.h"

namespace isorelax::model {

class Recording;

/// One line of the record that a run leaves: what the plots draw.
struct IterationRow {
  unsigned iteration = 0;
  double energy = 0;
  double min_angle_deg = 0;
  double max_angle_deg = 0;
  double largest_move = 0;
  /// Rows of one series measure the energy with the same settings; between series it jumps.
  unsigned series = 0;
};

/// What the last step's record says, without its arrays.
struct StepSummary {
  unsigned iteration = 0;
  StepKind kind = StepKind::unknown;
  StepTotals before, after;
  std::array<std::size_t, kLimitBits> limits{};  ///< vertices per bit of Limit
  std::size_t moved = 0;
  std::size_t vertices = 0;
  double largest_move = 0;
  unsigned fold_passes = 0;
  unsigned energy_passes = 0;
};

/// A file was opened.
struct Loaded {
  DocumentPtr document;
  MeshStatePtr state;
  std::vector<std::string> notes;
  std::string turning{};  ///< what a run does first with triangles upside down; empty: nothing
};
/// The energy of the original and of the current state under new settings.
struct EnergyMeasured {
  DocumentPtr document;
  std::shared_ptr<const Geometry> original_geometry, current_geometry;
  std::shared_ptr<const EnergyState> original, current;
  std::vector<std::string> notes;
};
/// Memory that full step records take.
struct StepMemory {
  std::size_t bytes = 0;
  std::size_t records = 0;
};
/// One or more iterations were done; `state` is the newest measured one, or null.
struct Iterated {
  std::vector<IterationRow> rows;
  std::vector<StepSummary> steps;  ///< one for each row
  MeshStatePtr state;
  std::vector<BreakHit> hits;
  StepMemory memory;
};
/// A run ended; its last state came with an Iterated before it.
struct RunEnded {
  RunResult result;
  std::string broken_by;  ///< the predicate that ended it; empty: none
  /// What holds the vertices where none may move: as of a step in which none does.
  std::optional<StepSummary> held = {};
};
/// How far a run has taken the surface from the mesh as opened.
struct SurfaceMeasured {
  std::shared_ptr<const Geometry> geometry;  ///< of which state
  Deviation deviation;
  double limit = 0;          ///< that every step has to keep, over the diagonal
  bool is_over = false;      ///< it is farther: of what untangling took, only a typed limit knows
  std::size_t turned = 0;    ///< triangles that lie upside down and did not
  std::size_t crossing = 0;  ///< that cross others, where none did
};
/// Others were in more of a hurry than to measure that.
struct SurfaceGaveWay {};
/// Holds nothing.
inline constexpr ValueRange kNoRange{std::numeric_limits<double>::infinity(),
                                     -std::numeric_limits<double>::infinity()};
/// A moving surface took one or more steps; `state` is the newest measured one, or null.
struct Moved {
  std::vector<MotionEntry> moments;
  std::vector<IterationRow> rows;  ///< one for each moment
  std::vector<StepSummary> steps;  ///< the same without that of the start
  /// Smallest and largest area over the mean, and energy, over all of these moments.
  ValueRange areas = kNoRange, energies = kNoRange;
  Eigen::AlignedBox3d box;  ///< holds all vertices of all of them
  MeshStatePtr state;
  std::vector<BreakHit> hits;
};
/// It ended; its last state came before.
struct MotionEnded {
  unsigned steps = 0;  ///< that were made
  bool cancelled = false;
  std::string broken_by;  ///< the predicate that ended it; empty: none
};
/// A vertex of a moving surface in the step that led to what is shown.
struct MovingVertex {
  Index vertex = 0;
  Vec3 before = Vec3::Zero(), after = Vec3::Zero();
  Vec3 by_motion = Vec3::Zero();          ///< where the motion alone would have taken it from `before`
  Vec3 by_redistribution = Vec3::Zero();  ///< the rest
};
/// A triangle of a moving surface in the step to where it stands.
struct MovingTriangle {
  TriangleExplanation step;
  double area_start = 0;  ///< at the start of the motion, squared length units
};
struct MotionInspected {
  std::uint64_t number = 0;  ///< of the request
  std::optional<MovingVertex> vertex;
  std::optional<MovingTriangle> triangle;
  std::string unknown;  ///< why a triangle cannot be measured against its reference
};
/// How far a vertex has come along its way, over the steps of a moving surface: entry k after k steps.
struct MovingPath {
  std::uint64_t number = 0;  ///< of the request
  unsigned branch = 0;
  Index vertex = 0;
  std::vector<double> by_motion, by_redistribution, distance;  ///< length units; distance: from its start
};
/// Another iteration is shown; `others` are those of the branches beside it.
struct Sought {
  std::uint64_t number = 0;  ///< of the request
  DocumentPtr document;      ///< whose runs were gone through
  MeshStatePtr state;
  std::vector<MeshStatePtr> others;
};
struct Saved {
  std::filesystem::path path;
  MeshStatePtr state;
  std::vector<std::string> notes;
};
/// What a message is about: that something worked out answers the errors before it about the same.
enum class Topic : std::uint8_t { other, reading, saving, view, comparison, turning, refusal };
/// A job could not do what it was asked; nothing else has changed.
struct Failed {
  std::string text;
  Topic topic = Topic::other;
};
/// A run could not start or broke off with an error.
struct RunFailed {
  std::string text;
};

/// What was asked about a step.
struct Inspected {
  std::uint64_t number = 0;  ///< of the request
  std::shared_ptr<const StepRecord> record;
  std::shared_ptr<const std::vector<Vec3>> before;
  MeshStatePtr before_state;
  std::string mismatch;
  std::string made_with;  ///< part_text, where the run that was read has more to say than its words
  std::optional<VertexExplanation> vertex;
  std::optional<TriangleExplanation> triangle;
  std::optional<GradientCheck> check;
  StepMemory memory;
};
/// Where a vertex was, over the iterations of a branch.
struct Followed {
  std::uint64_t number = 0;  ///< of the request
  unsigned branch = 0;
  Index vertex = 0;
  std::vector<Vec3> positions;
};
/// A recorded run was read.
struct TraceOpened {
  std::filesystem::path path;
  Trace head;  ///< the program, and why it stopped
  std::vector<IterationRow> rows;
  std::vector<StepSummary> steps;
  std::shared_ptr<Recording> recording;
  SmoothingSettings settings;              ///< the nearest that the editor has
  std::vector<std::string> unknown_words;  ///< what it has no settings for, "--option value" each
  std::string not_redone;                  ///< why its steps cannot be made again; empty: they can
  DocumentPtr document;                    ///< of its mesh; null when it joins the runs of the open document
  DocumentPtr joins;                       ///< that one
  MeshStatePtr state;
};
/// Recorded iterations were looked at for breakpoints.
struct Scanned {
  std::vector<BreakHit> hits;
  std::optional<unsigned> stop;  ///< the iteration at which one stops; none: none did
  std::string broken_by;
};
/// Two branches were compared.
struct Compared {
  unsigned first = 0, second = 0;
  TraceDifference difference;
};
/// A file beside the mesh was written.
struct Wrote {
  std::filesystem::path path;
};

using Event = std::variant<Loaded, EnergyMeasured, Iterated, RunEnded, SurfaceMeasured, SurfaceGaveWay, Saved,
                           Failed, RunFailed, Sought, Inspected, Followed, TraceOpened, Compared, Wrote,
                           Scanned, Moved, MotionEnded, MotionInspected, MovingPath>;

}  // namespace isorelax::model
