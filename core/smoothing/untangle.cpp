#include "smoothing/untangle.h"

#include <algorithm>
#include <cmath>

#include "quality/inverted.h"
#include "smoothing/harmonic.h"
#include "smoothing/lift_moved.h"
#include "smoothing/minimise.h"
#include "smoothing/orientation_field.h"
#include "smoothing/regularised_energy.h"

namespace isorelax {
namespace {

/// A triangle counts as sound when its signed doubled area is over this share of its longest edge squared.
constexpr double kFlat = 1e-9;
/// Rounds of the regularisation, and steps in each.
constexpr int kRounds = 60;
constexpr unsigned kSteps = 60;
/// The worst determinant with which a round ends the search.
constexpr double kSoundDeterminant = 1e-4;
/// Least share by which a round lowers chi of the worst determinant.
constexpr double kLeastProgress = 0.1;

constexpr unsigned kPasses = 4;
/// So many rounds in turn that hardly lower the energy end the search.
constexpr int kIdleRounds = 4;
constexpr double kIdleProgress = 0.01;

class Untangler {
 public:
  Untangler(std::span<Vec3> positions, std::span<const Triangle> triangles, const Topology& topology,
            std::span<const std::uint8_t> movable, const OrientationField& field, unsigned threads)
      : start_(positions.begin(), positions.end()),
        best_(start_),
        triangles_(triangles),
        topology_(topology),
        movable_(movable),
        field_(field),
        threads_(threads),
        tangled_(find_tangled(best_)) {}

  void run() {
    if (tangled_.empty()) return;
    put_back_thrown();
    for (const unsigned rings : {0U, 0U, 1U, 2U}) place_among_neighbours(around_tangled(rings));
    for (const unsigned rings : {1U, 3U}) regularise(around_tangled(rings), Start::as_it_is);
    if (!field_.planar) return;
    regularise(around_tangled(8), Start::as_it_is);
    regularise(around_tangled(8), Start::harmonic);
    regularise(all_movable(), Start::harmonic);
    regularise(all_movable(), Start::as_it_is);
  }

  /// Brings what was moved back to the surface of what was not.
  void lift() {
    std::vector<std::uint8_t> moved(best_.size(), 0);
    for (Index v = 0; v < best_.size(); ++v) moved[v] = best_[v] == start_[v] ? 0 : 1;
    std::vector<Vec3> x = best_;
    lift_moved(x, triangles_, topology_, field_.vertex_normals, moved);
    std::vector<Index> tangled = find_tangled(x);
    if (tangled.size() > tangled_.size()) return;
    best_ = std::move(x);
    tangled_ = std::move(tangled);
  }

  [[nodiscard]] const std::vector<Vec3>& best() const { return best_; }

 private:
  enum class Start : std::uint8_t { as_it_is, harmonic };

  [[nodiscard]] bool is_tangled(std::span<const Vec3> x, Index t) const {
    const Triangle& v = triangles_[t];
    const double d2 = field_.normals[t].dot(area_vector(x[v[0]], x[v[1]], x[v[2]]));
    const double longest = std::max({(x[v[1]] - x[v[0]]).squaredNorm(), (x[v[2]] - x[v[1]]).squaredNorm(),
                                     (x[v[0]] - x[v[2]]).squaredNorm()});
    return !(d2 > kFlat * longest);
  }

  /// Triangles that the field judges, that can be changed and that are upside down or flat.
  [[nodiscard]] std::vector<Index> find_tangled(std::span<const Vec3> x) const {
    std::vector<Index> found;
    for (Index t = 0; t < triangles_.size(); ++t) {
      const Triangle& v = triangles_[t];
      if (field_.normals[t].isZero(0) || movable_[v[0]] + movable_[v[1]] + movable_[v[2]] == 0) continue;
      if (is_tangled(x, t)) found.push_back(t);
    }
    return found;
  }

  [[nodiscard]] std::vector<Index> all_movable() const {
    std::vector<Index> all;
    for (Index v = 0; v < movable_.size(); ++v)
      if (movable_[v] != 0) all.push_back(v);
    return all;
  }

  /// Vertices that most triangles about them say are out of place themselves, no two of them neighbours.
  [[nodiscard]] std::vector<Index> out_of_place() const {
    std::vector<unsigned> count(best_.size(), 0);
    for (const Index t : tangled_)
      for (const Index v : triangles_[t]) ++count[v];
    const auto share = [&](Index v) {
      return count[v] / static_cast<double>(topology_.corners_of(v).size());
    };
    std::vector<Index> ranked;
    for (Index v = 0; v < best_.size(); ++v)
      if (movable_[v] != 0 && count[v] >= 2) ranked.push_back(v);
    std::stable_sort(ranked.begin(), ranked.end(), [&](Index a, Index b) { return share(a) > share(b); });
    std::vector<std::uint8_t> taken(best_.size(), 0);
    std::vector<Index> found;
    for (const Index v : ranked) {
      if (taken[v] != 0) continue;
      found.push_back(v);
      for (const Corner c : topology_.corners_of(v))
        for (const Index w : triangles_[c / 3]) taken[w] = 1;
    }
    return found;
  }

  void put_back_thrown() {
    for (std::size_t before = tangled_.size() + 1; tangled_.size() < before;) {
      before = tangled_.size();
      place_among_neighbours(out_of_place());
    }
  }

