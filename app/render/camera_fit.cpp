#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "render/camera.h"

namespace isorelax::render {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
/// A mesh is planar when it is thinner than this share of its size.
constexpr double kPlanarThickness = 1e-6;
/// z is up when a mesh is flatter in z than this share of its smaller side in x and y.
constexpr double kFlatInZ = 0.45;
/// How a solid is seen first.
constexpr double kFirstAzimuth = 30;
constexpr double kFirstElevation = 20;

std::array<Vec3, 8> corners_of(const Bounds& bounds) {
  std::array<Vec3, 8> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners[i] = {(i & 1U) != 0 ? bounds.high.x() : bounds.low.x(),
                  (i & 2U) != 0 ? bounds.high.y() : bounds.low.y(),
                  (i & 4U) != 0 ? bounds.high.z() : bounds.low.z()};
  return corners;
}

/// Half widths of the free part of the picture, in units of camera.extent.
struct FreeHalf {
  double x;
  double y;
};

FreeHalf free_half(PictureSize size, const FitOptions& options) {
  const double width = size.width;
  const double height = size.height;
  const double shorter = std::max(1.0, std::min(width, height));
  const double margin = options.margin * shorter;
  const double free_x = std::max(0.5 * width - margin - options.side * height, 0.1 * width);
  const double free_y = std::max(0.5 * height - margin, 0.1 * height);
  return {free_x / shorter, free_y / shorter};
}

/// Least extent at which all points, as seen around the camera's target, lie in the free part.
double extent_for(const Camera& camera, std::span<const Vec3> points, const FreeHalf& free) {
  const CameraAxes axes = axes_of(camera);
  // eye distance per extent
  const double reach = eye_distance(camera) / camera.extent;
  double extent = 0;
  for (const Vec3& p : points) {
    const Vec3 d = p - camera.target;
    const double across = std::max(std::abs(d.dot(axes.right)) / free.x, std::abs(d.dot(axes.up)) / free.y);
    const double nearer = camera.projection == Projection::perspective ? d.dot(axes.toward_eye) / reach : 0;
    // perspective: across / (1 - z / distance) <= extent with distance = reach * extent
    extent = std::max(extent, across + nearer);
  }
  return extent;
}

/// Target in the middle of the points' silhouette box for the camera's direction, at the depth of `center`.
Vec3 centered_target(const Camera& camera, std::span<const Vec3> points, const Vec3& center) {
  const CameraAxes axes = axes_of(camera);
  double low[2] = {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  double high[2] = {std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};
  for (const Vec3& p : points) {
    const double at[2] = {(p - center).dot(axes.right), (p - center).dot(axes.up)};
    for (int k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], at[k]);
      high[k] = std::max(high[k], at[k]);
    }
  }
  return center + 0.5 * (low[0] + high[0]) * axes.right + 0.5 * (low[1] + high[1]) * axes.up;
}

Camera fit_points(const Camera& camera, std::span<const Vec3> points, const Vec3& center, PictureSize size,
                  const FitOptions& options) {
  Camera fitted = camera;
  fitted.target = points.empty() ? center : centered_target(camera, points, center);
  fitted.extent = extent_for(fitted, points, free_half(size, options));
  if (!(fitted.extent > 0)) fitted.extent = 1;
  return fitted;
}

/// The unit normal of the plane that holds all points, or nothing when they need space (or are a line).
std::optional<Vec3> plane_normal(std::span<const Vec3> positions, const Bounds& bounds) {
  const double size = bounds.diagonal();
  if (positions.size() < 3 || !(size > 0)) return {};
  const Vec3 center = bounds.center();
  Mat3 covariance = Mat3::Zero();
  for (const Vec3& p : positions) {
    const Vec3 d = (p - center) / size;
    covariance += d * d.transpose();
  }
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : positions) mean += (p - center) / size;
  covariance -= mean * mean.transpose() / static_cast<double>(positions.size());
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(covariance);
  const Vec3 normal = axes.eigenvectors().col(0);
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  for (const Vec3& p : positions) {
    const double height = (p - center).dot(normal) / size;
    low = std::min(low, height);
    high = std::max(high, height);
  }
  const bool is_line = axes.eigenvalues()[1] <= 1e-12 * axes.eigenvalues()[2];
  if (is_line || high - low > kPlanarThickness) return {};
  return normal;
}

/// A camera that looks along the normal of a plane, from the side where the normal's greatest entry is
/// positive.
Camera looking_along(const Vec3& plane_normal) {
  Camera camera;
  camera.projection = Projection::orthographic;
  Eigen::Index greatest = 0;
  plane_normal.cwiseAbs().maxCoeff(&greatest);
  const Vec3 n = plane_normal[greatest] < 0 ? Vec3(-plane_normal) : plane_normal;
  if (greatest == 2 && n.head<2>().norm() < 1e-6) {
    camera.up = UpAxis::z;
    camera.elevation_deg = 90;
    return camera;
  }
  camera.up = UpAxis::y;
  camera.azimuth_deg = std::atan2(n.x(), n.z()) * kDegrees;
  camera.elevation_deg = std::asin(std::clamp(n.y(), -1.0, 1.0)) * kDegrees;
  return camera;
}

}  // namespace

Camera fit(const Camera& camera, const Bounds& bounds, PictureSize size, const FitOptions& options) {
  return fit_points(camera, corners_of(bounds), bounds.center(), size, options);
}

Camera fit(const Camera& camera, std::span<const Vec3> positions, PictureSize size,
           const FitOptions& options) {
  return fit_points(camera, positions, bounds_of(positions).center(), size, options);
}

Camera look_from(const Camera& camera, NamedView view) {
  struct Angles {
    double azimuth;
    double elevation;
  };
  // Azimuth 45 and the elevation at which all three axes are foreshortened alike.
  constexpr double kIsometric = 35.264389682754654;
  constexpr Angles kAngles[] = {{0, 0}, {180, 0}, {-90, 0}, {90, 0}, {0, 90}, {0, -90}, {45, kIsometric}};
  const Angles angles = kAngles[static_cast<std::size_t>(view)];
  Camera turned = camera;
  turned.azimuth_deg = angles.azimuth;
  turned.elevation_deg = angles.elevation;
  return turned;
}

Camera default_camera(std::span<const Vec3> positions, PictureSize size, const FitOptions& options) {
  const Bounds bounds = bounds_of(positions);
  Camera camera;
  if (const auto normal = plane_normal(positions, bounds)) {
    camera = looking_along(*normal);
  } else {
    const Vec3 sides = bounds.high - bounds.low;
    camera.azimuth_deg = kFirstAzimuth;
    camera.elevation_deg = kFirstElevation;
    camera.up = sides.z() < kFlatInZ * std::min(sides.x(), sides.y()) ? UpAxis::z : UpAxis::y;
  }
  return fit(camera, positions, size, options);
}

}  // namespace isorelax::render
