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
constexpr PolishOptions kPolished{.goal = PolishGoal::both};
/// No triangle but the worst holds it back.
constexpr PolishOptions kForTheMean{.goal = PolishGoal::mean, .worst_share = 0};

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

/// Times a peer from the mesh as it was read to its last step, as ours are.
template <typename Mesh>
Result timed(const std::string& name, const std::function<Mesh()>& make,
             const std::function<void(Mesh&)>& smooth) {
  Result result{.name = name, .positions = {}, .seconds = 0, .failure = {}};
  try {
    const Stopwatch watch;
    Mesh mesh = make();
    smooth(mesh);
    result.seconds = watch.seconds();
    result.positions = mesh.positions();
  } catch (const std::exception& error) {
    result.failure = error.what();
  }
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
  return timed<CgalMesh>(
      name, [&] { return CgalMesh(mesh, held); }, [&](CgalMesh& copy) { (copy.*smooth)(iterations); });
}

Result openmesh(const TriangleMesh& mesh, std::span<const std::uint8_t> held) {
  return timed<HalfedgeMesh>(
      "OpenMesh tangential Laplace, " + std::to_string(kPeerIterations),
      [&] {
        HalfedgeMesh copy(mesh);
        if (!copy.rejected_triangles().empty()) throw MeshError("OpenMesh does not take this mesh");
        copy.hold(held);
        return copy;
      },
      [](HalfedgeMesh& copy) { copy.smooth_laplace(kPeerIterations); });
}