  /// Movable vertices of the tangled triangles and of so many rings about them.
  [[nodiscard]] std::vector<Index> around_tangled(unsigned rings) const {
    std::vector<std::uint8_t> inside(best_.size(), 0);
    std::vector<Index> found, last;
    const auto take = [&](Index v, std::vector<Index>& to) {
      if (inside[v] != 0 || movable_[v] == 0) return;
      inside[v] = 1;
      to.push_back(v);
    };
    for (const Index t : tangled_)
      for (const Index v : triangles_[t]) take(v, last);
    for (unsigned ring = 0; ring < rings && !last.empty(); ++ring) {
      found.insert(found.end(), last.begin(), last.end());
      std::vector<Index> grown;
      for (const Index v : last)
        for (const Corner c : topology_.corners_of(v))
          for (const Index w : triangles_[c / 3]) take(w, grown);
      last.swap(grown);
    }
    found.insert(found.end(), last.begin(), last.end());
    std::sort(found.begin(), found.end());
    return found;
  }

  void place_among_neighbours(const std::vector<Index>& free) {
    if (tangled_.empty() || free.empty()) return;
    std::vector<Vec3> x = best_;
    if (place_harmonically(x, triangles_, topology_, free)) keep_if_better(x);
  }

  void regularise(const std::vector<Index>& free, Start start) {
    if (tangled_.empty() || free.empty()) return;
    std::vector<Vec3> x = best_;
    if (start == Start::harmonic && !place_harmonically(x, triangles_, topology_, free)) return;
    minimise_regularised(x, free);
    keep_if_better(x);
  }

  void keep_if_better(const std::vector<Vec3>& x) {
    std::vector<Index> tangled = find_tangled(x);
    if (tangled.size() >= tangled_.size()) return;
    best_ = x;
    tangled_ = std::move(tangled);
  }

  void minimise_regularised(std::vector<Vec3>& x, const std::vector<Index>& free) const {
    RegularisedEnergy energy(x, triangles_, topology_, field_.normals, free, typical_area(x, free), threads_);
    const DifferentiableFunction function = [&](const Eigen::VectorXd& at, Eigen::VectorXd& gradient) {
      return energy(at, gradient);
    };
    Eigen::VectorXd at = Eigen::VectorXd::Zero(energy.dimension());
    Eigen::VectorXd gradient(at.size());
    double worst = energy.worst_determinant(at);
    double epsilon = std::max(1e-3, std::abs(worst));
    const double step = std::sqrt(typical_area(x, free));
    int idle = 0;
    for (int round = 0; round < kRounds && idle < kIdleRounds && worst < kSoundDeterminant; ++round) {
      energy.set_epsilon(epsilon);
      const double before = energy(at, gradient);
      const double after = minimise(function, at, {.iterations = kSteps, .first_step = step});
      worst = energy.worst_determinant(at);
      idle = 1 - after / before < kIdleProgress ? idle + 1 : 0;
      const double progress = std::max(kLeastProgress, 1 - after / before);
      const double chi = (1 - progress) * 0.5 * (worst + std::sqrt(epsilon * epsilon + worst * worst));
      epsilon = worst < chi ? 2 * std::sqrt(chi * (chi - worst)) : 1e-6;
    }
    energy.place(at, x);
  }

  /// Median of the doubled areas about the free vertices.
  [[nodiscard]] double typical_area(std::span<const Vec3> x, const std::vector<Index>& free) const {
    std::vector<double> areas;
    for (const Index v : free)
      for (const Corner c : topology_.corners_of(v)) {
        const Triangle& t = triangles_[c / 3];
        areas.push_back(area_vector(x[t[0]], x[t[1]], x[t[2]]).norm());
      }
    const auto middle = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2);
    std::nth_element(areas.begin(), middle, areas.end());
    return *middle > 0 ? *middle : *std::max_element(areas.begin(), areas.end());
  }

  std::vector<Vec3> start_, best_;
  std::span<const Triangle> triangles_;
  const Topology& topology_;
  std::span<const std::uint8_t> movable_;
  const OrientationField& field_;
  unsigned threads_;
  std::vector<Index> tangled_;
};

}  // namespace

UntangleResult untangle(std::span<Vec3> positions, std::span<const Triangle> triangles,
                        const Topology& topology, std::span<const std::uint8_t> movable, unsigned threads) {
  const auto find_inverted = [&](std::span<const Vec3> x) {
    return inverted_triangles(x, triangles, topology, threads);
  };
  UntangleResult result;
  const std::vector<Index> inverted = find_inverted(positions);
  result.before = result.after = inverted.size();
  if (inverted.empty()) return result;
  const bool planar = plane_normal(positions, triangles, topology, threads).has_value();
  std::vector<Vec3> x(positions.begin(), positions.end());
  std::vector<Index> doubtful = planar ? inverted : doubtful_triangles(inverted, x, triangles, topology);
  // On a surface the field tells more once some are turned.
  for (unsigned pass = 0; pass < kPasses && !doubtful.empty(); ++pass) {
    const OrientationField field = find_orientation(x, triangles, topology, doubtful, threads);
    Untangler untangler(x, triangles, topology, movable, field, threads);
    untangler.run();
    if (!planar) untangler.lift();
    const std::vector<Index> still = find_inverted(untangler.best());
    std::vector<Index> left =
        planar ? still : doubtful_triangles(still, untangler.best(), triangles, topology);
    if (left.size() >= doubtful.size() || still.size() > result.after) break;
    result.after = still.size();
    x = untangler.best();
    doubtful = std::move(left);
  }
  if (result.after == result.before) return result;
  for (Index v = 0; v < positions.size(); ++v) {
    if (positions[v] == x[v]) continue;
    result.moved.push_back(v);
    positions[v] = x[v];
  }
  return result;
}

}  // namespace isorelax
