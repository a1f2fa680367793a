#pragma once

#include <filesystem>

#include "model/redo.h"

namespace isorelax::model {

/// Opens a file: Loaded or Failed.
[[nodiscard]] Engine::Job load_job(std::filesystem::path path, SmoothingSettings settings);

/// Opens a sphere: Loaded.
[[nodiscard]] Engine::Job sphere_job(const SphereStart& sphere, SmoothingSettings settings);

/// Measures the energy of two states under new settings, the current one at its place: EnergyMeasured or
/// Failed.
[[nodiscard]] Engine::Job energy_job(DocumentPtr document, SmoothingSettings settings, MeshStatePtr original,
                                     MeshStatePtr current, Place place);

struct RunRequest {
  DocumentPtr document;
  SmoothingSettings settings;
  MeshStatePtr start;
  unsigned iterations = 1;
  unsigned series = 0;  ///< for the rows
  /// What is recorded into; a new one begins at the start.
  std::shared_ptr<Recording> recording;
  Place left;  ///< where a new one leaves another
  unsigned branch = 0;
  PartKind kind = PartKind::solver;
  std::vector<Breakpoint> breakpoints;
  std::size_t step_budget = StepStore::kDefaultBudget;  ///< bytes of full step records
};
/// Runs the smoother from a state: Iterated as often as the view keeps up, then RunEnded; or RunFailed.
[[nodiscard]] Engine::Job run_job(RunRequest request);

/// Measures how far a state, which is at a place, is from the document's mesh: SurfaceMeasured, or
/// SurfaceGaveWay where other jobs wait.
[[nodiscard]] Engine::Job surface_job(DocumentPtr document, SmoothingSettings settings, MeshStatePtr state,
                                      Place place);

/// Writes the document with a state's positions: Saved or Failed.
[[nodiscard]] Engine::Job save_job(DocumentPtr document, MeshStatePtr state, std::filesystem::path path);

}  // namespace isorelax::model
