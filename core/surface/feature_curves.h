#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// A local cubic or quartic through a vertex of a polyline, over its tangent there: the same idea as
/// HeightFit, one dimension lower.
class CurveFit {
 public:
  static constexpr int kMaxDegree = 4;

  CurveFit() = default;
  /// Weighted least squares through `samples` near `origin`; fewer than two leave no fit.
  CurveFit(const Vec3& origin, const Vec3& unit_tangent, std::span<const Vec3> samples);

  /// `point` moved across the tangent onto the fitted curve; `point` itself where there is no fit.
  [[nodiscard]] Vec3 lift(const Vec3& point) const;

  /// Direction of the fitted curve over `point`, with a part of one along the tangent.
  [[nodiscard]] Vec3 direction(const Vec3& point) const;

 private:
  Vec3 origin_ = Vec3::Zero();
  Vec3 tangent_ = Vec3::UnitX();
  double scale_ = 1;
  std::array<Vec3, kMaxDegree> coefficients_{};  ///< orthogonal to the tangent
  int degree_ = 0;
};

/// A place on a feature curve: `edge` counts the edges given to FeatureCurves.
struct CurvePoint {
  Index edge = kNone;
  Vec3 point = Vec3::Zero();
};

/// Creases and borders as chains of edges that vertices slide along. A chain passes through a vertex where
/// exactly two of the edges meet and no corner is; it never leaves itself for another one.
class FeatureCurves {
 public:
  using Edge = std::array<Index, 2>;

  FeatureCurves() = default;
  /// `is_corner` has an entry for each vertex. The first `creases` of the edges are taken as they are,
  /// without fits, where their chains turn by less than 5 degrees in the mean of the vertices in which they
  /// turn: drawn that finely, they say themselves what they are. O(edges).
  FeatureCurves(std::span<const Vec3> positions, std::span<const Edge> edges,
                std::span<const std::uint8_t> is_corner, std::size_t creases = 0);

  /// An edge at the vertex; kNone for a vertex on no curve.
  [[nodiscard]] Index edge_of(Index vertex) const { return edge_of_[vertex]; }

  /// The point of the smooth curve near `edge` that lies nearest to `point`: along the chain from `edge` as
  /// long as that comes nearer, then lifted from the straight edge to the blend of the fits at its two ends.
  /// Vertices of the curve are points of it; straight edges stay straight to the last digits.
  [[nodiscard]] CurvePoint project(const Vec3& point, Index edge) const;

  /// Unit direction of the smooth curve near `edge` at a point of it.
  [[nodiscard]] Vec3 direction_at(const Vec3& point, Index edge) const;

 private:
  struct Piece {
    Edge vertices;
    std::array<Index, 2> neighbour = {kNone, kNone};  ///< the piece that continues the chain at each end
    std::array<CurveFit, 2> fits;
    double largest_lift = 0;  ///< 0: straight
  };
  struct Foot {
    Index piece;
    double t;
    Vec3 point;
    double squared;
  };

  [[nodiscard]] bool are_fine(std::size_t creases) const;
  void link(std::span<const Edge> edges, std::span<const std::uint8_t> is_corner);
  [[nodiscard]] Vec3 direction(Index piece) const;
  [[nodiscard]] double turn(Index piece, unsigned end) const;
  [[nodiscard]] Vec3 tangent(Index piece, unsigned end) const;
  void gather(Index piece, unsigned end, std::size_t count, const Vec3& tangent, std::vector<Vec3>& to) const;
  void fit(Index piece, unsigned end);
  [[nodiscard]] bool continues(Index piece, unsigned end) const;
  [[nodiscard]] Foot foot(const Vec3& point, Index piece) const;
  [[nodiscard]] Foot walk(const Vec3& point, Index piece) const;
  [[nodiscard]] Vec3 lift(const Foot& foot) const;
  [[nodiscard]] Foot settle(const Vec3& point, Index edge) const;

  std::vector<Vec3> x_;  ///< all the mesh's vertices
  std::vector<Piece> pieces_;
  std::vector<Index> edge_of_;
};

}  // namespace isorelax
