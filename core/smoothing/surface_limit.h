#pragma once

#include <span>
#include <vector>

#include "smoothing/line_bound.h"
#include "smoothing/problem.h"

namespace isorelax {

/// Tells where a mesh is farther from the surface as it was than the problem's NearSurface allows, either
/// way.
///
/// Where two triangulations lie over each other, the largest distance between them is at a vertex of one of
/// them or where two edges cross, and there it is nearly the same both ways unless one of them is sharp. So
/// every edge of now is measured against the surface of then, from end to end, and every vertex and every
/// sharp edge of then against the surface of now. The distance to one triangle is convex along an
/// edge: with the triangles nearest to two of its points, the larger of two values, or where two straight
/// lines cross, is a bound on all that lies between. Where the bound does not do, the edge is divided there.
/// As long as nothing that a bound depends on has moved by more than is left to the limit, nothing is
/// measured anew.
class SurfaceLimit {
 public:
  /// Keeps a reference to the problem.
  explicit SurfaceLimit(const SmoothingProblem& problem) : problem_(problem) {}

  /// Whom to blame for what is too far.
  enum class Blame : std::uint8_t {
    movers,  ///< those whose moves count at the farthest point: ends of an edge, corners of the nearest
             ///< triangle
    all,     ///< all ends, and all vertices about the nearest triangle and the one that was nearest
  };
  /// A vertex to blame, and the unit direction away from the surface as it was.
  struct Excess {
    Index vertex;
    Vec3 outwards;
  };
  /// What is too far with all vertices at `x`, sorted by vertices. What is asked of `all` came from `from`.
  [[nodiscard]] std::vector<Excess> too_far(std::span<const Vec3> x, Blame blame,
                                            std::span<const Vec3> from = {});

  /// Before vertices are moved one after another: where they are.
  void start(std::span<const Vec3> x);
  /// Whether all is near with one vertex moved to where it is in `x`; if so, that is where it is from now on.
  [[nodiscard]] bool keeps(std::span<const Vec3> x, Index vertex);

 private:
  /// The triangle nearest to a point, as far as a walk could tell.
  struct Foot {
    Index triangle = kNone;
    double distance = 0;
  };
  /// A point of a line, `share` of the way from its first end to its second.
  struct Sample {
    double share = 0;
    Foot foot;
  };
  /// A vertex that a line's bound depends on, and how far it had travelled when that was found.
  struct Use {
    Index vertex;
    double travelled;
  };
  /// An edge as it is, or an edge or vertex as it was, against the other surface.
  struct Line {
    double bound;           ///< on the distance of all its points when it was measured; infinite: too far
    Sample peak;            ///< the farthest point seen then
    std::vector<Use> uses;  ///< its ends, if it is one of now; corners of triangles of now, if one of then
  };
  /// What a line is measured with.
  struct View {
    bool now;  ///< an edge of now against the surface of then
    Vec3 first, second;
    std::span<const Vec3> surface;

    [[nodiscard]] Vec3 at(double share) const { return (1 - share) * first + share * second; }
  };

  void prepare();
  [[nodiscard]] bool is_of_now(std::size_t line) const { return line < count_now_; }
  [[nodiscard]] View view_of(std::size_t line, std::span<const Vec3> x) const;
  [[nodiscard]] SurfacePoint closest_of(const View& view, Index triangle, const Vec3& point) const;
  [[nodiscard]] SurfacePoint nearest(const View& view, const Vec3& point, Index triangle) const;
  [[nodiscard]] Foot foot_of(bool now, std::span<const Vec3> x, Index vertex) const;
  [[nodiscard]] bool is_near_still(const Line& line) const;
  void note_moves(std::span<const Vec3> x);
  void measure(std::size_t id, std::span<const Vec3> x, const std::array<Foot, 2>& ends);
  [[nodiscard]] bool is_near(const View& view, const Sample& a, const Sample& b, unsigned divisions,
                             Line& line) const;
  [[nodiscard]] double bound_along(const View& view, Index triangle) const;
  [[nodiscard]] LineBound bound(const View& view, const Sample& a, const Sample& b) const;
  void note_use(Line& line, Index vertex) const;
  void blame_for(std::size_t id, std::span<const Vec3> x, Blame blame, std::span<const Vec3> from,
                 std::vector<Excess>& to) const;
  [[nodiscard]] SurfacePoint surely_nearest(const View& view, const Vec3& point, Index triangle) const;

  const SmoothingProblem& problem_;
  double seen_ = 0, proven_ = 0;               // the largest distances that a sample and a bound may have
  std::size_t count_now_ = 0;                  // lines of now come first
  std::vector<std::array<Index, 2>> ends_of_;  // of each line; a vertex is both of its ends
  std::vector<Index> ends_;                    // of lines, each once
  std::vector<Line> lines_;
  std::vector<Foot> feet_now_, feet_then_;    // of the ends, by vertex
  std::vector<Vec3> last_;                    // positions in the last call
  std::vector<double> travelled_;             // by each vertex, in all
  std::vector<std::uint8_t> moves_;           // since the last call
  std::vector<std::vector<Excess>> far_;      // of each block
  std::vector<std::vector<Index>> lines_of_;  // for one vertex after another: the lines that use each vertex
};

}  // namespace isorelax
