#include "smoothing/fold_control.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/parallel.h"
#include "smoothing/newly_crossing.h"

namespace isorelax {
namespace {

/// A triangle limits when it would fold before kReach times the way. It is then cut back to kSafety of the
/// way to the fold, clearly inside, so that rounding does not decide whether it limits again in the next
/// round.
constexpr double kReach = 1.25;
constexpr double kSafety = 0.6;
constexpr unsigned kMaxRounds = 12;
/// Times that moves that belong together are cut back alike.
constexpr unsigned kRoundsForAll = 6;
/// Rounds in which a vertex that leads away from the surface loses that part of its move instead of half of
/// it, and rounds after which it loses all.
constexpr unsigned kSlidingRounds = 2;
constexpr unsigned kNearRounds = 6;
/// Rounds after which what would cross something loses all of its move.
constexpr unsigned kApartRounds = 4;

/// c + b a + q a^2: signed area along the move, over the old normal.
struct AreaAlongMove {
  double c, b, q;
};

/// Whether the polynomial may have a root in (0, kReach]: false is certain, and the common case.
bool may_fold(const AreaAlongMove& p) {
  return !(p.c + std::min(p.b, 0.0) * kReach + std::min(p.q, 0.0) * (kReach * kReach) > 0);
}

/// First root in (0, infinity), c > 0; infinity if there is none.
double first_positive_root(const AreaAlongMove& p) {
  const double discriminant = p.b * p.b - 4 * p.q * p.c;
  if (discriminant < 0) return INFINITY;
  // 2 c / (-b + sqrt(D)) is the smaller positive root for q > 0 and the positive one for q < 0, without
  // cancellation where b < 0.
  const double denominator = -p.b + std::sqrt(discriminant);
  return denominator > 0 ? 2 * p.c / denominator : INFINITY;
}

double share(const AreaAlongMove& p) {
  if (!may_fold(p)) return 1;
  const double root = first_positive_root(p);
  return root < kReach ? kSafety * root : 1;
}

struct AreaBatch {
  Lanes c, b, q;
};

ISORELAX_VECTOR_CLONES
void area_along_move(const EdgeBatch& x, const EdgeBatch& y, AreaBatch& out) {
  for (unsigned i = 0; i < kLanes; ++i) {
    const double ax = x.e1x.at[i], ay = x.e1y.at[i], az = x.e1z.at[i];
    const double bx = x.e2x.at[i], by = x.e2y.at[i], bz = x.e2z.at[i];
    const double px = y.e1x.at[i] - ax, py = y.e1y.at[i] - ay, pz = y.e1z.at[i] - az;
    const double rx = y.e2x.at[i] - bx, ry = y.e2y.at[i] - by, rz = y.e2z.at[i] - bz;
    const double nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
    out.c.at[i] = nx * nx + ny * ny + nz * nz;
    out.b.at[i] = nx * (py * bz - pz * by + ay * rz - az * ry) +
                  ny * (pz * bx - px * bz + az * rx - ax * rz) + nz * (px * by - py * bx + ax * ry - ay * rx);
    out.q.at[i] = nx * (py * rz - pz * ry) + ny * (pz * rx - px * rz) + nz * (px * ry - py * rx);
  }
}

struct NormalBatch {
  Lanes x, y, z;

