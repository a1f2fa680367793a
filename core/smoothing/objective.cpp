#include "smoothing/objective.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "mesh/parallel.h"

namespace isorelax {
namespace {

/// E^p and its derivative with respect to E.
struct Power {
  double value, derivative;
};
Power power(double energy, double exponent) {
  if (exponent == 1) return {energy, 1};
  if (exponent == 2) return {energy * energy, 2 * energy};
  const double below = std::pow(energy, exponent - 1);
  return {below * energy, exponent * below};
}

}  // namespace

/// Everything about one triangle at one set of positions.
struct Objective::Terms {
  Vec3 normal;  // N, length D2
  double d2;
  double shape, area, energy, s, t;
};

Objective::Objective(const SmoothingProblem& problem) : problem_(&problem) {
  states_.resize(problem.triangle_count());
  partials_.resize(block_count(problem.triangle_count()));
}

template <bool kEquilateral>
Objective::Terms Objective::terms(std::span<const Vec3> positions, Index t) const {
  const Triangle& v = problem_->triangles[t];
  const Vec3& a = positions[v[0]];
  const Vec3 e1 = positions[v[1]] - a;
  const Vec3 e2 = positions[v[2]] - a;
  const Vec3 e0 = e2 - e1;
  Terms r;
  r.normal = e1.cross(e2);
  r.d2 = std::sqrt(r.normal.squaredNorm());
  if constexpr (kEquilateral) {
    const double squares = e0.squaredNorm() + e1.squaredNorm() + e2.squaredNorm();
    const EquilateralEnergy e =
        equilateral_energy(squares, r.d2, 1 / problem_->reference.d1(t), problem_->weights);
    r.shape = e.shape, r.area = e.area, r.energy = e.energy, r.s = e.s, r.t = e.t;
  } else {
    const TriangleEnergy e = triangle_energy({e0.squaredNorm(), e2.squaredNorm(), e1.squaredNorm()}, r.d2,
                                             problem_->reference[t], problem_->weights);
    r.shape = e.shape, r.area = e.area, r.energy = e.energy, r.t = e.t;
    r.s = 2 * problem_->weights.shape / r.d2;  // times cot(alpha_k) at each corner
  }
  return r;
}

template <bool kEquilateral>
void Objective::evaluate_block(std::span<const Vec3> positions, std::size_t begin, std::size_t end,
                               StepTotals& partial) {
  partial = {};
  for (std::size_t i = begin; i < end; ++i) {
    const Index t = static_cast<Index>(i);
    if (problem_->treated[t] == 0) {
      states_[t] = {};
      continue;
    }
    const Terms r = terms<kEquilateral>(positions, t);
    const Power p = power(r.energy, problem_->exponent);
    partial.energy += p.value;
    partial.shape += r.shape;
    partial.area += r.area;
    partial.worst_energy = std::max(partial.worst_energy, r.energy);
    const double root = std::sqrt(r.d2);
    const double scale = 1 / root;
    states_[t] = {r.normal.x() * scale, r.normal.y() * scale, r.normal.z() * scale, p.derivative * r.s,
                  p.derivative * r.t * scale};
  }
}

StepTotals Objective::evaluate(std::span<const Vec3> positions) {
  const bool equilateral = problem_->reference.is_equilateral();
  parallel_for_blocks(problem_->triangle_count(), problem_->threads, [&](std::size_t begin, std::size_t end) {
    StepTotals& partial = partials_[begin / kBlockSize];
    equilateral ? evaluate_block<true>(positions, begin, end, partial)
                : evaluate_block<false>(positions, begin, end, partial);
  });
  totals_ = {};
  for (const StepTotals& partial : partials_) {
    totals_.energy += partial.energy;
    totals_.shape += partial.shape;
    totals_.area += partial.area;
    totals_.worst_energy = std::max(totals_.worst_energy, partial.worst_energy);
  }
  at_.assign(positions.begin(), positions.end());
  return totals_;
}

bool Objective::is_at(std::span<const Vec3> positions) const {
  return at_.size() == positions.size() && !at_.empty() &&
         std::memcmp(at_.data(), positions.data(), positions.size_bytes()) == 0;
}

template <bool kEquilateral, bool kCovariance>
VertexSums Objective::gather_as(std::span<const Vec3> positions, Index vertex) const {
  VertexSums sums;
  const Vec3 x = positions[vertex];
  for (const Corner c : problem_->topology.corners_of(vertex)) {
    const Index t = c / 3;
    const unsigned i = c - 3 * t;
    const Triangle& v = problem_->triangles[t];
    const Vec3& a = positions[v[next(i)]];
    const Vec3& b = positions[v[previous(i)]];
    const TriangleState& state = states_[t];
    const Vec3 normal(state.mx, state.my, state.mz);
    const Vec3 opposite = b - a;  // l_i
    if constexpr (kEquilateral) {
      sums.gradient += state.s * (2 * x - a - b) + state.t * normal.cross(opposite);
      sums.stiffness += 2 * state.s;
    } else {
      const ReferenceTriangle reference = problem_->reference[t];
      const double s_next = state.s * reference.cot[next(i)];
      const double s_previous = state.s * reference.cot[previous(i)];
      sums.gradient += s_next * (x - b) - s_previous * (a - x) + state.t * normal.cross(opposite);
      sums.stiffness += s_next + s_previous;
    }
    if constexpr (kCovariance) sums.covariance.add_outer(state.mx, state.my, state.mz);
  }
  return sums;
}

VertexSums Objective::gather(std::span<const Vec3> positions, Index vertex) const {
  if (problem_->reference.is_equilateral()) {
    return problem_->plane_normal ? gather_as<true, false>(positions, vertex)
                                  : gather_as<true, true>(positions, vertex);
  }
  return problem_->plane_normal ? gather_as<false, false>(positions, vertex)
                                : gather_as<false, true>(positions, vertex);
}

void Objective::triangle_energies(std::span<const Vec3> positions, std::vector<double>& powered) const {
  powered.resize(problem_->triangle_count());
  parallel_for_blocks(powered.size(), problem_->threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Index t = static_cast<Index>(i);
      powered[t] = 0;
      if (problem_->treated[t] == 0) continue;
      const double energy = problem_->reference.is_equilateral() ? terms<true>(positions, t).energy
                                                                 : terms<false>(positions, t).energy;
      powered[t] = power(energy, problem_->exponent).value;
    }
  });
}

void Objective::record_triangles(std::span<const Vec3> positions, StepRecord& record) const {
  const std::size_t count = problem_->triangle_count();
  record.shape.resize(count);
  record.area.resize(count);
  record.energy.resize(count);
  parallel_for_blocks(count, problem_->threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Index t = static_cast<Index>(i);
      Terms r{};
      if (problem_->treated[t] != 0) {
        r = problem_->reference.is_equilateral() ? terms<true>(positions, t) : terms<false>(positions, t);
      }
      record.shape[t] = r.shape;
      record.area[t] = r.area;
      record.energy[t] = r.energy;
    }
  });
}

}  // namespace isorelax
