#include "smoothing/regularised_energy.h"

#include <algorithm>
#include <cmath>

#include "energy/reference.h"
#include "mesh/parallel.h"

namespace isorelax {
namespace {

/// Weight of the part that keeps triangles from shrinking to nothing, which costs nothing by shape.
constexpr double kAreaShare = 0.125;

}  // namespace

RegularisedEnergy::RegularisedEnergy(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                     const Topology& topology, std::span<const Vec3> normals,
                                     std::span<const Index> free, double doubled_area, unsigned threads)
    : triangles_(triangles),
      normals_(normals),
      free_(free.begin(), free.end()),
      start_(positions.begin(), positions.end()),
      at_(start_),
      d1_(doubled_area),
      threads_(threads) {
  for (const Index v : free_)
    for (const Corner c : topology.corners_of(v)) region_.push_back(c / 3);
  std::sort(region_.begin(), region_.end());
  region_.erase(std::unique(region_.begin(), region_.end()), region_.end());
  offsets_.push_back(0);
  tangents_.reserve(free_.size());
  for (const Index v : free_) {
    Vec3 sum = Vec3::Zero();
    for (const Corner c : topology.corners_of(v)) {
      const auto slot = std::lower_bound(region_.begin(), region_.end(), c / 3) - region_.begin();
      corners_.push_back(static_cast<std::uint32_t>(3 * slot + c % 3));
      sum += normals_[c / 3];
    }
    offsets_.push_back(static_cast<std::uint32_t>(corners_.size()));
    const Vec3 normal = sum.normalized();
    const Vec3 first = normal.unitOrthogonal();
    tangents_.push_back({first, normal.cross(first)});
  }
  slopes_.resize(region_.size());
  partials_.resize(block_count(region_.size()));
}

void RegularisedEnergy::move_to(const Eigen::VectorXd& x) {
  parallel_for_blocks(free_.size(), threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      at_[free_[i]] = start_[free_[i]] + x[2 * i] * tangents_[i][0] + x[2 * i + 1] * tangents_[i][1];
  });
}

void RegularisedEnergy::place(const Eigen::VectorXd& x, std::span<Vec3> positions) const {
  for (std::size_t i = 0; i < free_.size(); ++i)
    positions[free_[i]] = start_[free_[i]] + x[2 * i] * tangents_[i][0] + x[2 * i + 1] * tangents_[i][1];
}

double RegularisedEnergy::determinant(Index triangle) const {
  const Triangle& v = triangles_[triangle];
  return normals_[triangle].dot(area_vector(at_[v[0]], at_[v[1]], at_[v[2]])) / d1_;
}

double RegularisedEnergy::worst_determinant(const Eigen::VectorXd& x) {
  move_to(x);
  double worst = INFINITY;
  for (const Index t : region_) worst = std::min(worst, determinant(t));
  return worst;
}

/// Energy of one triangle; its gradient goes to slopes_.
double RegularisedEnergy::add(std::size_t slot) {
  const Index t = region_[slot];
  const Triangle& v = triangles_[t];
  const Vec3& n = normals_[t];
  const std::array<Vec3, 3> l = {at_[v[2]] - at_[v[1]], at_[v[0]] - at_[v[2]], at_[v[1]] - at_[v[0]]};
  const double d = n.dot(l[2].cross(-l[1])) / d1_;
  const double root = std::sqrt(epsilon_ * epsilon_ + d * d);
  // The same as (d + root) / 2, without cancellation where d < 0.
  const double chi = d < 0 ? 0.5 * epsilon_ * epsilon_ / (root - d) : 0.5 * (d + root);
  const double squares =
      kEquilateralCot / d1_ * (l[0].squaredNorm() + l[1].squaredNorm() + l[2].squaredNorm());
  const double energy = (squares + kAreaShare * (d * d + 1)) / chi;
  // d chi / d d = chi / root.
  const double by_d = 2 * kAreaShare * d / chi - energy / root;
  const double by_square = 2 * kEquilateralCot / (d1_ * chi);
  for (unsigned k = 0; k < 3; ++k)
    slopes_[slot][k] = by_square * (l[next(k)] - l[previous(k)]) + (by_d / d1_) * n.cross(l[k]);
  return energy;
}

double RegularisedEnergy::operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
  move_to(x);
  parallel_for_blocks(region_.size(), threads_, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t slot = begin; slot < end; ++slot) sum += add(slot);
    partials_[begin / kBlockSize] = sum;
  });
  parallel_for_blocks(free_.size(), threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Vec3 sum = Vec3::Zero();
      for (std::uint32_t c = offsets_[i]; c < offsets_[i + 1]; ++c)
        sum += slopes_[corners_[c] / 3][corners_[c] % 3];
      gradient[2 * i] = sum.dot(tangents_[i][0]);
      gradient[2 * i + 1] = sum.dot(tangents_[i][1]);
    }
  });
  double energy = 0;
  for (const double partial : partials_) energy += partial;
  return energy;
}

}  // namespace isorelax
