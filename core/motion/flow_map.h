#pragma once

#include <span>
#include <vector>

#include "motion/material_point.h"

namespace isorelax {

/// Where a material point is now, and how the surface lies there.
struct MappedPoint {
  Vec3 position = Vec3::Zero();
  /// Derivatives of the position along the frame of the point's triangle.
  Eigen::Matrix<double, 3, 2> jacobian = Eigen::Matrix<double, 3, 2>::Zero();
};

/// The motion of a whole surface from the known motion of the vertices of its start mesh (the carrier).
///
/// At every carrier vertex the map is a polynomial of degree 3 over the start mesh's tangent plane that
/// passes through the vertex and fits two rings of others (least squares; the degree falls where there are
/// too few); over a triangle the three polynomials are blended with weights that make the blend smooth. What
/// is fitted is smooth in the start surface's coordinates, however far the surface is stretched: the error
/// stays that of the start mesh, h^4, and does not grow with what happens to the points that are mapped. The
/// fits are linear in the carrier's positions; their matrices are made once. Fits do not cross walls.
class FlowMap {
 public:
  /// `walls` are creases; borders are walls by themselves. Keeps a reference to the surface.
  FlowMap(const MaterialSurface& surface, const Topology& topology, const EdgeWalls& walls, unsigned threads);

  /// Takes up new positions of the carrier's vertices.
  void set_carrier(std::span<const Vec3> positions);

  [[nodiscard]] MappedPoint map(const MaterialPoint& m) const;
  [[nodiscard]] Vec3 position(const MaterialPoint& m) const;
  [[nodiscard]] const MaterialSurface& surface() const { return *surface_; }

 private:
  static constexpr int kTerms = 9;  ///< of a cubic in two variables without constant
  using Coefficients = Eigen::Matrix<double, 3, kTerms>;
  struct Fit {
    Index vertex = 0;
    double scale = 1;  ///< one over the radius of the samples
    std::array<Vec3, 2> tangents;
    std::uint32_t first = 0, count = 0;  ///< samples and columns of its matrix
  };
  void make_fit(Index sector, std::vector<Index>& samples, Eigen::MatrixXd& matrix);

  const MaterialSurface* surface_;
  unsigned threads_;
  Sectors sectors_;
  std::vector<Fit> fits_;                            ///< of the sectors
  std::vector<Index> samples_;                       ///< carrier vertices, fit by fit
  std::vector<std::array<double, kTerms>> columns_;  ///< what each sample adds to the coefficients
  std::vector<Vec3> carrier_;
  std::vector<Coefficients> coefficients_;
};

}  // namespace isorelax
