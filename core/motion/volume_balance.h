#pragma once

#include <span>
#include <vector>

#include "motion/edge_middles.h"

namespace isorelax {

/// What balancing did.
struct BalanceReport {
  double volume_before = 0, volume_after = 0;
  double factor = 0;   ///< on the local heights of the surface over the mesh; the same everywhere
  double largest = 0;  ///< longest move, length units
};

/// Gives a closed mesh the volume that its surface encloses.
///
/// A mesh with its vertices on a curved surface cuts its chords: it lacks volume wherever it is coarse. Each
/// vertex moves along its normal in proportion to the mean height of the surface over the middles of its
/// edges (what the best piecewise linear approximation would do), with one factor for all such that the
/// volume is the wanted one. Creases and corners stay. Nothing accumulates: positions start from the surface
/// every time.
class VolumeBalance {
 public:
  VolumeBalance(std::span<const Triangle> triangles, const Topology& topology, unsigned threads);

  /// Precondition: positions = map of the points. No vertex goes farther than a quarter of its mean edge.
  BalanceReport balance(const FlowMap& map, std::span<const MaterialPoint> points,
                        std::span<const std::uint8_t> held, double volume, std::span<Vec3> positions);

 private:
  std::vector<Triangle> triangles_;
  unsigned threads_;
  EdgeMiddles middles_;
  std::vector<Vec3> normals_, moves_, base_;
  std::vector<double> lengths_;
  std::vector<std::uint32_t> degrees_;
};

}  // namespace isorelax