  void load(std::span<const Vec3> normals, const BatchIds& ids) {
    for (unsigned i = 0; i < kLanes; ++i) {
      const Vec3& n = normals[ids.at[i]];
      x.at[i] = n[0], y.at[i] = n[1], z.at[i] = n[2];
    }
  }
};

/// The cosine between area vectors and unit normals, with its sign, squared; not a number without area.
ISORELAX_VECTOR_CLONES
void signed_squared_cosines(const EdgeBatch& e, const NormalBatch& normals, Lanes& out) {
  for (unsigned i = 0; i < kLanes; ++i) {
    const double ax = e.e1x.at[i], ay = e.e1y.at[i], az = e.e1z.at[i];
    const double bx = e.e2x.at[i], by = e.e2y.at[i], bz = e.e2z.at[i];
    const double nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
    const double along = nx * normals.x.at[i] + ny * normals.y.at[i] + nz * normals.z.at[i];
    const double absolute = along < 0 ? -along : along;
    out.at[i] = along * absolute / (nx * nx + ny * ny + nz * nz);
  }
}

}  // namespace

double fold_free_share(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& y) {
  const Vec3 t1 = x[1] - x[0];
  const Vec3 t2 = x[2] - x[0];
  const Vec3 d1 = y[1] - y[0] - t1;
  const Vec3 d2 = y[2] - y[0] - t2;
  const Vec3 normal = t1.cross(t2);
  const AreaAlongMove p{normal.squaredNorm(), (d1.cross(t2) + t1.cross(d2)).dot(normal),
                        d1.cross(d2).dot(normal)};
  return share(p);
}

FoldControl::FoldControl(const SmoothingProblem& problem)
    : problem_(problem),
      turns_(problem),
      surface_(problem),
      has_turned_(turns_.applies() ? problem.triangle_count() : 0, 1),
      block_cuts_(block_count(problem.triangle_count())) {}

void FoldControl::check(const Trial& trial, const BatchIds& ids, bool all_are_checked,
                        std::vector<Cut>& cuts) {
  EdgeBatch x;
  EdgeBatch y;
  AreaBatch areas;
  AngleBatch angles;
  x.load(trial.from(), problem_.triangles, ids);
  y.load(trial.to(), problem_.triangles, ids);
  area_along_move(x, y, areas);
  measure_angles(y, angles);
  Lanes cosines;
  const bool may_turn = turns_.applies();
  if (may_turn) {
    NormalBatch normals;
    normals.load(problem_.initial_normals, ids);
    signed_squared_cosines(y, normals, cosines);
  }
  for (unsigned i = 0; i < ids.count; ++i) {
    const Index t = ids.at[i];
    const AreaAlongMove p{areas.c.at[i], areas.b.at[i], areas.q.at[i]};
    double limit = share(p);
    const bool too_sharp = !(angles.smallest_cot.at[i] <= problem_.worst_angles.smallest_cot) ||
                           !(angles.largest_cot.at[i] >= problem_.worst_angles.largest_cot);
    bool turned = may_turn && !(cosines.at[i] > TurnLimit::kLeastCosine * TurnLimit::kLeastCosine);
    if (problem_.treated[t] == 0) continue;
    if (may_turn) has_turned_[t] = turned ? 1 : 0;
    turned = turned && !lets_go(trial, t);
    if (may_turn && !turned && cosines.at[i] < TurnLimit::kLittleTurned2) turned = faces_away(trial.to(), t);
    const auto cut = [&](Index triangle, double share) {
      for (const Index v : problem_.triangles[triangle]) cuts.push_back({v, triangle, share});
    };
    if (too_sharp || turned) limit = std::min(limit, 0.5);
    if (limit < 1) cut(t, limit);
    if (may_turn && may_have_folds(t, cosines.at[i], all_are_checked))
      turns_.for_turned_back(trial.to(), t, [&](Index triangle) { cut(triangle, 0.5); });
  }
}

/// Where all triangles are checked, a fresh fold is found from one of the two at it; else a neighbour that
/// turns too far later in the same round finds what is between them.
bool FoldControl::may_have_folds(Index triangle, double cosine, bool all_are_checked) const {
  if (all_are_checked) return !(cosine > turns_.folding_cosine(triangle));
  if (!(cosine > turns_.unfolded_cosine(triangle))) return true;
  for (unsigned k = 0; k < 3; ++k) {
    const Corner across = problem_.topology.opposite(3 * triangle + k);
    if (across != kNone && has_turned_[across / 3] != 0) return true;
  }
  return false;
}

bool FoldControl::lets_go(const Trial& trial, Index triangle) const {
  const Triangle& t = problem_.triangles[triangle];
  const auto area = [&](std::span<const Vec3> x) { return area_vector(x[t[0]], x[t[1]], x[t[2]]); };
  return turns_.lets_go(triangle, area(trial.from()), area(trial.to()));
}

bool FoldControl::faces_away(std::span<const Vec3> x, Index triangle) const {
  const auto& [a, b, c] = problem_.triangles[triangle];
  return turns_.faces_away(triangle, {x[a], x[b], x[c]});
}

std::vector<FoldControl::Cut> FoldControl::check(const Trial& trial, std::span<const Index> triangles) {
  std::vector<Cut> cuts;
  for (std::size_t first = 0; first < triangles.size(); first += kLanes) {
    check(trial, BatchIds::of_list(triangles, first), false, cuts);
  }
  return cuts;
}

std::vector<FoldControl::Cut> FoldControl::check_all(const Trial& trial) {
  parallel_for_blocks(problem_.triangle_count(), problem_.threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Cut>& cuts = block_cuts_[begin / kBlockSize];
    cuts.clear();
    for (std::size_t first = begin; first < end; first += kLanes) {
      check(trial, BatchIds::of_range(first, end), true, cuts);
    }
  });
  std::vector<Cut> all;
  for (const auto& cuts : block_cuts_) all.insert(all.end(), cuts.begin(), cuts.end());
  return all;
}

void FoldControl::limit(Trial& trial, StepRecord& record, bool together) {
  const double many = kManyFolds * problem_.vertex_count();
  double alpha = 1;
  for (unsigned round = 0;; ++round) {
    const double most = together && round < kRoundsForAll ? many : INFINITY;
    if (shrink_few_until_free(trial, record, check_all(trial), most)) break;
    ++record.fold_passes;
    alpha *= kShorter;
    trial.cut_all(record, alpha, kLimitFold);
  }
  shrink_until_near(trial, record);
  if (problem_.apart) shrink_until_apart(trial, record, newly_crossing(problem_, trial.from(), trial.to()));
}

