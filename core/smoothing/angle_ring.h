#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "smoothing/bounded_move.h"
#include "smoothing/turn_limit.h"

namespace isorelax {

/// The extreme angles of a triangle, in degrees.
struct AngleRange {
  double min, max;
};
AngleRange angle_range(const Vec3& a, const Vec3& b, const Vec3& c);
/// The angles at a, at b and at c, in degrees.
std::array<double, 3> triangle_angles(const Vec3& a, const Vec3& b, const Vec3& c);
/// Gradients of the angles at a, at b and at c for a, in degrees per length.
std::array<Vec3, 3> angle_gradients(const Vec3& a, const Vec3& b, const Vec3& c);

/// What both angles are to get better than: those of the worst triangles at the start. The score of an angle
/// is the lesser of its two gains, in degrees.
struct AngleGoal {
  AngleRange start;
  double obtuse_weight;  ///< what a degree of a largest angle counts, beside one of a smallest

  [[nodiscard]] double of_small(double angle) const { return angle - start.min; }
  [[nodiscard]] double of_large(double angle) const { return obtuse_weight * (start.max - angle); }
};

/// The triangles around one vertex as functions of where it is, its neighbours held.
class AngleRing {
 public:
  /// A soft minimum -1/b log sum exp(-b s) of scores s in degrees (or a sum of such), and what a step towards
  /// a higher one needs.
  struct Soft {
    double value;
    Vec3 gradient;  ///< degrees per length
    Mat3
        spread;  ///< b times the covariance of the scores' gradients: minus the second derivative's main part
  };

  explicit AngleRing(const SmoothingProblem& problem) : problem_(problem), turns_(problem) {}

  /// Scores are those of this goal from now on.
  void aim_at(const AngleGoal& goal) { goal_ = goal; }

  /// Looks at the treated triangles around a vertex from now on.
  void look_at(std::span<const Vec3> positions, Index vertex);
  /// The triangles' numbers, and as many AngleRanges with the vertex at `at`.
  [[nodiscard]] std::span<const Index> triangles() const { return triangles_; }
  [[nodiscard]] std::span<const AngleRange> ranges(const Vec3& at);
  /// What keeps all angles within their triangles' bounds (by number) for moves from `at`, in degrees.
  [[nodiscard]] std::vector<MoveBound> move_bounds(const Vec3& at, std::span<const AngleRange> bounds);

  /// Whether no triangle turns over or too far when the vertex goes to `at`.
  [[nodiscard]] bool is_upright(const Vec3& at);
  /// The soft minimum of all scores of the ring.
  [[nodiscard]] double soft_minimum_value(const Vec3& at, double sharpness);
  [[nodiscard]] Soft soft_minimum(const Vec3& at, double sharpness);
  /// The sum of the triangles' soft minima, each of its own angles alone.
  [[nodiscard]] double sum_of_soft_minima_value(const Vec3& at, double sharpness);
  [[nodiscard]] Soft sum_of_soft_minima(const Vec3& at, double sharpness);
  /// Length of the shortest edge at the vertex.
  [[nodiscard]] double shortest_edge(const Vec3& at) const;

 private:
  struct Side {
    Vec3 a, b;    // the next and the previous vertex
    Vec3 normal;  // area vector where the vertex was
  };
  /// A triangle over an edge of one of the ring's: outside, or another one of the ring.
  struct Neighbour {
    std::size_t side;
    std::size_t other;  // side; kOutside
    Index triangle;
    Vec3 area;    // of one outside
    Folds folds;  // its others, of one outside
  };
  static constexpr std::size_t kOutside = SIZE_MAX;

  void find_neighbours(std::span<const Vec3> positions, Index vertex);
  [[nodiscard]] bool turns_back();
  /// Angles of all sides' triangles, in degrees, at the vertex, at a and at b, to angles_.
  void measure(const Vec3& at);
  void collect(const Vec3& at);
  void weigh(std::span<const double> scores, std::size_t group, double sharpness);
  [[nodiscard]] Soft soft_of(std::size_t first, std::span<const Vec3> gradients, double sharpness) const;

  const SmoothingProblem& problem_;
  TurnLimit turns_;
  AngleGoal goal_{};
  std::vector<Index> triangles_;
  std::vector<Side> sides_;
  std::vector<Neighbour> neighbours_;
  std::vector<Vec3> areas_;
  std::vector<Folds> folds_;
  std::vector<double> angles_;  // three for each side
  std::optional<Vec3> measured_at_;
  std::vector<double> scores_;
  std::vector<double> least_;    // of each group of scores
  std::vector<double> weights_;  // e^(-b (score - least)), and more to fill up
  std::vector<Vec3> gradients_;
  std::vector<AngleRange> ranges_;
};

}  // namespace isorelax
