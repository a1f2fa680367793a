#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "motion/motion_run.h"

namespace isorelax::cli {

struct MotionTableOptions {
  std::size_t vertices = 5832;
  double step = 0.01;
  /// Sizes of the convergence study; empty: none.
  std::vector<std::size_t> convergence = {1500, 6000, 24000};
  unsigned threads = 0;
};

/// One preset carried through Eq. (10) of one period.
struct MotionRow {
  std::string preset;
  double period = 3;
  std::size_t vertices = 0;
  MotionEntry middle;       ///< at half the period, where the deformation is largest, with the dense copy
  MotionEntry end;          ///< at the period: back on the sphere
  double worst_volume = 0;  ///< largest |change| on the way
  double least_angle_deg = 180;  ///< smallest angle on the way
  double seconds_a_step = 0;
  std::array<TriangleMesh, 3> meshes;  ///< at a quarter, a half and the whole of the period
  std::string failure;                 ///< why it ended early; then `end` is where it did
};

struct MotionTable {
  MotionTableOptions options;
  std::vector<MotionRow> rows;         ///< none, paper, accuracy, balanced, angles at T = 3
  std::vector<MotionRow> quarter;      ///< the same at T = 0.75
  std::vector<MotionRow> convergence;  ///< balanced at T = 0.75, size by size
};

/// A goal: what was wanted, what came out.
struct MotionGoal {
  std::string wanted, found;
  bool met = false;
};

/// Runs everything. `progress` gets the share done and what is at work.
[[nodiscard]] MotionTable compute_motion_table(const MotionTableOptions& options,
                                               const std::function<void(double, std::string_view)>& progress);
/// The goals for Eq. (10), with figures of earlier prototypes to be beaten.
[[nodiscard]] std::vector<MotionGoal> motion_goals(const MotionTable& table);

/// Radius of the sphere that all runs start from.
inline constexpr double kMotionRadius = 0.15;

}  // namespace isorelax::cli
