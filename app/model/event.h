#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "model/mesh_state.h"
#include "smoothing/run.h"

namespace isorelax::model {

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
  StepTotals before, after;
  std::array<std::size_t, 8> limits{};  ///< vertices per bit of Limit
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
};
/// The energy of the original and of the current state under new settings.
struct EnergyMeasured {
  DocumentPtr document;
  std::shared_ptr<const Geometry> original_geometry, current_geometry;
  std::shared_ptr<const EnergyState> original, current;
  std::vector<std::string> notes;
};
/// One or more iterations were done; `state` is the newest measured one, or null.
struct Iterated {
  std::vector<IterationRow> rows;
  MeshStatePtr state;
  StepSummary step;
};
/// A run ended; its last state came with an Iterated before it.
struct RunEnded {
  RunResult result;
};
struct Saved {
  std::filesystem::path path;
  MeshStatePtr state;
  std::vector<std::string> notes;
};
/// A job could not do what it was asked; nothing else has changed.
struct Failed {
  std::string text;
};
/// A run could not start or broke off with an error.
struct RunFailed {
  std::string text;
};

using Event = std::variant<Loaded, EnergyMeasured, Iterated, RunEnded, Saved, Failed, RunFailed>;

}  // namespace isorelax::model
