#include "smoothing/orientation_field.h"

#include "quality/inverted.h"

namespace isorelax {

OrientationField find_orientation(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                  const Topology& topology, unsigned threads) {
  OrientationField field;
  if (const auto normal = plane_normal(positions, triangles, topology, threads)) {
    field.planar = true;
    field.normals.assign(triangles.size(), *normal);
    field.judged.assign(triangles.size(), 1);
  } else {
    field.normals.assign(triangles.size(), Vec3::Zero());
    field.judged.assign(triangles.size(), 0);
  }
  return field;
}

}  // namespace isorelax
