#include "smoothing/objective.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "mesh/parallel.h"

namespace isorelax {
namespace {

/// Everything that is kept about the triangles of one batch.
struct EnergyBatch {
  Lanes shape, area, powered;
  Lanes g0x, g0y, g0z, g1x, g1y, g1z;
  Lanes scale;           // 1 / sqrt(D2)
  Lanes s;               // 2 w_s / D2 times the derivative of E^p
  Lanes area_stiffness;  // what stands in for Eq. 9's denominator where there is no shape term
};

/// First half of the formulas of `triangle_energy`, for eight triangles at once: values, N in g0, and in `t`
/// the t of Eq. 6 over D2.
template <bool kEquilateral>
[[gnu::always_inline]] inline void values(const EdgeBatch& __restrict e, const ReferenceBatch& __restrict r,
                                          EnergyWeights w, EnergyBatch& __restrict out, Lanes& __restrict t) {
  // The convex part of S'' |l|^2, with the mean of the three edges (method Sec. 5: Eq. 9 itself is undefined
  // there).
  const double area_only = w.shape > 0 ? 0 : 0.25 * w.area;
  for (unsigned i = 0; i < kLanes; ++i) {
    const double ax = e.e1x.at[i], ay = e.e1y.at[i], az = e.e1z.at[i];
    const double bx = e.e2x.at[i], by = e.e2y.at[i], bz = e.e2z.at[i];
    const double cx = bx - ax, cy = by - ay, cz = bz - az;
    const double nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
    const double d2 = std::sqrt(nx * nx + ny * ny + nz * nz);
    const double inverse = 1 / d2;
    const double aa = ax * ax + ay * ay + az * az;
    const double bb = bx * bx + by * by + bz * bz;
    const double cc = cx * cx + cy * cy + cz * cz;
    const double weighted = kEquilateral ? kEquilateralCot * (aa + bb + cc)
                                         : r.cot0.at[i] * cc + r.cot1.at[i] * bb + r.cot2.at[i] * aa;
    const double shape = weighted * inverse;
    const double root = std::sqrt(d2 * r.inverse_d1.at[i]);
    const double inverse_root = 1 / root;
    out.scale.at[i] = std::sqrt(inverse);
    out.shape.at[i] = shape;
    out.area.at[i] = root + inverse_root;
    out.s.at[i] = 2 * w.shape * inverse;
    out.area_stiffness.at[i] = area_only * inverse_root * inverse * inverse * (aa + bb + cc);
    t.at[i] = inverse * inverse * (0.5 * w.area * (root - inverse_root) - w.shape * shape);
    out.g0x.at[i] = nx;
    out.g0y.at[i] = ny;
    out.g0z.at[i] = nz;
  }
}

/// E^(p - 1) for every lane; the derivative of E^p is p times that.
[[gnu::always_inline]] inline void power_below(double exponent, EnergyWeights w,
                                               const EnergyBatch& __restrict b, Lanes& __restrict below) {
  for (unsigned i = 0; i < kLanes; ++i) below.at[i] = w.shape * b.shape.at[i] + w.area * b.area.at[i];
  if (exponent == 2) return;
  for (double& power : below.at) power = exponent == 1 ? 1 : std::pow(power, exponent - 1);
}

/// Second half: E^p and the gradients of Eq. 6 at corners 0 and 1, times the derivative of E^p.
/// l_0 = c, l_1 = -b, l_2 = a;  g_i = s_{i+} l_{i+} - s_{i-} l_{i-} + t n x l_i.
template <bool kEquilateral>
[[gnu::always_inline]] inline void gradients(const EdgeBatch& __restrict e,
                                             const ReferenceBatch& __restrict r, EnergyWeights w,
                                             double exponent, const Lanes& __restrict t,
                                             const Lanes& __restrict below, EnergyBatch& __restrict out) {
  for (unsigned i = 0; i < kLanes; ++i) {
    out.powered.at[i] = below.at[i] * (w.shape * out.shape.at[i] + w.area * out.area.at[i]);
    const double factor = exponent * below.at[i];
    const double s = factor * out.s.at[i];
    const double tt = factor * t.at[i];
    const double nx = out.g0x.at[i], ny = out.g0y.at[i], nz = out.g0z.at[i];
    const double ax = e.e1x.at[i], ay = e.e1y.at[i], az = e.e1z.at[i];
    const double bx = e.e2x.at[i], by = e.e2y.at[i], bz = e.e2z.at[i];
    const double cx = bx - ax, cy = by - ay, cz = bz - az;
    const double s0 = s * (kEquilateral ? kEquilateralCot : r.cot0.at[i]);
    const double s1 = s * (kEquilateral ? kEquilateralCot : r.cot1.at[i]);
    const double s2 = s * (kEquilateral ? kEquilateralCot : r.cot2.at[i]);
    out.s.at[i] = s;
    out.area_stiffness.at[i] *= factor;
    out.g0x.at[i] = tt * (ny * cz - nz * cy) - s1 * bx - s2 * ax;
    out.g0y.at[i] = tt * (nz * cx - nx * cz) - s1 * by - s2 * ay;
    out.g0z.at[i] = tt * (nx * cy - ny * cx) - s1 * bz - s2 * az;
    out.g1x.at[i] = s2 * ax - s0 * cx - tt * (ny * bz - nz * by);
    out.g1y.at[i] = s2 * ay - s0 * cy - tt * (nz * bx - nx * bz);
    out.g1z.at[i] = s2 * az - s0 * cz - tt * (nx * by - ny * bx);
  }
}

ISORELAX_VECTOR_CLONES
void equilateral_batch(const EdgeBatch& e, const ReferenceBatch& r, EnergyWeights w, double exponent,
                       EnergyBatch& out) {
  Lanes t;
  Lanes below;
  values<true>(e, r, w, out, t);
  power_below(exponent, w, out, below);
  gradients<true>(e, r, w, exponent, t, below, out);
}

ISORELAX_VECTOR_CLONES
void general_batch(const EdgeBatch& e, const ReferenceBatch& r, EnergyWeights w, double exponent,
                   EnergyBatch& out) {
  Lanes t;
  Lanes below;
  values<false>(e, r, w, out, t);
  power_below(exponent, w, out, below);
  gradients<false>(e, r, w, exponent, t, below, out);
}

}  // namespace

Objective::Objective(const SmoothingProblem& problem)
    : problem_(&problem),
      states_(problem.triangle_count()),
      corner_stiffness_(problem.reference.is_equilateral() ? 0 : problem.triangle_count()),
      shape_(problem.triangle_count()),
      area_(problem.triangle_count()),
      powered_(problem.triangle_count()),
      movable_(movable_triangles(problem)),
      partials_(block_count(problem.triangle_count())) {
  if (problem.reference.is_uniform())
    uniform_ = ReferenceBatch::load(problem.reference, BatchIds::of_range(0, 1));
}

void Objective::evaluate_batch(std::span<const Vec3> positions, const BatchIds& ids) {
  EdgeBatch edges;
  const ReferenceBatch reference =
      problem_->reference.is_uniform() ? uniform_ : ReferenceBatch::load(problem_->reference, ids);
  EnergyBatch out;
  edges.load(positions, problem_->triangles, ids);
  problem_->reference.is_equilateral()
      ? equilateral_batch(edges, reference, problem_->weights, problem_->exponent, out)
      : general_batch(edges, reference, problem_->weights, problem_->exponent, out);
  for (unsigned i = 0; i < ids.count; ++i) {
    const Index t = ids.at[i];
    if (problem_->treated[t] == 0) continue;  // the arrays hold zeros there from the start
    shape_[t] = out.shape.at[i];
    area_[t] = out.area.at[i];
    powered_[t] = out.powered.at[i];
    states_[t] = {edges.e1x.at[i], edges.e1y.at[i],
                  edges.e1z.at[i], edges.e2x.at[i],
                  edges.e2y.at[i], edges.e2z.at[i],
                  out.g0x.at[i],   out.g0y.at[i],
                  out.g0z.at[i],   out.g1x.at[i],
                  out.g1y.at[i],   out.g1z.at[i],
                  out.scale.at[i], 2 * kEquilateralCot * out.s.at[i] + out.area_stiffness.at[i],
                  out.shape.at[i], out.powered.at[i]};
    if (corner_stiffness_.empty()) continue;
    const double s = out.s.at[i];
    const double k = out.area_stiffness.at[i];
    corner_stiffness_[t] = {s * (reference.cot1.at[i] + reference.cot2.at[i]) + k,
                            s * (reference.cot2.at[i] + reference.cot0.at[i]) + k,
                            s * (reference.cot0.at[i] + reference.cot1.at[i]) + k};
  }
}

void Objective::sum_block(std::size_t block) {
  const std::size_t end = std::min<std::size_t>(problem_->triangle_count(), (block + 1) * kBlockSize);
  StepTotals sum;
  double worst = 0, worst_movable = 0;
  for (std::size_t t = block * kBlockSize; t < end; ++t) {
    sum.energy += powered_[t];
    sum.shape += shape_[t];
    sum.area += area_[t];
    const double one = energy(static_cast<Index>(t));
    worst = std::max(worst, one);
    sum.movable_energy += movable_[t] != 0 ? powered_[t] : 0;
    worst_movable = std::max(worst_movable, movable_[t] != 0 ? one : 0);
  }
  sum.worst_energy = worst;
  sum.worst_movable_energy = worst_movable;
  partials_[block] = sum;
}

void Objective::sum_blocks() {
  totals_ = {};
  for (const StepTotals& partial : partials_) {
    totals_.energy += partial.energy;
    totals_.shape += partial.shape;
    totals_.area += partial.area;
    totals_.worst_energy = std::max(totals_.worst_energy, partial.worst_energy);
    totals_.movable_energy += partial.movable_energy;
    totals_.worst_movable_energy = std::max(totals_.worst_movable_energy, partial.worst_movable_energy);
  }
}

const StepTotals& Objective::evaluate(std::span<const Vec3> positions) {
  at_.clear();
  parallel_for_blocks(problem_->triangle_count(), problem_->threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += kLanes)
      evaluate_batch(positions, BatchIds::of_range(first, end));
    sum_block(begin / kBlockSize);
  });
  sum_blocks();
  return totals_;
}