Result ours(const std::string& name, const TriangleMesh& mesh, const Topology& topology,
            const DeviationLimit& limit, const std::optional<PolishOptions>& polish,
            std::vector<Moment>& moments, SurfaceRule surface = SurfaceRule::project) {
  Result result{.name = name, .positions = mesh.positions, .seconds = 0, .failure = {}};
  ProblemOptions options;
  options.exponent = 2;
  options.threads = 1;
  options.surface = surface;
  double distance = 0;
  Stopwatch watch;
  run_bounded(
      result.positions, mesh.triangles, options,
      [](const SmoothingProblem& problem) { return make_smoother(problem, Solver::automatic); },
      {.iterations = kOurIterations, .tolerance = 1e-6}, limit,
      [&](unsigned, const StepRecord&, std::span<const Vec3> positions) {
        const double seconds = watch.seconds();
        watch.leave_out([&] {
          const QualityReport quality = measure_quality(positions, mesh.triangles, topology, 1);
          moments.push_back({seconds, quality.min_angle_deg, quality.mean_min_angle_deg});
        });
        return true;
      },
      polish,
      [&](const RunPart& part, std::span<const Vec3>) {
        // A run done again under a wider limit was sound; one that is to keep nearer was not.
        if (part.begins_run() && part.holds.distance <= distance) moments.clear();
        distance = part.holds.distance;
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

/// A mesh that is smoothed in turn, and the rows about it.
class Comparison {
 public:
  explicit Comparison(const TriangleMesh& mesh)
      : mesh_(mesh), topology_(mesh.triangles, mesh.vertex_count()), held_(held_vertices(mesh, topology_)) {}

  void run() {
    const Result best = ours("Isorelax", mesh_, topology_, {}, {}, moments_);
    far_ = measure_deviation(mesh_.positions, best.positions, mesh_.triangles, topology_).max;
    best_ = measure_quality(best.positions, mesh_.triangles, topology_);
    print_row({.name = "input", .positions = mesh_.positions, .seconds = 0, .failure = {}});
    const std::string fifty = std::to_string(kPeerIterations);
    against(cgal("CGAL angle smoothing, " + fifty, mesh_, held_, &CgalMesh::smooth_angles, kPeerIterations));
    against(cgal("CGAL angle and area smoothing, " + std::to_string(kPeerAreaIterations), mesh_, held_,
                 &CgalMesh::smooth_angles_and_areas, kPeerAreaIterations));
    against(cgal("CGAL tangential relaxation, " + fifty, mesh_, held_, &CgalMesh::relax_tangentially,
                 kPeerIterations));
    against(openmesh(mesh_, held_));
    print_row(best);
    std::vector<Moment> moments;
    print_row(ours("Isorelax, polished", mesh_, topology_, {}, kPolished, moments));
    print_row(ours("Isorelax, polished for the mean", mesh_, topology_, {}, kForTheMean, moments));
    std::printf("\n");
  }

 private:
  /// A peer's row, and ours that goes no farther from the input than the peer; polished, too, where the peer
  /// went less far, or farther and got better by it.
  void against(const Result& peer) {
    if (!peer.failure.empty()) {
      std::printf("  %-44s %s\n", peer.name.c_str(), peer.failure.c_str());
      return;
    }
    const QualityReport quality = measure_quality(peer.positions, mesh_.triangles, topology_);
    const double far = print_row(peer, time_to_reach(quality, moments_));
    std::vector<Moment> moments;
    const Result near = ours("Isorelax, no farther than that", mesh_, topology_, {.max = far}, {}, moments);
    print_row(near, time_to_reach(quality, moments));
    const bool as_good = best_.min_angle_deg >= quality.min_angle_deg &&
                         best_.mean_min_angle_deg >= quality.mean_min_angle_deg;
    if (far >= far_ && as_good) return;
    const auto polished = [&](const std::string& name, const PolishOptions& polish) {
      moments.clear();
      const Result result = ours(name, mesh_, topology_, {.max = far}, polish, moments);
      print_row(result, time_to_reach(quality, moments));
    };
    polished("Isorelax, no farther, polished", kPolished);
    polished("Isorelax, no farther, polished for the mean", kForTheMean);
    moments.clear();
    const Result along = ours("Isorelax, no farther, in tangent planes", mesh_, topology_, {.max = far}, {},
                              moments, SurfaceRule::tangent);
    print_row(along, time_to_reach(quality, moments));
  }

  /// Returns the largest distance from the input.
  double print_row(const Result& result, const std::string& ours_then = {}) const {
    const QualityReport quality = measure_quality(result.positions, mesh_.triangles, topology_);
    const Deviation deviation =
        measure_deviation(mesh_.positions, result.positions, mesh_.triangles, topology_);
    std::printf("  %-44s %7.2f %7.2f %7.2f  %8.1e %8.1e %8.1e %5zu %8.3f %9s\n", result.name.c_str(),
                quality.min_angle_deg, quality.max_angle_deg, quality.mean_min_angle_deg, deviation.max,
                deviation.rms, deviation.volume_change, quality.inverted, result.seconds, ours_then.c_str());
    std::fflush(stdout);
    return deviation.max;
  }

  const TriangleMesh& mesh_;
  Topology topology_;
  std::vector<std::uint8_t> held_;
  std::vector<Moment> moments_;  // of our own run
  QualityReport best_;           // of its result
  double far_ = 0;               // how far that is
};

void compare(const std::string& name, const TriangleMesh& mesh) {
  std::printf("%s, %zu triangles\n", name.c_str(), mesh.triangles.size());
  Comparison(mesh).run();
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
      "One thread each. Angles in degrees: smallest, largest, mean of the triangles' smallest. Distance\n"
      "from the input (largest, RMS) over its bounding-box diagonal, change of volume, inverted triangles,\n"
      "seconds from the mesh as it was read, and in the last column those in which Isorelax is as good as\n"
      "the peer in the smallest angle and the mean (-: it is not): free in the peer's row, and below it\n"
      "with the peer's distance as the limit. Peers hold the boundary and all features. Where a peer\n"
      "stays nearer to the input than Isorelax, or got better by going farther, that run is polished, too:\n"
      "the worst angles, then the mean while the worst tenth of the triangles stay as good as they are; or\n"
      "the mean alone, while the worst of all does. Peers do not come back to the surface: the last of "
      "these\n"
      "rows does not, either.\n\n");
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
