#include "render/picking.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

namespace isorelax::render {
namespace {

/// A pixel's middle in the target's plane, from the target, to the right and upwards.
Eigen::Vector2d in_target_plane(const Camera& camera, PictureSize size, int x, int y) {
  const double per_pixel = camera.extent / std::min(size.width, size.height);
  return {(x + 0.5 - 0.5 * size.width) * per_pixel, (0.5 * size.height - y - 0.5) * per_pixel};
}

}  // namespace

Ray ray_through(const Camera& camera, PictureSize size, int x, int y) {
  const CameraAxes axes = axes_of(camera);
  const Eigen::Vector2d at = in_target_plane(camera, size, x, y);
  const Vec3 aim = camera.target + at.x() * axes.right + at.y() * axes.up;
  if (camera.projection == Projection::orthographic)
    return {aim + eye_distance(camera) * axes.toward_eye, -axes.toward_eye};
  const Vec3 eye = camera.target + eye_distance(camera) * axes.toward_eye;
  return {eye, (aim - eye).normalized()};
}

Vec3 point_on_plane(const Ray& ray, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = area_vector(a, b, c).stableNormalized();
  const double slope = normal.dot(ray.direction);
  if (slope == 0) return a;
  return ray.origin + normal.dot(a - ray.origin) / slope * ray.direction;
}

unsigned nearest_corner(const Camera& camera, PictureSize size, int x, int y, const Vec3& a, const Vec3& b,
                        const Vec3& c) {
  const CameraAxes axes = axes_of(camera);
  const Eigen::Vector2d at = in_target_plane(camera, size, x, y);
  const std::array<Vec3, 3> corners = {a, b, c};
  unsigned nearest = 0;
  double least = std::numeric_limits<double>::max();
  for (unsigned k = 0; k < 3; ++k) {
    const Vec3 d = corners[k] - camera.target;
    const double depth =
        camera.projection == Projection::perspective ? 1 - d.dot(axes.toward_eye) / eye_distance(camera) : 1;
    if (depth <= 0) continue;
    const Eigen::Vector2d seen(d.dot(axes.right) / depth, d.dot(axes.up) / depth);
    const double distance = (seen - at).squaredNorm();
    if (distance < least) {
      least = distance;
      nearest = k;
    }
  }
  return nearest;
}

}  // namespace isorelax::render
