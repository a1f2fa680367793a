#pragma once

#include "model/engine.h"

namespace isorelax::model {

/// An iteration of a recording; a null recording is the mesh as opened.
struct Place {
  std::shared_ptr<Recording> recording;
  unsigned iteration = 0;    ///< of the recording, from its start
  std::string not_redone{};  ///< why its steps cannot be done again; empty: they can
};

/// The positions there.
[[nodiscard]] std::vector<Vec3> positions_of(const Document& document, const Place& place);

/// What a problem is made from that goes on from a place: what the steps there were made from.
[[nodiscard]] BasePtr base_at(const Document& document, const Place& place);

/// What the step to a recorded iteration is made with.
struct StepMaking {
  Workbench::ProblemPtr problem;
  FeatureOptions features;
  /// One that keeps all detail and knows of no step before. Keeps a reference to the problem.
  std::function<std::unique_ptr<Smoother>()> smoother;
  BasePtr start;                    ///< of a step that would be the first; null: the mesh as opened
  const TracePart* part = nullptr;  ///< of a run that was read
  unsigned from = 0;                ///< iteration after which such a one made the steps
  bool from_base = false;  ///< ... from the positions that the problem is made from, not from those there
};

/// What the step to a place is made with: what its recording says, where it was read from a file, and else
/// these settings on the mesh as opened. Throws Error.
[[nodiscard]] StepMaking making_of(Workbench& bench, const DocumentPtr& document,
                                   const SmoothingSettings& settings, const Place& place);

/// A step that was found again.
struct FoundStep {
  std::shared_ptr<const StepRecord> record;
  std::vector<Vec3> before;
  std::string mismatch;  ///< it leads elsewhere than what was recorded; empty: it does not
};

/// Finds the record of the step to a place: the kept one, or by doing it again, if need be with all steps
/// since a smoother last began afresh. A place that is not recorded is that of the step to be made next.
/// Throws Error.
[[nodiscard]] FoundStep find_step(const JobContext& context, const DocumentPtr& document,
                                  const StepMaking& making, const Place& place);

/// The energy of positions at a place under these settings: by the recorded run's own measure while the
/// settings are those that it was read as.
[[nodiscard]] std::shared_ptr<const EnergyState> energy_at(Workbench& bench, const DocumentPtr& document,
                                                           const SmoothingSettings& settings,
                                                           const Place& place,
                                                           std::span<const Vec3> positions);

}  // namespace isorelax::model
