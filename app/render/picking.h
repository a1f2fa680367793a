#pragma once

#include "render/camera.h"

namespace isorelax::render {

/// The line of sight through the middle of a pixel.
struct Ray {
  Vec3 origin;
  Vec3 direction;
};
Ray ray_through(const Camera& camera, PictureSize size, int x, int y);

/// Where a ray meets a triangle's plane; the triangle's first corner when they are parallel.
Vec3 point_on_plane(const Ray& ray, const Vec3& a, const Vec3& b, const Vec3& c);

/// Which of three points is seen nearest to the middle of pixel (x, y): 0, 1 or 2.
unsigned nearest_corner(const Camera& camera, PictureSize size, int x, int y, const Vec3& a, const Vec3& b,
                        const Vec3& c);

}  // namespace isorelax::render
