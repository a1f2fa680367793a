// Isorelax beside CGAL's angle_and_area_smoothing and tangential_relaxation and OpenMesh's Laplace smoother,
// one after another on the same meshes: quality reached, distance from the input, time, and how long Isorelax
// takes to be at least as good as the peer in the end, in the worst angle and in the mean.
//
//   bench_peers [MESH...]      without names: squares, a sphere, a torus, and scans of libcgal-demo
#include <chrono>
#include <cstdio>
#include <cstring>
#include <functional>
#include <optional>
#include <sstream>
#include <string>

#include "cgal_peers.h"
#include "generate/generate.h"
#include "io/mesh_file.h"
#include "mesh/error.h"
#include "mesh/halfedge_mesh.h"
#include "quality/report.h"
#include "smoothing/bounded_run.h"

namespace isorelax::bench {
namespace {

constexpr unsigned kPeerIterations = 50;
constexpr unsigned kOurIterations = 200;
/// Areas go through Ceres, vertex by vertex.
constexpr unsigned kPeerAreaIterations = 10;

struct Result {
  std::string name;
  std::vector<Vec3> positions;
  double seconds = 0;
  std::string failure;  ///< why there are no positions
};

/// How good a run of ours was at a time.
struct Moment {
  double seconds, min_angle_deg, mean_min_angle_deg;
};

class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count() - paused_;
  }
  /// Runs `work` without counting its time.
  void leave_out(const std::function<void()>& work) {
    const auto begin = Clock::now();
    work();
    paused_ += std::chrono::duration<double>(Clock::now() - begin).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
  double paused_ = 0;
};

Result timed(const std::string& name, const std::function<void()>& smooth,
             const std::function<std::vector<Vec3>()>& positions) {
  Result result{.name = name, .positions = {}, .seconds = 0, .failure = {}};
  const Stopwatch watch;
  smooth();
  result.seconds = watch.seconds();
  result.positions = positions();
  return result;
}

/// What must not move for the peers: the boundary and every feature, so that they keep what we keep. (Ours
/// slide along features.)
std::vector<std::uint8_t> held_vertices(const TriangleMesh& mesh, const Topology& topology) {
  const VertexClasses classes = classify_vertices(mesh.positions, mesh.triangles, topology, {}, 1);
  std::vector<std::uint8_t> held;
  for (const VertexClass c : classes.classes) held.push_back(c == VertexClass::smooth ? 0 : 1);
  return held;
}

Result cgal(const std::string& name, const TriangleMesh& mesh, std::span<const std::uint8_t> held,
            void (CgalMesh::*smooth)(unsigned), unsigned iterations) {
  try {
    CgalMesh copy(mesh, held);
    return timed(
        name, [&] { (copy.*smooth)(iterations); }, [&] { return copy.positions(); });
  } catch (const std::exception& error) {
    return {.name = name, .positions = {}, .seconds = 0, .failure = error.what()};
  }
}

Result openmesh(const TriangleMesh& mesh) {
  HalfedgeMesh copy(mesh);
  const std::string name = "OpenMesh tangential Laplace, " + std::to_string(kPeerIterations);
  if (!copy.rejected_triangles().empty())
    return {.name = name, .positions = {}, .seconds = 0, .failure = "OpenMesh does not take this mesh"};
  return timed(
      name, [&] { copy.smooth_laplace(kPeerIterations); }, [&] { return copy.positions(); });
}

Result ours(const TriangleMesh& mesh, const Topology& topology, std::vector<Moment>& moments) {
  Result result{.name = "Isorelax, up to " + std::to_string(kOurIterations),
                .positions = mesh.positions,
                .seconds = 0,
                .failure = {}};
  ProblemOptions options;
  options.exponent = 2;
  options.threads = 1;
  Stopwatch watch;
  run_bounded(
      result.positions, mesh.triangles, options,
      [](const SmoothingProblem& problem) { return make_smoother(problem, Solver::automatic); },
      {.iterations = kOurIterations, .tolerance = 1e-6}, {},
      [&](unsigned iteration, const StepRecord&, std::span<const Vec3> positions) {
        const double seconds = watch.seconds();
        watch.leave_out([&] {
          if (iteration == 1)
            moments.clear();  // a run done again with more held counts from the first one on
          const QualityReport quality = measure_quality(positions, mesh.triangles, topology, 1);
          moments.push_back({seconds, quality.min_angle_deg, quality.mean_min_angle_deg});
        });
        return true;
      });
  result.seconds = watch.seconds();
  return result;
}

std::string time_to_reach(const QualityReport& quality, std::span<const Moment> moments) {
  for (const Moment& moment : moments) {
    if (moment.min_angle_deg < quality.min_angle_deg ||
        moment.mean_min_angle_deg < quality.mean_min_angle_deg)
      continue;
    char text[32];
    std::snprintf(text, sizeof text, "%.3f", moment.seconds);
    return text;
  }
  return "-";
}

void print_row(const Result& result, const TriangleMesh& mesh, const Topology& topology,
               std::span<const Moment> moments) {
  if (!result.failure.empty()) {
    std::printf("  %-44s %s\n", result.name.c_str(), result.failure.c_str());
    return;
  }
  const QualityReport quality = measure_quality(result.positions, mesh.triangles, topology);
  const Deviation deviation = measure_deviation(mesh.positions, result.positions, mesh.triangles, topology);
  std::printf("  %-44s %7.2f %7.2f %7.2f  %8.1e %8.1e %8.1e %5zu %8.3f %9s\n", result.name.c_str(),
              quality.min_angle_deg, quality.max_angle_deg, quality.mean_min_angle_deg, deviation.max,
              deviation.rms, deviation.volume_change, quality.inverted, result.seconds,
              moments.empty() ? "" : time_to_reach(quality, moments).c_str());
  std::fflush(stdout);
}

void compare(const std::string& name, const TriangleMesh& mesh) {
  const Topology topology(mesh.triangles, mesh.vertex_count());
  const std::vector<std::uint8_t> held = held_vertices(mesh, topology);
  std::printf("%s, %zu triangles\n", name.c_str(), mesh.triangles.size());
  std::vector<Moment> moments;
  const Result best = ours(mesh, topology, moments);
  print_row({.name = "input", .positions = mesh.positions, .seconds = 0, .failure = {}}, mesh, topology, {});
  const std::string fifty = std::to_string(kPeerIterations);
  print_row(cgal("CGAL angle smoothing, " + fifty, mesh, held, &CgalMesh::smooth_angles, kPeerIterations),
            mesh, topology, moments);
  print_row(cgal("CGAL angle and area smoothing, " + std::to_string(kPeerAreaIterations), mesh, held,
                 &CgalMesh::smooth_angles_and_areas, kPeerAreaIterations),
            mesh, topology, moments);
  print_row(cgal("CGAL tangential relaxation, " + fifty, mesh, held, &CgalMesh::relax_tangentially,
                 kPeerIterations),
            mesh, topology, moments);
  print_row(openmesh(mesh), mesh, topology, moments);
  print_row(best, mesh, topology, {});
  std::printf("\n");
}

void compare_made() {
  const auto made = [](ShapeKind kind, GenerateOptions options) { return generate(kind, options); };
  compare("random square", made(ShapeKind::random_square, {.seed = 1, .triangles = 2126}));
  compare("random square", made(ShapeKind::random_square, {.seed = 2, .triangles = 10282}));
  compare("shaken rows", made(ShapeKind::hexagonal_square, {.seed = 1, .triangles = 2394}));
  compare("random sphere", made(ShapeKind::random_sphere, {.seed = 1, .vertices = 5832}));
  compare("shaken torus", made(ShapeKind::torus, {.seed = 1, .triangles = 10000, .jitter = 0.4}));
}

int run(std::span<char*> names) {
  std::printf(
      "One thread each. Angles in degrees: smallest, largest, mean of the triangles' smallest. Distance from "
      "the "
      "input\n(largest, RMS) over its bounding-box diagonal, change of volume, inverted triangles, seconds, "
      "and in "
      "the last column\nthe seconds that Isorelax takes to be as good as the peer in the smallest angle and "
      "the "
      "mean (-: it is not).\nPeers hold the boundary and all features.\n\n");
  std::printf("  %-44s %7s %7s %7s  %8s %8s %8s %5s %8s %9s\n\n", "", "min", "max", "mean", "max dev",
              "rms dev", "volume", "inv", "seconds", "ours then");
  if (!names.empty()) {
    for (const char* name : names) compare(name, read_mesh(name).mesh);
    return 0;
  }
  compare_made();
  std::istringstream corpus(ISORELAX_CORPUS_MESHES);
  for (std::string name; corpus >> name;) {
    const std::string path = std::string(ISORELAX_CORPUS_DIR) + "/" + name + ".off";
    compare(name, read_mesh(path).mesh);
  }
  return 0;
}

}  // namespace
}  // namespace isorelax::bench

int main(int argc, char** argv) {
  try {
    return isorelax::bench::run(std::span(argv + 1, static_cast<std::size_t>(argc - 1)));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_peers: %s\n", error.what());
    return 1;
  }
}
