#include "motion/face_offsetting.h"

#include <algorithm>
#include <cmath>

#include "mesh/parallel.h"
#include "motion/velocity_field.h"
#include "smoothing/fold_control.h"

namespace isorelax {
namespace {

/// Share of the way from one triangle to another that keeps it safely on its side, as fold_free_share tells;
/// and safely away from having no area on the way, which turning through a point does without a change of
/// sign.
double safe_share_of(const std::array<Vec3, 3>& from, const std::array<Vec3, 3>& to) {
  constexpr double kLeastArea = 0.05;  // of the start's
  constexpr double kSafe = 0.6;        // of the way there
  const Vec3 t1 = from[1] - from[0];
  const Vec3 t2 = from[2] - from[0];
  const Vec3 d1 = to[1] - to[0] - t1;
  const Vec3 d2 = to[2] - to[0] - t2;
  const Vec3 normal = t1.cross(t2);
  const double c = normal.squaredNorm();
  const double b = (d1.cross(t2) + t1.cross(d2)).dot(normal);
  const double q = d1.cross(d2).dot(normal);
  double share = fold_free_share(from, to);
  const double lowest = q > 0 ? -0.5 * b / q : 0;
  if (lowest > 0 && lowest < 1.25 && c + 0.5 * b * lowest < kLeastArea * c)
    share = std::min(share, kSafe * lowest);
  return share;
}

}  // namespace

FaceOffsetting::FaceOffsetting(std::span<const Triangle> triangles, const Topology& topology,
                               const FaceOffsettingOptions& options, unsigned threads)
    : triangles_(triangles.begin(), triangles.end()),
      topology_(&topology),
      options_(options),
      threads_(threads),
      normals_(triangles.size()),
      anchors_(triangles.size()),
      own_(topology.vertex_count()),
      moves_(topology.vertex_count()) {}

void FaceOffsetting::offset_vertices(std::span<const Vec3> positions) {
  parallel_for_blocks(positions.size(), threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto v = static_cast<Index>(i);
      SymmetricMatrix covariance;
      Vec3 right = Vec3::Zero();
      for (const Corner corner : topology_->corners_of(v)) {
        const Index t = corner / 3;
        const double weight = normals_[t].norm();
        if (!(weight > 0)) continue;
        const Vec3 root = normals_[t] / std::sqrt(weight);  // sqrt(w) n
        covariance.add_outer(root.x(), root.y(), root.z());
        right += root.dot(anchors_[t] - positions[v]) * root;
      }
      const CovarianceEigen eigen = decompose(covariance);
      Vec3 move = Vec3::Zero();
      for (int k = 0; k < 3; ++k) {
        const Vec3 axis = eigen.vectors.col(k);
        const bool primary = eigen.values[k] > options_.primary_share * eigen.values[0];
        move += (primary ? axis.dot(right) / eigen.values[k] : axis.dot(own_[v])) * axis;
      }
      moves_[v] = move;
    }
  });
}

double FaceOffsetting::fold_share(std::span<const Vec3> positions, Index& vertex) const {
  double least = 1;
  for (const Triangle& t : triangles_) {
    const std::array<Vec3, 3> from = {positions[t[0]], positions[t[1]], positions[t[2]]};
    if (!(area_vector(from[0], from[1], from[2]).squaredNorm() > 0)) continue;
    const double share =
        safe_share_of(from, {from[0] + moves_[t[0]], from[1] + moves_[t[1]], from[2] + moves_[t[2]]});
    if (share < least) {
      least = share;
      vertex = t[0];
    }
  }
  return least;
}

OffsetReport FaceOffsetting::propagate(const NormalSpeed& speed, double t, double dt,
                                       std::span<Vec3> positions) {
  OffsetReport report;
  report.parts = 0;
  const std::vector<Vec3> start(positions.begin(), positions.end());
  double done = 0;
  try {
    while (done < 1) {
      double part = 1 - done;
      Index vertex = kNone;
      for (;;) {
        std::ranges::fill(own_, Vec3::Zero());
        for (Index f = 0; f < triangles_.size(); ++f) {
          const Triangle& v = triangles_[f];
          normals_[f] = area_vector(positions[v[0]], positions[v[1]], positions[v[2]]);
          const double length = normals_[f].norm();
          const Vec3 centre = (positions[v[0]] + positions[v[1]] + positions[v[2]]) / 3;
          const double middle = t + (done + 0.5 * part) * dt;
          const double pace = speed(centre, middle);
          if (!std::isfinite(pace)) throw MotionError(middle, v[0], "the speed is not a finite number");
          anchors_[f] = length > 0 ? Vec3(centre + part * dt * pace / length * normals_[f]) : centre;
        }
        offset_vertices(positions);
        if (!(fold_share(positions, vertex) < 1)) break;
        part *= options_.safe_share;
        if (part < options_.least_part)
          throw MotionError(t + done * dt, vertex, "the surface folds: no shorter step helps");
      }
      for (std::size_t v = 0; v < positions.size(); ++v) {
        positions[v] += moves_[v];
        if (!positions[v].allFinite())
          throw MotionError(t + (done + part) * dt, static_cast<Index>(v),
                            "the position is no longer finite");
      }
      done = part == 1 - done ? 1 : done + part;
      ++report.parts;
    }
  } catch (...) {
    std::ranges::copy(start, positions.begin());
    throw;
  }
  return report;
}

bool FaceOffsetting::advect(std::span<const Vec3> moved, std::span<Vec3> positions) {
  for (Index f = 0; f < triangles_.size(); ++f) {
    const Triangle& v = triangles_[f];
    normals_[f] = area_vector(moved[v[0]], moved[v[1]], moved[v[2]]);
    anchors_[f] = (moved[v[0]] + moved[v[1]] + moved[v[2]]) / 3;
  }
  for (std::size_t v = 0; v < positions.size(); ++v) own_[v] = moved[v] - positions[v];
  offset_vertices(positions);
  Index vertex = kNone;
  if (fold_share(positions, vertex) < 1) return false;
  for (std::size_t v = 0; v < positions.size(); ++v) positions[v] += moves_[v];
  return true;
}

}  // namespace isorelax
