#pragma once

#include "motion/block_system.h"
#include "motion/edge_middles.h"
#include "motion/isometry_element.h"

namespace isorelax {

/// How points on a carrier are redistributed.
struct CarrierRelaxationOptions {
  ElementWeights weights;
  unsigned iterations = 2;
  /// Weight of the damping of moves over ridges: what is given up of the angles for the shape.
  double ridge_damping = 5000;
  /// Share of l2 / l1 of the normal covariance at which a place counts as a ridge.
  double ridge_ratio = 0.05;
  /// Weight of the heights of the surface over the middles of the edges, of the squares of what is beyond the
  /// heights at the start, in mean edges: what keeps thin ends and rims from being cut off.
  double height_weight = 0;
  double shift = 0.03;        ///< over h^2, on every unknown
  double largest_move = 0.3;  ///< of the mean edge about a vertex
};

/// What one call did.
struct RelaxationReport {
  double energy_before = 0, energy_after = 0;
  unsigned steps = 0;  ///< that were accepted
};

/// Moves the vertices of a mesh over a moving surface towards a near isometry with a reference mesh: damped
/// Newton steps over all vertices at once, each vertex in its tangent plane, with the surface itself as
/// FlowMap knows it, not its triangles. No geometric error accumulates: whatever moves, positions are those
/// of the map.
class CarrierRelaxation {
 public:
  /// `reference`: the corners of each triangle's reference, which need not fit together. Their sizes count
  /// against each other only: they are scaled to the mesh's area.
  CarrierRelaxation(std::span<const Triangle> triangles, const Topology& topology,
                    std::span<const std::array<Vec3, 3>> reference, const CarrierRelaxationOptions& options,
                    unsigned threads);

  /// Heights that are not held against an edge: those of the mesh at the start. None known: none.
  void allow_heights(const FlowMap& map, std::span<const MaterialPoint> points,
                     std::span<const Vec3> positions);

  /// Changes `points` and `positions` (= map of the points), of vertices that are not held. What it does
  /// depends on its arguments alone, not on calls before.
  RelaxationReport relax(const FlowMap& map, std::span<const std::uint8_t> held,
                         std::span<MaterialPoint> points, std::span<Vec3> positions);

 private:
  bool step(const FlowMap& map, std::span<MaterialPoint> points, std::span<Vec3> positions,
            RelaxationReport& report);
  void scale_references(std::span<const Vec3> positions);
  void find_frames(const FlowMap& map, std::span<const MaterialPoint> points);
  void assemble(std::span<const Vec3> positions);
  void add_heights(const FlowMap& map);
  [[nodiscard]] double height_energy() const;
  void add_damping(std::span<const Vec3> positions);
  double trial_energy(const FlowMap& map, std::span<const Vec3> positions);
  [[nodiscard]] double longest_move() const;
  [[nodiscard]] bool lies_upside_down(const FlowMap& map, Index t) const;
  void try_moves(const FlowMap& map, std::span<const MaterialPoint> points);
  void hold_back();
  [[nodiscard]] double energy_of(Index t, std::span<const Vec3> positions) const;

  std::vector<Triangle> triangles_;
  const Topology* topology_;
  std::vector<std::uint8_t> held_;
  CarrierRelaxationOptions options_;
  unsigned threads_;
  BlockSystem system_;
  std::vector<ReferenceInverse> unscaled_, inverses_;
  double reference_area_ = 0;
  EdgeMiddles middles_;
  std::vector<Eigen::Matrix<double, 3, 2>> tangents_;
  std::vector<Eigen::Matrix2d> to_material_;
  std::vector<Eigen::Matrix<double, 3, 2>>
      material_moves_;  ///< of a unit move in the tangent frame, on the start surface
  std::vector<double> spacing_;
  std::vector<ElementModel> models_;
  std::vector<double> energies_, trial_energies_;
  std::vector<double> share_;
  double height_scale_ = 0;  ///< weight over the squared mean edge
  double growth_ = 1;        ///< of lengths since the start: root of the areas'
  std::vector<double> allowed_;
  double start_area_ = 0;
  double damping_ = 0.03;
  std::vector<MaterialPoint> trial_points_;
  std::vector<Vec3> trial_;
};

}  // namespace isorelax
