#pragma once

#include "generate/generate.h"
#include "smoothing/run.h"
#include "trace/recorder.h"

namespace isorelax::test {

/// A run of a few Newton steps on a small random square, recorded; and every position it went through.
struct Recorded {
  TriangleMesh mesh;
  Trace trace;
  std::vector<std::vector<Vec3>> positions;
};

inline Recorded record(unsigned iterations = 6, std::uint64_t seed = 1) {
  Recorded recorded;
  GenerateOptions shape;
  shape.triangles = 120;
  shape.seed = seed;
  recorded.mesh = generate(ShapeKind::random_square, shape);
  const SmoothingProblem problem = make_problem(recorded.mesh.positions, recorded.mesh.triangles, {});
  Trace about;
  about.program = "isorelax test";
  about.input = "square.off";
  about.arguments = {"--iterations", std::to_string(iterations)};
  TraceRecorder recorder(about, recorded.mesh);
  recorded.positions.push_back(recorded.mesh.positions);
  std::vector<Vec3> positions = recorded.mesh.positions;
  const auto smoother = make_newton(problem);
  const RunResult result = run(*smoother, problem, positions, {.iterations = iterations, .tolerance = 0},
                               [&](unsigned iteration, const StepRecord& step, std::span<const Vec3> now) {
                                 recorder.add(iteration, step, now);
                                 recorded.positions.emplace_back(now.begin(), now.end());
                                 return true;
                               });
  recorder.trace().stopped = name_of(result.stopped);
  recorder.trace().stopped_because = to_string(result.stopped);
  recorded.trace = recorder.trace();
  return recorded;
}

}  // namespace isorelax::test
