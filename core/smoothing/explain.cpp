#include "smoothing/explain.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "energy/triangle_energy.h"
#include "mesh/angle.h"
#include "mesh/parallel.h"

namespace isorelax {
namespace {

std::array<Vec3, 3> corners_of(const SmoothingProblem& problem, std::span<const Vec3> x, Index t) {
  const Triangle& v = problem.triangles[t];
  return {x[v[0]], x[v[1]], x[v[2]]};
}

/// E^p of one triangle, by the plain formulas and not by those of the smoothers' loops.
double powered_energy(const SmoothingProblem& problem, const std::array<Vec3, 3>& x, Index t) {
  return std::pow(evaluate_energy(x, problem.reference[t], problem.weights).energy, problem.exponent);
}

TriangleShare share_of(const SmoothingProblem& problem, std::span<const Vec3> x, Corner corner) {
  const Index t = corner / 3;
  const auto points = corners_of(problem, x, t);
  const ReferenceTriangle reference = problem.reference[t];
  const double energy = evaluate_energy(points, reference, problem.weights).energy;
  const double factor = problem.exponent * std::pow(energy, problem.exponent - 1);
  const EnergyWeights& w = problem.weights;
  return {t, factor * energy_gradient(points, reference, {w.shape, 0})[corner % 3],
          factor * energy_gradient(points, reference, {0, w.area})[corner % 3]};
}

/// Gradient by central differences of the energy of the treated triangles around a vertex.
Vec3 difference_quotient(const SmoothingProblem& problem, std::span<const Vec3> x, Index vertex) {
  Vec3 quotient = Vec3::Zero();
  for (const Corner c : problem.topology.corners_of(vertex)) {
    if (problem.treated[c / 3] == 0) continue;
    const auto points = corners_of(problem, x, c / 3);
    // Small beside the triangle, which may be a sliver.
    const Vec3 side = points[next(c % 3)] - points[previous(c % 3)];
    const double height = (points[c % 3] - points[next(c % 3)]).cross(side).norm() / side.norm();
    const double h = 1e-5 * std::min(height, side.norm());
    for (int k = 0; k < 3; ++k) {
      auto there = points;
      there[c % 3][k] += h;
      const double ahead = powered_energy(problem, there, c / 3);
      there[c % 3][k] = points[c % 3][k] - h;
      quotient[k] += (ahead - powered_energy(problem, there, c / 3)) / (2 * h);
    }
  }
  return quotient;
}

double relative_error(const Vec3& found, const Vec3& recorded, double scale) {
  const double size = std::max({found.norm(), recorded.norm(), scale});
  return size > 0 ? (found - recorded).norm() / size : 0;
}

std::vector<Vec3> tangent_basis(unsigned dimensions, const Vec3& axis) {
  if (dimensions == 1) return {axis};
  if (dimensions == 0) return {};
  const Vec3 first = axis.unitOrthogonal();
  return {first, axis.cross(first)};
}

void explain_class(const SmoothingProblem& problem, const FeatureOptions& features, VertexExplanation& e) {
  const VertexClasses& found = problem.classes;
  const Index v = e.vertex;
  e.tangent_class = found.classes[v];
  e.eigenvalues = found.eigenvalues[v];
  e.spread = {found.spread_deg[v], features.ridge_angle_deg};
  e.angle_defect = {found.angle_defect_deg[v], features.corner_defect_deg};
  e.sharpest_edge = {found.sharpest_edge_deg[v], features.sharp_edge_deg};
  e.turn = {found.turn_deg[v],
            problem.topology.is_boundary(v) ? features.boundary_turn_deg : features.turn_deg};
  e.margin_deg = found.margin_deg[v];
}

/// Returns what errors are measured by beside the gradient itself.
double explain_shares(const SmoothingProblem& problem, std::span<const Vec3> before, VertexExplanation& e) {
  Vec3 sum = Vec3::Zero();
  double scale = 0;  // what cancels in the sums bounds what rounding leaves of them
  for (const Corner c : problem.topology.corners_of(e.vertex)) {
    if (problem.treated[c / 3] == 0) continue;
    e.shares.push_back(share_of(problem, before, c));
    sum += e.shares.back().shape + e.shares.back().area;
    const auto x = corners_of(problem, before, c / 3);
    const double side = std::max((x[1] - x[0]).norm(), (x[2] - x[0]).norm());
    scale = std::max(scale, problem.exponent * powered_energy(problem, x, c / 3) / side);
  }
  e.share_error = relative_error(sum, e.gradient, scale);
  return scale;
}

void explain_gradient(const SmoothingProblem& problem, std::span<const Vec3> before, VertexExplanation& e) {
  const double scale = explain_shares(problem, before, e);
  e.quotient = difference_quotient(problem, before, e.vertex);
  e.quotient_error = relative_error(e.quotient, e.gradient, scale);
}

/// A triangle in the plane with these cotangents of its angles and this doubled area.
FlatTriangle lay_out(const ReferenceTriangle& r) {
  // The side between corners 0 and 1 has length c, the height over it h: d1 = c h and c = h (cot0 + cot1).
  const double h = std::sqrt(r.d1 / (r.cot[0] + r.cot[1]));
  return {{{0, 0}, {h * (r.cot[0] + r.cot[1]), 0}, {h * r.cot[0], h}}};
}

TriangleMoment state_of(const SmoothingProblem& problem, const std::array<Vec3, 3>& x, Index t) {
  const ReferenceTriangle reference = problem.reference[t];
  TriangleMoment state;
  const Vec3 side = x[1] - x[0], other = x[2] - x[0];
  if (const double length = side.norm(); length > 0)
    state.outline = {{{0, 0}, {length, 0}, {other.dot(side) / length, other.cross(side).norm() / length}}};
  state.metrics = measure_triangle(x[0], x[1], x[2]);
  if (state.metrics.area > 0) {
    const TriangleEnergy energy = evaluate_energy(x, reference, problem.weights);
    state.shape = energy.shape;
    state.area = energy.area;
    state.energy = energy.energy;
  } else {
    state.shape = state.area = state.energy = std::numeric_limits<double>::infinity();
  }
  for (unsigned k = 0; k < 3; ++k) {
    const Vec3 a = x[next(k)] - x[k];
    const Vec3 b = x[previous(k)] - x[k];
    state.angles_deg[k] = angle_between_deg(a, b);
  }
  // K = kappa + 1 / kappa with kappa the ratio of the two, and their product is D2 / D1.
  const double kappa = 0.5 * (state.shape + std::sqrt(std::max(0.0, state.shape * state.shape - 4)));
  const double determinant = 2 * state.metrics.area / reference.d1;
  state.singular_values = {std::sqrt(determinant * kappa), std::sqrt(determinant / kappa)};
  return state;
}

/// The triangle with the corners x before and y after.
TriangleExplanation between(const SmoothingProblem& problem, const std::array<Vec3, 3>& x,
                            const std::array<Vec3, 3>& y, Index t) {
  TriangleExplanation e;
  e.triangle = t;
  e.treated = problem.treated[t] != 0;
  e.before = state_of(problem, x, t);
  e.after = state_of(problem, y, t);
  for (unsigned k = 0; k < 3; ++k) e.corners[k] = {problem.triangles[t][k], y[k] - x[k]};
  const ReferenceTriangle reference = problem.reference[t];
  e.reference_area = 0.5 * reference.d1;
  e.reference = lay_out(reference);
  return e;
}

}  // namespace

VertexExplanation explain_vertex(const SmoothingProblem& problem, const FeatureOptions& features,
                                 std::span<const Vec3> before, const StepRecord& record, Index vertex) {
  VertexExplanation e;
  e.vertex = vertex;
  e.before = before[vertex];
  e.gradient = record.gradient[vertex];
  e.displacement = record.displacement[vertex];
  e.alpha = record.alpha[vertex];
  e.limits = record.limits[vertex];
  e.after = e.before + e.alpha * e.displacement;
  explain_class(problem, features, e);
  explain_gradient(problem, before, e);
  if (!record.detail) return e;
  e.dimensions = record.detail->dimensions[vertex];
  e.basis = tangent_basis(e.dimensions, record.detail->axis[vertex]);
  e.tangent = record.detail->tangent[vertex];
  e.proposed = record.detail->proposed[vertex];
  e.set_by = triangle_that_cut(record, vertex);
  return e;
}

GradientCheck check_gradients(const SmoothingProblem& problem, std::span<const Vec3> before,
                              const StepRecord& record) {
  std::vector<GradientCheck> blocks(block_count(problem.vertex_count()));
  parallel_for_blocks(problem.vertex_count(), problem.threads, [&](std::size_t begin, std::size_t end) {
    GradientCheck& found = blocks[begin / kBlockSize];
    for (std::size_t v = begin; v < end; ++v) {
      VertexExplanation e;
      e.vertex = static_cast<Index>(v);
      e.gradient = record.gradient[v];
      explain_shares(problem, before, e);
      if (!(e.share_error >= kShareErrorLimit)) continue;
      ++found.wrong;
      if (e.share_error > found.largest) found.worst = e.vertex, found.largest = e.share_error;
    }
  });
  GradientCheck all;
  for (const GradientCheck& block : blocks) {
    all.wrong += block.wrong;
    if (block.largest > all.largest) all.worst = block.worst, all.largest = block.largest;
  }
  return all;
}

TriangleExplanation explain_triangle(const SmoothingProblem& problem, std::span<const Vec3> before,
                                     const StepRecord& record, Index triangle) {
  const auto x = corners_of(problem, before, triangle);
  auto y = x;
  for (unsigned k = 0; k < 3; ++k) {
    const Index v = problem.triangles[triangle][k];
    y[k] += record.alpha[v] * record.displacement[v];
  }
  TriangleExplanation e = between(problem, x, y, triangle);
  e.before.shape = record.shape[triangle];
  e.before.area = record.area[triangle];
  e.before.energy = record.energy[triangle];
  for (CornerMove& corner : e.corners) {
    corner.move = record.alpha[corner.vertex] * record.displacement[corner.vertex];
    corner.alpha = record.alpha[corner.vertex];
    corner.limits = record.limits[corner.vertex];
  }
  return e;
}

TriangleExplanation compare_triangle(const SmoothingProblem& problem, std::span<const Vec3> before,
                                     std::span<const Vec3> after, Index triangle) {
  return between(problem, corners_of(problem, before, triangle), corners_of(problem, after, triangle),
                 triangle);
}

}  // namespace isorelax
