#include "smoothing/newton_block.h"

#include <algorithm>
#include <cmath>

namespace isorelax {
namespace {

/// Share of the area term's convex part that its second derivative never falls below: keeps a block solvable
/// where the triangles are so large that the term is concave.
constexpr double kLeastAreaCurvature = 0.05;

/// E over its weights, 2 for the best triangle, from which a triangle counts as a sliver.
constexpr double kSliverEnergy = 3;

struct Powers {
  double first, second;  // derivatives of E^p with respect to E
};
Powers derivatives(double energy, double p) {
  if (p == 1) return {1, 0};
  if (p == 2) return {2 * energy, 2};
  const double below = std::pow(energy, p - 2);
  return {p * below * energy, p * (p - 1) * below};
}

}  // namespace

NewtonBlock::NewtonBlock(const SmoothingProblem& problem, const Objective& here,
                         std::span<const Vec3> positions, Index vertex, const Vec3& axis) {
  if (problem.mobility[vertex] == Mobility::none) return;
  if (problem.mobility[vertex] == Mobility::line) {
    t1_ = axis;
  } else {
    t1_ = axis.unitOrthogonal();
    t2_ = axis.cross(t1_);
  }
  for (const Corner c : problem.topology.corners_of(vertex)) {
    if (problem.treated[c / 3] != 0) add(problem, here, positions, c);
  }
}

void NewtonBlock::add(const SmoothingProblem& problem, const Objective& here, std::span<const Vec3> positions,
                      Corner corner) {
  const Index t = corner / 3;
  const unsigned i = corner % 3;
  const Triangle& v = problem.triangles[t];
  const Vec3& x = positions[v[i]];
  const Vec3& a = positions[v[next(i)]];
  const Vec3& b = positions[v[previous(i)]];
  const ReferenceTriangle reference = problem.reference[t];
  const EnergyWeights w = problem.weights;

  const Vec3 area = (a - x).cross(b - x);
  const double d2 = area.norm();
  const double inverse = 1 / d2;
  const Vec3 normal = area * inverse;
  const Vec3 u = normal.cross(b - a);  // dD2 / dx_i
  const Vec3 q = 2 * (reference.cot[next(i)] * (x - b) - reference.cot[previous(i)] * (a - x));
  const double root = std::sqrt(d2 / reference.d1);
  const double shape = here.shape()[t];
  const double convex = 0.75 / root;  // of S'' D2^2 = (3/4) / root - root / 4
  const double area_curvature = std::max(convex - 0.25 * root, kLeastAreaCurvature * convex);

  const Powers p = derivatives(here.energy(t), problem.exponent);
  const double plane =
      p.first * w.shape * 2 * (reference.cot[next(i)] + reference.cot[previous(i)]) * inverse;
  const double mixed = -p.first * w.shape * inverse * inverse;
  const double along = p.first * inverse * inverse * (2 * w.shape * shape + w.area * area_curvature);
  const double tangent = inverse * (0.5 * w.area * (root - 1 / root) - w.shape * shape);
  const Vec3 g = w.shape * inverse * q + tangent * u;

  const double u1 = u.dot(t1_), u2 = u.dot(t2_);
  const double q1 = q.dot(t1_), q2 = q.dot(t2_);
  const double n1 = normal.dot(t1_), n2 = normal.dot(t2_);
  const double g1 = g.dot(t1_), g2 = g.dot(t2_);
  // E^p grows like height^-p towards a sliver, and Newton's step on that is short. Without the g g^T part it
  // opens slivers half as fast again; near the minimum, where the part damps, it is kept.
  const double excess = here.energy(t) / (kSliverEnergy * (w.shape + w.area));
  const double squared = p.second / (1 + excess * excess);
  h11_ += plane * (1 - n1 * n1) + 2 * mixed * q1 * u1 + along * u1 * u1 + squared * g1 * g1;
  h12_ += -plane * n1 * n2 + mixed * (q1 * u2 + q2 * u1) + along * u1 * u2 + squared * g1 * g2;
  h22_ += plane * (1 - n2 * n2) + 2 * mixed * q2 * u2 + along * u2 * u2 + squared * g2 * g2;
}

Vec3 NewtonBlock::solve(const Vec3& g) const {
  const double g1 = g.dot(t1_);
  if (t2_.isZero(0)) return h11_ > 0 ? Vec3(g1 / h11_ * t1_) : Vec3::Zero();
  // A small multiple of the identity keeps nearly singular blocks (areas only) from sending a vertex far
  // away.
  const double shift = 1e-3 * (h11_ + h22_);
  const double a = h11_ + shift;
  const double c = h22_ + shift;
  const double determinant = a * c - h12_ * h12_;
  if (!(determinant > 0)) return h11_ + h22_ > 0 ? Vec3(g / (h11_ + h22_)) : Vec3::Zero();
  const double g2 = g.dot(t2_);
  return ((c * g1 - h12_ * g2) * t1_ + (a * g2 - h12_ * g1) * t2_) / determinant;
}

}  // namespace isorelax
