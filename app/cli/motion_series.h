#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/json.h"
#include "motion/motion_run.h"

namespace isorelax::cli {

/// A folder with the states of a run, an index of them for ParaView, and a log.
///
///   start.ply          the mesh it starts from
///   run.json           what was asked for: who resumes asks for the same
///   state_000000.ply   every written state; all that a run needs to go on from it
///   states.ply.series  the states with their times (ParaView opens it)
///   state_000000.vtp, states.pvd   the same for VTK, where wanted
///   log.json           one entry for every step
///
/// Every file is written whole or not at all, a state before what names it.
class MotionSeries {
 public:
  explicit MotionSeries(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Makes the folder and writes start.ply and run.json. Throws OutputError; UsageError where a run is there
  /// already.
  void begin(const TriangleMesh& start, const Json& run);
  /// Writes a state and brings index and log up to it.
  void write_state(const MotionRun& run, bool vtk);
  void add(const MotionEntry& entry);
  /// Writes the log as it stands.
  void write_log() const;
  /// Reads log and index again, up to and with a step: what a run that goes on from there adds to.
  void resume_at(std::size_t step);

  [[nodiscard]] const Json& log() const { return log_; }
  [[nodiscard]] std::vector<std::filesystem::path> states() const;

 private:
  struct Item {
    std::string name;
    std::size_t step;
    double time;
  };
  void write_indices(bool vtk) const;

  std::filesystem::path folder_;
  std::vector<Item> items_;
  Json log_ = Json::array();
};

/// A state as write_state wrote it. Throws InputError where the file is none.
[[nodiscard]] MovingState read_state(const std::filesystem::path& path);

/// One entry of the log.
[[nodiscard]] Json entry_json(const MotionEntry& entry);

}  // namespace isorelax::cli
