#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "mesh/topology.h"

namespace isorelax {

/// The near-isometry energy with a determinant that may be negative (method Sec. 10), for some free vertices
/// of a mesh in the tangent planes of a field of normals:
///   sum over triangles of (K D2 / D1 + share (d^2 + 1)) / chi,  chi = (d + sqrt(eps^2 + d^2)) / 2,  d = D2 /
///   D1
/// with D2 signed against the triangle's normal of the field. Finite everywhere for eps > 0; as eps goes to 0
/// it becomes the energy of sound triangles, and infinite on others.
class RegularisedEnergy {
 public:
  /// `normals` are unit, one per triangle. Keeps references to positions (of fixed vertices), triangles,
  /// topology and normals; `free` must be distinct and each in a triangle. `doubled_area` is D1 of all.
  RegularisedEnergy(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                    const Topology& topology, std::span<const Vec3> normals, std::span<const Index> free,
                    double doubled_area, unsigned threads);

  /// Two coordinates for each free vertex, relative to where it was: zero at the start.
  [[nodiscard]] Eigen::Index dimension() const { return 2 * static_cast<Eigen::Index>(free_.size()); }
  double operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient);
  /// The smallest d at x.
  [[nodiscard]] double worst_determinant(const Eigen::VectorXd& x);
  /// Writes the free vertices where x says.
  void place(const Eigen::VectorXd& x, std::span<Vec3> positions) const;

  void set_epsilon(double epsilon) { epsilon_ = epsilon; }

 private:
  void move_to(const Eigen::VectorXd& x);
  [[nodiscard]] double determinant(Index triangle) const;
  double add(std::size_t slot);

  std::span<const Triangle> triangles_;
  std::span<const Vec3> normals_;
  std::vector<Index> free_;
  std::vector<Index> region_;                  ///< triangles at free vertices
  std::vector<std::array<Vec3, 2>> tangents_;  ///< of each free vertex
  std::vector<std::uint32_t> offsets_;         ///< of each free vertex into corners_
  std::vector<std::uint32_t> corners_;         ///< 3 * slot in region_ + corner
  std::vector<Vec3> start_, at_;               ///< of all vertices
  std::vector<std::array<Vec3, 3>> slopes_;    ///< per slot: gradient at its three corners
  std::vector<double> partials_;
  double d1_;
  double epsilon_ = 1;
  unsigned threads_;
};

}  // namespace isorelax
