#include "surface/height_fit.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace isorelax {
namespace {

/// Monomials of degree 1..d in two variables.
constexpr int term_count(int degree) {
  return (degree + 1) * (degree + 2) / 2 - 1;
}

/// u, v, u^2, u v, v^2, u^3, ...: a lower degree is a leading part.
template <typename Row>
void fill_terms(double u, double v, int degree, Row&& row) {
  row[0] = u;
  row[1] = v;
  int from = 0;
  for (int d = 2, to = 2; d <= degree; ++d) {
    for (int i = 0; i < d; ++i) row[to + i] = row[from + i] * u;
    row[to + d] = row[from + d - 1] * v;
    from = to;
    to += d + 1;
  }
}

constexpr int kMaxTerms = term_count(HeightFit::kMaxDegree);
constexpr int kMaxRows = HeightFit::kMaxSamples;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxRows, kMaxTerms>;
using Heights = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxRows, 1>;
using Terms = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxTerms, 1>;

/// Least squares a * coefficients = b of the highest degree that `a` determines; destroys a and b. Returns
/// that degree, or 0 where it is under 2.
int solve(Matrix& a, Heights& b, int degree, double independence, std::span<double> coefficients) {
  Terms scale = a.colwise().norm();
  for (Eigen::Index k = 0; k < scale.size(); ++k) {
    scale[k] = scale[k] > 0 ? 1 / scale[k] : 0;
    a.col(k) *= scale[k];
  }
  const Eigen::HouseholderQR<Eigen::Ref<Matrix>> qr(a);
  const auto& r = qr.matrixQR();
  // |R_kk| is the part of a unit column that the columns before it do not explain.
  const auto determined = [&](int d) {
    for (int k = 0; k < term_count(d); ++k)
      if (!(std::abs(r(k, k)) >= independence)) return false;
    return true;
  };
  while (degree > 1 && !determined(degree)) --degree;
  if (degree < 2) return 0;
  const int terms = term_count(degree);
  b.applyOnTheLeft(qr.householderQ().adjoint());
  Terms solution = b.head(terms);
  r.topLeftCorner(terms, terms).triangularView<Eigen::Upper>().solveInPlace(solution);
  for (int k = 0; k < terms; ++k) coefficients[k] = solution[k] * scale[k];
  return degree;
}

/// First tangent of a frame that turns with the samples, so that the fit does not depend on how the surface
/// lies in space: halfway between where they spread most and least. Of samples near a line u and v are then
/// almost the same, and what they do not determine shows.
Vec3 frame_tangent(const Vec3& origin, const Vec3& normal, std::span<const FitSample> samples) {
  const Vec3 t1 = normal.unitOrthogonal();
  const Vec3 t2 = normal.cross(t1);
  double uu = 0, uv = 0, vv = 0;
  for (const FitSample& s : samples) {
    const Vec3 d = s.point - origin;
    const double u = d.dot(t1), v = d.dot(t2);
    uu += u * u, uv += u * v, vv += v * v;
  }
  const double angle = 0.5 * std::atan2(2 * uv, uu - vv) + 0.25 * std::numbers::pi;
  return std::cos(angle) * t1 + std::sin(angle) * t2;
}

}  // namespace

std::size_t HeightFit::samples_for(const HeightFitOptions& options) {
  const int terms = term_count(std::min(options.degree, kMaxDegree));
  return static_cast<std::size_t>(std::ceil(options.samples_per_unknown * terms));
}

HeightFit::HeightFit(const Vec3& origin, const Vec3& unit_normal, std::span<const FitSample> samples,
                     const HeightFitOptions& options)
    : origin_(origin), normal_(unit_normal) {
  samples = samples.first(std::min<std::size_t>(samples.size(), kMaxSamples));
  t1_ = frame_tangent(origin_, normal_, samples);
  t2_ = normal_.cross(t1_);
  double radius2 = 0, mean2 = 0;
  for (const FitSample& s : samples) {
    radius2 = std::max(radius2, (s.point - origin).squaredNorm());
    mean2 += (s.point - origin).squaredNorm() / static_cast<double>(samples.size());
  }
  if (!(radius2 > 0)) return;
  const double scale = 1 / std::sqrt(radius2);
  t1_ *= scale;
  t2_ *= scale;

  int degree = std::min(options.degree, kMaxDegree);
  const auto rows = static_cast<Eigen::Index>(samples.size());
  const auto enough = [&](int d) {
    return static_cast<double>(rows) >= options.samples_per_unknown * term_count(d);
  };
  while (degree > 1 && !enough(degree)) --degree;
  if (degree < 2) return;

  Matrix a(rows, term_count(degree));
  Heights heights(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Vec3 d = samples[i].point - origin;
    const double facing = std::max(0.0, samples[i].normal.dot(normal_));
    const double weight = facing / std::pow(d.squaredNorm() / mean2 + 0.01, 0.25 * degree);
    fill_terms(d.dot(t1_), d.dot(t2_), degree, a.row(i));
    a.row(i) *= weight;
    heights[i] = weight * d.dot(normal_);
  }
  degree_ = solve(a, heights, degree, options.independence, coefficients_);
}

Vec3 HeightFit::lift(const Vec3& point) const {
  if (degree_ == 0) return point;
  const Vec3 d = point - origin_;
  const double height = d.dot(normal_);
  std::array<double, kMaxTerms> terms;
  fill_terms(d.dot(t1_), d.dot(t2_), degree_, terms);
  double f = 0;
  for (int k = 0; k < term_count(degree_); ++k) f += coefficients_[k] * terms[k];
  return point + (f - height) * normal_;
}

Vec3 HeightFit::normal(const Vec3& point) const {
  if (degree_ == 0) return normal_;
  const Vec3 d = point - origin_;
  const double u = d.dot(t1_), v = d.dot(t2_);
  // The terms of degree d - 1 are those that the terms of degree d have as derivatives.
  std::array<double, kMaxTerms> terms;
  fill_terms(u, v, degree_, terms);
  double fu = coefficients_[0], fv = coefficients_[1];
  int lower = 0;
  for (int degree = 2, at = 2; degree <= degree_; ++degree) {
    for (int i = 0; i < degree; ++i) {
      fu += coefficients_[at + i] * (degree - i) * terms[lower + i];
      fv += coefficients_[at + i + 1] * (i + 1) * terms[lower + i];
    }
    lower = at;
    at += degree + 1;
  }
  return normal_ - fu * t1_ - fv * t2_;
}

}  // namespace isorelax
