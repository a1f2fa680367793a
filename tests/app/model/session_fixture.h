#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <vector>

#include "app/temporary_mesh.h"
#include "io/mesh_file.h"
#include "model/command.h"
#include "smoothing/bounded_run.h"

namespace isorelax::model {

/// A session whose commands are waited for.
class SessionFixture : public ::testing::Test {
 protected:
  void act(const Command& command) {
    execute(session, command);
    finish(session);
  }
  void set(const std::function<void(SmoothingSettings&)>& change) {
    SmoothingSettings settings = session.smoothing;
    change(settings);
    act(SetSmoothing{settings, "test"});
  }
  void open(const TriangleMesh& mesh, const char* name = "mesh.off") {
    (void)write_mesh(folder / name, mesh);
    act(OpenFile{folder / name});
  }
  [[nodiscard]] std::vector<Vec3> shown() const {
    const auto x = session.current->positions();
    return {x.begin(), x.end()};
  }
  [[nodiscard]] const Timeline& timeline() const { return session.timeline; }

  test::TemporaryFolder folder;
  Session session;
};

/// Where isorelax smooth leads with the automatic solver and exponent 2.
inline std::vector<Vec3> smoothed(const TriangleMesh& mesh, const DeviationLimit& limit,
                                  const std::optional<PolishOptions>& polish = {},
                                  ProblemOptions options = {}) {
  options.exponent = 2;
  std::vector<Vec3> positions = mesh.positions;
  run_bounded(
      positions, mesh.triangles, options,
      [](const SmoothingProblem& problem) { return isorelax::make_smoother(problem, Solver::automatic); }, {},
      limit, {}, polish);
  return positions;
}

}  // namespace isorelax::model
