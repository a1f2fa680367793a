#include "smoothing/guarded_smoother.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/parallel.h"
#include "smoothing/step_detail.h"

namespace isorelax {
namespace {

/// Rounds of the energy guard. A direction for all is first shortened as a whole, unless it leads uphill;
/// then only vertices around which the energy rose are cut back; then the vertices of every triangle that got
/// worse; at last those are stopped.
constexpr unsigned kAlikeRounds = 4;
constexpr unsigned kLocalRounds = 6;
constexpr unsigned kTriangleRounds = 4;
/// How much of a direction for all a round leaves.
constexpr double kLeastWay = 0.1;
constexpr double kLongestWay = 0.5;

/// A move below this share of the mean edge length is not worth making.
constexpr double kConvergedMove = 1e-12;

}  // namespace

GuardedSmoother::GuardedSmoother(const SmoothingProblem& problem, StepKind kind, RecordDetail detail,
                                 StepGuard guard)
    : problem_(problem),
      kind_(kind),
      detail_(detail),
      guard_(guard),
      here_(problem),
      there_(problem),
      trial_(problem),
      fold_(problem) {}

void GuardedSmoother::set_move(StepRecord& record, Index vertex, const Vec3& move) const {
  record.displacement[vertex] = move;
  if (!move.allFinite()) {  // it leads nowhere that has an energy
    record.displacement[vertex].setZero();
    record.limits[vertex] |= kLimitEnergy;
    return;
  }
  const double small = kConvergedMove * problem_.mean_edge_length;
  if (problem_.mobility[vertex] == Mobility::none || move.squaredNorm() > small * small) return;
  record.displacement[vertex].setZero();
  record.limits[vertex] |= kLimitConverged;
}

void GuardedSmoother::step(std::span<const Vec3> positions, StepRecord& record) {
  prepare(record);
  // A run asks for the positions that the guard of the step before evaluated: those sums are still at hand.
  continues_ = there_.is_at(positions);
  if (continues_) {
    std::swap(here_, there_);
  } else if (!here_.is_at(positions)) {
    here_.evaluate(positions);
    here_.mark(positions);
  }
  record.before = here_.totals();
  if (detail_ != RecordDetail::vertices) record_triangles(here_, record);
  record.before.gradient_norm = propose(positions, here_, record);
  if (detail_ == RecordDetail::stages) record_stages(problem_, here_, positions, record);
  trial_.start(positions, record, leads_to_the_surface());
  if (guard_ != StepGuard::none) fold_.limit(trial_, record, go_together());
  record.after = there_.evaluate(trial_.to());
  if (guard_ == StepGuard::folds_and_energy || guard_ == StepGuard::all_or_nothing) guard_energy(record);
  there_.mark(trial_.to());
  last_energy_rounds_ = record.energy_passes;
  last_folded_ = static_cast<std::size_t>(
      std::ranges::count_if(record.limits, [](std::uint16_t limits) { return (limits & kLimitFold) != 0; }));
  finish(record);
}

void GuardedSmoother::prepare(StepRecord& record) const {
  const std::size_t n = problem_.vertex_count();
  record.gradient.resize(n);
  record.displacement.resize(n);
  record.alpha.assign(n, 1);
  record.limits = problem_.fixed_limits;
  record.tangent_class = problem_.classes.classes;
  record.kind = kind_;
  record.fold_passes = record.energy_passes = 0;
  record.detail.reset();
}

/// Accepts the step only if the energy does not rise. Ends: a total that rose has a triangle that got worse,
/// and one of its vertices moves.
void GuardedSmoother::guard_energy(StepRecord& record) {
  const unsigned local = cuts_all_alike() ? kAlikeRounds : 0;
  for (unsigned round = 0; !(record.after.movable_energy <= record.before.movable_energy); ++round) {
    const double way = round < local ? way_downhill(record) : 0;
    if (way == 0) round = std::max(round, local);
    ++record.energy_passes;
    begin_pass(record, kLimitEnergy);
    const auto cut = [&](Index v, double factor) {
      if (trial_.cut(record, v, factor, kLimitEnergy)) note_cut(record, v, kNone);
    };
    if (guard_ == StepGuard::all_or_nothing) {
      for (Index v = 0; v < problem_.vertex_count(); ++v) cut(v, 0);
    } else if (round < local) {
      for (Index v = 0; v < problem_.vertex_count(); ++v) cut(v, way);
    } else if (round < local + kLocalRounds) {
      for (const Index v : vertices_where_energy_rose()) cut(v, 0.5);
    } else {
      const double factor = round < local + kLocalRounds + kTriangleRounds ? 0.25 : 0.0;
      for (const Index v : vertices_of_worse_triangles()) cut(v, factor);
    }
    std::vector<Index> changed = trial_.take_touched();
    const std::vector<Index> unfolded = fold_.limit(trial_, record, changed);
    changed.insert(changed.end(), unfolded.begin(), unfolded.end());
    record.after = there_.update(trial_.to(), changed);
  }
}

/// The share of the accepted moves after which the energy is least, were it a parabola along them; 0 where it
/// rises from the start, as it may where some of them were held back.
double GuardedSmoother::way_downhill(const StepRecord& record) const {
  double slope = 0;
  for (Index v = 0; v < problem_.vertex_count(); ++v)
    slope += record.alpha[v] * record.gradient[v].dot(record.displacement[v]);
  if (!(slope < 0)) return 0;
  const double rise = record.after.movable_energy - record.before.movable_energy;
  const double least = 0.5 * slope / (slope - rise);
  return least > kLeastWay ? std::min(least, kLongestWay) : kLeastWay;
}

std::vector<Index> GuardedSmoother::vertices_of_worse_triangles() const {
  std::vector<Index> vertices;
  for (Index t = 0; t < problem_.triangle_count(); ++t) {
    if (there_.powered()[t] <= here_.powered()[t]) continue;
    vertices.insert(vertices.end(), problem_.triangles[t].begin(), problem_.triangles[t].end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
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
