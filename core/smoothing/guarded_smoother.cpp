#include "smoothing/guarded_smoother.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/parallel.h"

namespace isorelax {
namespace {

/// Rounds in which only vertices whose own surroundings got worse are cut back, then rounds that cut all.
constexpr unsigned kLocalGuardRounds = 6;
constexpr unsigned kGlobalGuardRounds = 40;

/// A move below this share of the mean edge length is not worth making.
constexpr double kConvergedMove = 1e-12;

}  // namespace

GuardedSmoother::GuardedSmoother(const SmoothingProblem& problem, RecordDetail detail)
    : problem_(problem), detail_(detail), here_(problem), there_(problem), trial_(problem), fold_(problem) {}

double GuardedSmoother::smallest_move() const {
  return kConvergedMove * problem_.mean_edge_length;
}

void GuardedSmoother::step(std::span<const Vec3> positions, StepRecord& record) {
  prepare(record);
  // A run asks for the positions that the guard of the step before evaluated: those sums are still at hand.
  if (there_.is_at(positions)) {
    std::swap(here_, there_);
  } else if (!here_.is_at(positions)) {
    here_.evaluate(positions);
    here_.mark(positions);
  }
  record.before = here_.totals();
  if (detail_ == RecordDetail::vertices_and_triangles) record_triangles(record);
  record.before.gradient_norm = propose(positions, here_, record);
  trial_.start(positions, record);
  fold_.limit(trial_, record);
  guard_energy(record);
  there_.mark(trial_.to());
  finish(record);
}

void GuardedSmoother::prepare(StepRecord& record) const {
  const std::size_t n = problem_.vertex_count();
  record.gradient.resize(n);
  record.displacement.resize(n);
  record.alpha.assign(n, 1);
  record.limits = problem_.fixed_limits;
  record.tangent_class = problem_.classes.classes;
  record.fold_passes = record.energy_passes = 0;
}

void GuardedSmoother::record_triangles(StepRecord& record) const {
  record.shape.assign(here_.shape().begin(), here_.shape().end());
  record.area.assign(here_.area().begin(), here_.area().end());
  record.energy.resize(problem_.triangle_count());
  for (Index t = 0; t < problem_.triangle_count(); ++t) record.energy[t] = here_.energy(t);
}

/// Accepts the step only if the energy does not rise: first cuts back the vertices around which it rose,
/// then all.
void GuardedSmoother::guard_energy(StepRecord& record) {
  record.after = there_.evaluate(trial_.to());
  for (unsigned round = 0; !(record.after.energy <= record.before.energy); ++round) {
    ++record.energy_passes;
    if (round < kLocalGuardRounds && !cuts_all_alike()) {
      for (const Index v : vertices_where_energy_rose()) trial_.cut(record, v, 0.5, kLimitEnergy);
    } else {
      const bool give_up = round >= kLocalGuardRounds + kGlobalGuardRounds;
      for (Index v = 0; v < problem_.vertex_count(); ++v)
        trial_.cut(record, v, give_up ? 0.0 : 0.5, kLimitEnergy);
    }
    std::vector<Index> changed = trial_.take_touched();
    const std::vector<Index> unfolded = fold_.limit(trial_, record, changed);
    changed.insert(changed.end(), unfolded.begin(), unfolded.end());
    record.after = there_.update(trial_.to(), changed);
  }
}

/// Vertices whose own triangles together got worse from here to there.
std::vector<Index> GuardedSmoother::vertices_where_energy_rose() const {
  const auto before = here_.powered();
  const auto after = there_.powered();
  std::vector<std::uint8_t> rose(problem_.vertex_count(), 0);
  parallel_for_blocks(problem_.vertex_count(), problem_.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      double change = 0;
      for (const Corner c : problem_.topology.corners_of(static_cast<Index>(v))) {
        change += after[c / 3] - before[c / 3];
      }
      rose[v] = change <= 0 ? 0 : 1;
    }
  });
  std::vector<Index> vertices;
  for (Index v = 0; v < problem_.vertex_count(); ++v) {
    if (rose[v] != 0) vertices.push_back(v);
  }
  return vertices;
}

void GuardedSmoother::finish(StepRecord& record) const {
  double largest = 0;
  record.moved = 0;
  for (Index v = 0; v < problem_.vertex_count(); ++v) {
    const double squared = record.alpha[v] * record.alpha[v] * record.displacement[v].squaredNorm();
    largest = std::max(largest, squared);
    record.moved += squared > 0 ? 1 : 0;
  }
  record.largest_move = std::sqrt(largest);
}

}  // namespace isorelax
