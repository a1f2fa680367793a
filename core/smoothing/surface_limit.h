#pragma once

#include <span>
#include <vector>

#include "smoothing/problem.h"

namespace isorelax {

/// Tells where a mesh is farther from the surface as it was than the problem's NearSurface allows, either
/// way.
///
/// Where two triangulations lie over each other, the largest distance between them is at a vertex of one of
/// them or where two edges cross. Measured are the edges of now, from end to end, and the vertices and edges
/// as they were, each by walking over the triangles of the other surface from the one that was nearest last.
/// As long as nothing has moved by more than is left to the limit, nothing is measured anew.
class SurfaceLimit {
 public:
  /// Keeps a reference to the problem.
  explicit SurfaceLimit(const SmoothingProblem& problem);

  /// Whom to blame for what is too far.
  enum class Blame : std::uint8_t {
    movers,  ///< those whose moves count at the farthest point: ends of an edge, corners of the nearest
             ///< triangle
    all,     ///< all ends, and all vertices about the nearest triangle
  };
  /// A vertex to blame, and the unit direction away from the surface as it was.
  struct Excess {
    Index vertex;
    Vec3 outwards;
  };
  /// What is too far with all vertices at `x`, sorted by vertices.
  [[nodiscard]] std::vector<Excess> too_far(std::span<const Vec3> x, Blame blame);

  /// Before vertices are moved one after another: where they are.
  void start(std::span<const Vec3> x);
  /// Whether all is near with one vertex moved to where it is in `x`; if so, that is where it is from now on.
  [[nodiscard]] bool keeps(std::span<const Vec3> x, Index vertex);

 private:
  using Corners = std::array<Vec3, 3>;
  /// An edge of now.
  struct Edge {
    std::array<Index, 2> vertices;
    std::array<Vec3, 2> ends;  // when it was measured
    double distance = 0;       // the largest then
    double share = 0;          // where, from the first end to the second
    Index near;                // a triangle of then
  };
  /// What was measured at a point of then.
  struct Probe {
    Index triangle;   // of now, nearest to it
    Corners corners;  // of that
    double distance = 0;
  };
  /// The farthest point of a line.
  struct Peak {
    double bound = 0;
    double share = 0;
    Index triangle = kNone;
  };
  /// A vertex of then is a line from itself to itself with one probe, an edge has three inside.
  struct Line {
    std::array<Index, 2> ends;
    std::uint32_t first_probe, probes;
    double length;
    Peak peak;                   // when it was measured
    std::uint32_t measured = 0;  // in this call
  };

  [[nodiscard]] Vec3 point_of(const Line& line, double share) const;
  [[nodiscard]] Corners corners_of(std::span<const Vec3> x, Index triangle) const;
  [[nodiscard]] SurfacePoint walk(std::span<const Vec3> x, const Vec3& point, Index triangle) const;
  [[nodiscard]] SurfacePoint nearest_then(const Vec3& point, Index triangle) const;
  [[nodiscard]] double slope_along(const std::array<Index, 2>& ends) const;
  [[nodiscard]] bool is_settled(double distance, double slope, double length) const;
  void measure(std::span<const Vec3> x, Edge& edge) const;
  [[nodiscard]] double probe(std::span<const Vec3> x, const Vec3& point, Probe& last) const;
  [[nodiscard]] Peak peak_of(std::span<const Vec3> x, const Line& line);
  void note_moves(std::span<const Vec3> x);
  [[nodiscard]] bool has_moved_since(Index triangle, std::uint32_t call) const;
  [[nodiscard]] bool is_as_measured(const Line& line) const;
  void blame_edge(const Edge& edge, std::span<const Vec3> x, Blame blame, std::vector<Excess>& to) const;
  void blame_about(const Line& line, const Peak& peak, std::span<const Vec3> x, Blame blame,
                   std::vector<Excess>& to) const;

  const SmoothingProblem& problem_;
  double allowed_ = 0;
  std::vector<Edge> edges_;
  std::vector<Line> lines_;
  std::vector<Probe> probes_;
  std::vector<std::vector<Excess>> far_;  // of each block
  std::vector<Vec3> last_;                // positions in the last call
  std::vector<std::uint32_t> moved_;      // the call before which a vertex moved last
  std::vector<std::uint32_t> stirred_;    // the same of a vertex or its neighbours
  std::uint32_t call_ = 0;
  // For one vertex after another: the edges of each vertex, the lines whose probes are nearest to a triangle.
  std::vector<std::vector<Index>> edges_at_, lines_near_;
};

}  // namespace isorelax