const StepTotals& Objective::update(std::span<const Vec3> positions, std::span<const Index> triangles) {
  at_.clear();
  for (std::size_t first = 0; first < triangles.size(); first += kLanes) {
    evaluate_batch(positions, BatchIds::of_list(triangles, first));
  }
  std::vector<std::uint8_t> dirty(partials_.size(), 0);
  for (const Index t : triangles) dirty[t / kBlockSize] = 1;
  for (std::size_t block = 0; block < dirty.size(); ++block) {
    if (dirty[block] != 0) sum_block(block);
  }
  sum_blocks();
  return totals_;
}

bool Objective::is_at(std::span<const Vec3> positions) const {
  return at_.size() == positions.size() && !at_.empty() &&
         std::memcmp(at_.data(), positions.data(), positions.size_bytes()) == 0;
}

template <bool kEquilateral, bool kCovariance>
VertexSums Objective::gather_as(Index vertex) const {
  VertexSums sums;
  double gx = 0, gy = 0, gz = 0;
  for (const Corner c : problem_->topology.corners_of(vertex)) {
    const Index t = c / 3;
    const unsigned i = c - 3 * t;
    const TriangleState& state = states_[t];
    if (i == 0) {
      gx += state.g0x, gy += state.g0y, gz += state.g0z;
    } else if (i == 1) {
      gx += state.g1x, gy += state.g1y, gz += state.g1z;
    } else {
      gx -= state.g0x + state.g1x, gy -= state.g0y + state.g1y, gz -= state.g0z + state.g1z;
    }
    sums.stiffness += kEquilateral ? state.stiffness : corner_stiffness_[t][i];
    if constexpr (kCovariance) {
      const double nx = state.e1y * state.e2z - state.e1z * state.e2y;
      const double ny = state.e1z * state.e2x - state.e1x * state.e2z;
      const double nz = state.e1x * state.e2y - state.e1y * state.e2x;
      sums.covariance.add_outer(nx * state.scale, ny * state.scale, nz * state.scale);
    }
  }
  sums.gradient = {gx, gy, gz};
  return sums;
}

VertexSums Objective::gather(Index vertex) const {
  if (problem_->reference.is_equilateral()) {
    return problem_->plane_normal ? gather_as<true, false>(vertex) : gather_as<true, true>(vertex);
  }
  return problem_->plane_normal ? gather_as<false, false>(vertex) : gather_as<false, true>(vertex);
}

}  // namespace isorelax
