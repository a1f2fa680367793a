#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isorelax::render {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;
/// Degrees per drag over the picture's shorter side.
constexpr double kOrbitSpeed = 200.0;

double shorter_side(PictureSize size) {
  return std::max(1, std::min(size.width, size.height));
}

/// Angles stay readable after many turns.
double wrapped(double degrees) {
  return degrees - 360.0 * std::floor((degrees + 180.0) / 360.0);
}

}  // namespace

Bounds bounds_of(std::span<const Vec3> positions) {
  if (positions.empty()) return {};
  Bounds bounds{positions[0], positions[0]};
  for (const Vec3& p : positions) {
    bounds.low = bounds.low.cwiseMin(p);
    bounds.high = bounds.high.cwiseMax(p);
  }
  return bounds;
}

CameraAxes axes_of(const Camera& camera) {
  const double azimuth = camera.azimuth_deg * kRadians;
  const double elevation = camera.elevation_deg * kRadians;
  const Vec3 up_axis = camera.up == UpAxis::y ? Vec3::UnitY() : Vec3::UnitZ();
  const Vec3 front = camera.up == UpAxis::y ? Vec3::UnitZ() : Vec3(-Vec3::UnitY());
  const Vec3 horizontal = std::sin(azimuth) * Vec3::UnitX() + std::cos(azimuth) * front;
  CameraAxes axes;
  axes.right = std::cos(azimuth) * Vec3::UnitX() - std::sin(azimuth) * front;
  axes.toward_eye = std::cos(elevation) * horizontal + std::sin(elevation) * up_axis;
  axes.up = std::cos(elevation) * up_axis - std::sin(elevation) * horizontal;
  return axes;
}

double eye_distance(const Camera& camera) {
  return 0.5 * camera.extent / std::tan(0.5 * camera.field_of_view_deg * kRadians);
}

glm::mat4 view_projection(const Camera& camera, PictureSize size, const MeshFrame& frame,
                          const Bounds& bounds) {
  const CameraAxes axes = axes_of(camera);
  const double distance = eye_distance(camera);
  // Depths of the scene along the line of sight, counted from the eye.
  const double center = distance - (bounds.center() - camera.target).dot(axes.toward_eye);
  const double radius = std::max(0.51 * bounds.diagonal(), 1e-6 * camera.extent);
  const bool perspective = camera.projection == Projection::perspective;
  const double far = std::max(center + radius, perspective ? 2e-3 * camera.extent : -1e300);
  const double near =
      perspective ? std::max(center - radius, 1e-3 * std::min(far, camera.extent)) : center - radius;

  // Rows of clip space over world offsets from the target, all divided by a length so that numbers stay
  // near 1.
  const double half_x = 0.5 * camera.extent * size.width / shorter_side(size);
  const double half_y = 0.5 * camera.extent * size.height / shorter_side(size);
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip.block<1, 3>(0, 0) = axes.right.transpose() / half_x;
  clip.block<1, 3>(1, 0) = axes.up.transpose() / half_y;
  if (perspective) {
    clip.block<1, 3>(3, 0) = -axes.toward_eye.transpose() / distance;
    clip(3, 3) = 1;
    // depth d = distance - z: clip z = ((far + near) d - 2 far near) / ((far - near) distance)
    clip.block<1, 3>(2, 0) = -(far + near) / (far - near) / distance * axes.toward_eye.transpose();
    clip(2, 3) = (far + near) / (far - near) - 2 * far * near / ((far - near) * distance);
  } else {
    clip(3, 3) = 1;
    clip.block<1, 3>(2, 0) = -2 / (far - near) * axes.toward_eye.transpose();
    clip(2, 3) = (2 * distance - far - near) / (far - near);
  }
  // p_world - target = scale * p_frame + (origin - target)
  Eigen::Matrix4d placed = Eigen::Matrix4d::Identity();
  placed.block<3, 3>(0, 0) *= frame.scale;
  placed.block<3, 1>(0, 3) = frame.origin - camera.target;
  const Eigen::Matrix4d full = clip * placed;
  glm::mat4 result;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) result[column][row] = static_cast<float>(full(row, column));
  return result;
}

glm::mat3 view_rotation(const Camera& camera) {
  const CameraAxes axes = axes_of(camera);
  glm::mat3 result;
  for (int column = 0; column < 3; ++column) {
    result[column][0] = static_cast<float>(axes.right[column]);
    result[column][1] = static_cast<float>(axes.up[column]);
    result[column][2] = static_cast<float>(axes.toward_eye[column]);
  }
  return result;
}

Camera orbit(const Camera& camera, double dx, double dy, PictureSize size) {
  Camera turned = camera;
  turned.azimuth_deg = wrapped(camera.azimuth_deg - kOrbitSpeed * dx / shorter_side(size));
  turned.elevation_deg =
      std::clamp(camera.elevation_deg + kOrbitSpeed * dy / shorter_side(size), -90.0, 90.0);
  return turned;
}

Camera pan(const Camera& camera, double dx, double dy, PictureSize size) {
  const CameraAxes axes = axes_of(camera);
  const double per_pixel = camera.extent / shorter_side(size);
  Camera moved = camera;
  moved.target += per_pixel * (-dx * axes.right + dy * axes.up);
  return moved;
}

Camera zoom_to(const Camera& camera, double factor, double x, double y, PictureSize size) {
  // The pointer's place in the target's plane, from the target, scales about the pointer.
  const double dx = x - 0.5 * size.width;
  const double dy = y - 0.5 * size.height;
  Camera zoomed = pan(camera, -dx * (1 - 1 / factor), -dy * (1 - 1 / factor), size);
  zoomed.extent = camera.extent / factor;
  return zoomed;
}

}  // namespace isorelax::render