std::vector<Index> FoldControl::limit(Trial& trial, StepRecord& record, std::span<const Index> triangles) {
  std::vector<Index> changed = shrink_until_free(trial, record, check(trial, triangles));
  const std::vector<Index> nearer = shrink_until_near(trial, record);
  changed.insert(changed.end(), nearer.begin(), nearer.end());
  if (!problem_.apart) return changed;
  std::vector<Index> moved(triangles.begin(), triangles.end());
  moved.insert(moved.end(), changed.begin(), changed.end());
  const std::vector<Index> apart =
      shrink_until_apart(trial, record, newly_crossing(problem_, moved, trial.from(), trial.to()));
  changed.insert(changed.end(), apart.begin(), apart.end());
  return changed;
}

std::optional<std::vector<Index>> FoldControl::shrink_few_until_free(Trial& trial, StepRecord& record,
                                                                     std::vector<Cut> cuts, double most) {
  std::vector<Index> changed;
  std::vector<std::uint8_t> is_cut(std::isfinite(most) ? problem_.vertex_count() : 0, 0);
  double count = 0;
  for (unsigned round = 1; !cuts.empty(); ++round) {
    ++record.fold_passes;
    begin_pass(record, kLimitFold);
    // Every vertex takes the smallest share of its triangles, all found for the same moves.
    std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) {
      if (a.vertex != b.vertex) return a.vertex < b.vertex;
      return a.share != b.share ? a.share < b.share : a.triangle < b.triangle;
    });
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      if (i > 0 && cuts[i - 1].vertex == cuts[i].vertex) continue;
      if (!is_cut.empty()) count += std::exchange(is_cut[cuts[i].vertex], 1) == 0 ? 1 : 0;
      if (trial.cut(record, cuts[i].vertex, round >= kMaxRounds ? 0.0 : cuts[i].share, kLimitFold))
        note_cut(record, cuts[i].vertex, cuts[i].triangle);
    }
    if (count > most) return std::nullopt;
    const std::vector<Index> touched = trial.take_touched();
    changed.insert(changed.end(), touched.begin(), touched.end());
    cuts = check(trial, touched);
  }
  return changed;
}

std::vector<Index> FoldControl::shrink_until_free(Trial& trial, StepRecord& record, std::vector<Cut> cuts) {
  return *shrink_few_until_free(trial, record, std::move(cuts), INFINITY);
}

/// Cuts back the vertices of triangles that would be too far from the surface as it was, until none would.
std::vector<Index> FoldControl::shrink_until_near(Trial& trial, StepRecord& record) {
  std::vector<Index> changed;
  for (unsigned round = 1;; ++round) {
    const auto blame = round <= kNearRounds ? SurfaceLimit::Blame::movers : SurfaceLimit::Blame::all;
    const std::vector<SurfaceLimit::Excess> far = surface_.too_far(trial.to(), blame, trial.from());
    if (far.empty()) return changed;
    ++record.fold_passes;
    begin_pass(record, kLimitSurface);
    const double factor = round >= kNearRounds ? 0.0 : 0.5;
    Index last = kNone;  // vertex that was cut
    for (const auto& [v, outwards] : far) {
      if ((round <= kSlidingRounds && trial.slide(record, v, outwards)) || v == last) continue;
      last = v;
      if (trial.cut(record, v, factor, kLimitSurface)) note_cut(record, v, kNone);
    }
    const std::vector<Index> touched = trial.take_touched();
    if (touched.empty() && blame == SurfaceLimit::Blame::all) return changed;
    changed.insert(changed.end(), touched.begin(), touched.end());
    const std::vector<Index> unfolded = shrink_until_free(trial, record, check(trial, touched));
    changed.insert(changed.end(), unfolded.begin(), unfolded.end());
  }
}

/// Cuts back the vertices of triangles that would come to cross others, until none would.
std::vector<Index> FoldControl::shrink_until_apart(Trial& trial, StepRecord& record,
                                                   std::vector<Index> crossing) {
  std::vector<Index> changed;
  for (unsigned round = 1; !crossing.empty(); ++round) {
    ++record.fold_passes;
    begin_pass(record, kLimitFold);
    const double factor = round >= kApartRounds ? 0.0 : 0.5;
    std::vector<std::uint8_t> is_cut(problem_.vertex_count(), 0);
    for (const Index t : crossing)
      for (const Index v : problem_.triangles[t])
        if (std::exchange(is_cut[v], 1) == 0 && trial.cut(record, v, factor, kLimitFold))
          note_cut(record, v, t);
    std::vector<Index> touched = trial.take_touched();
    if (touched.empty()) break;
    for (const auto& more :
         {shrink_until_free(trial, record, check(trial, touched)), shrink_until_near(trial, record)})
      touched.insert(touched.end(), more.begin(), more.end());
    touched.insert(touched.end(), crossing.begin(), crossing.end());
    crossing = newly_crossing(problem_, touched, trial.from(), trial.to());
    changed.insert(changed.end(), touched.begin(), touched.end());
  }
  return changed;
}

}  // namespace isorelax
