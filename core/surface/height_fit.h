#pragma once

#include <span>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// What a fit is made from: a point of the surface near the fitted one, and the surface's unit normal there.
struct FitSample {
  Vec3 point;
  Vec3 normal;
};

struct HeightFitOptions {
  int degree = 4;
  /// Samples for each unknown below which the degree is lowered.
  double samples_per_unknown = 1.5;
  /// Smallest share of a column that must be independent of the columns before it; below this the
  /// degree is lowered.
  double independence = 0.03;
};

/// A local height function over the tangent plane of a vertex, which passes through the vertex:
/// x = origin + u t1 + v t2 + f(u, v) n, f a polynomial of degree 2 to 4 without constant term.
class HeightFit {
 public:
  static constexpr int kMaxDegree = 4;
  static constexpr int kMaxSamples = 64;

  HeightFit() = default;

  /// How many samples the wanted degree takes.
  static std::size_t samples_for(const HeightFitOptions& options);

  /// Weighted least squares through the samples (at most the first kMaxSamples), by QR (modified
  /// Gram-Schmidt); the degree is lowered where there are too few of them or they determine too little (Jiao
  /// & Wang, "Reconstructing high-order surfaces for meshing", 2012). Weights fall with the distance and with
  /// the angle of the normals: what turns away by 90 degrees counts nothing.
  HeightFit(const Vec3& origin, const Vec3& unit_normal, std::span<const FitSample> samples,
            const HeightFitOptions& options = {});

  /// Degree in use, 2 or more; 0: there was too little to fit more than a plane.
  [[nodiscard]] int degree() const { return degree_; }

  /// `point` moved along the normal onto the fitted surface; `point` itself where there is no fit: a plane
  /// knows less than the triangles it came from.
  [[nodiscard]] Vec3 lift(const Vec3& point) const;

  /// Normal of the fitted surface over `point`, not of unit length but with a part of one along the fit's
  /// own; that own normal where there is no fit.
  [[nodiscard]] Vec3 normal(const Vec3& point) const;

 private:
  static constexpr int kMaxTerms = 14;

  Vec3 origin_ = Vec3::Zero();
  Vec3 normal_ = Vec3::UnitZ();
  Vec3 t1_ = Vec3::UnitX(), t2_ = Vec3::UnitY();  ///< tangents over the radius of the samples
  std::array<double, kMaxTerms> coefficients_{};
  int degree_ = 0;
};

}  // namespace isorelax
