#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "mesh/angle.h"
#include "render/camera.h"

namespace isorelax::render {
namespace {

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

/// The free part of the picture, from its middle, in units of camera.extent.
struct FreeArea {
  double left;   ///< < 0
  double right;  ///< > 0
  double low;    ///< < 0
  double high;   ///< > 0
};

FreeArea free_area(PictureSize size, const FitOptions& options) {
  const double width = size.width;
  const double height = size.height;
  const double shorter = std::max(1.0, std::min(width, height));
  const double margin = options.margin * shorter;
  const double half_width = std::max(0.5 * width - margin, 0.1 * width);
  const double right = std::max(half_width - options.right * height, 0.2 * half_width);
  const double half_height = std::max(0.5 * height - margin, 0.1 * height);
  const double high = std::max(half_height - options.top * height, 0.2 * half_height);
  const double low = std::max(half_height - options.bottom * height, 0.2 * half_height);
  return {-half_width / shorter, right / shorter, -low / shorter, high / shorter};
}

/// A point as the camera sees it, from the target: to the right, up, toward the eye.
struct Seen {
  double x;
  double y;
  double z;
};

std::vector<Seen> see(const Camera& camera, std::span<const Vec3> points) {
  const CameraAxes axes = axes_of(camera);
  std::vector<Seen> seen;
  seen.reserve(points.size());
  for (const Vec3& p : points) {
    const Vec3 d = p - camera.target;
    seen.push_back({d.dot(axes.right), d.dot(axes.up), d.dot(axes.toward_eye)});
  }
  return seen;
}

/// Nearness to the eye per distance to it; nothing gets larger by being nearer in an orthographic picture.
double nearness(const Camera& camera) {
  return camera.projection == Projection::perspective ? camera.extent / eye_distance(camera) : 0;
}

/// Least extent at which all points, moved by (x, y) in the picture's plane, lie in the free part.
double extent_for(const Camera& camera, std::span<const Seen> points, double x, double y,
                  const FreeArea& free) {
  const double near = nearness(camera);
  double extent = 0;
  for (const Seen& p : points) {
    const double across = std::max(
        {(p.x + x) / free.right, (p.x + x) / free.left, (p.y + y) / free.high, (p.y + y) / free.low});
    // In perspective across / (1 - z / distance) <= extent, where near = extent / distance.
    extent = std::max(extent, across + p.z * near);
  }
  return extent > 0 ? extent : 1;
}

/// Box around the points in the picture, in world lengths at the target.
struct Silhouette {
  double left = std::numeric_limits<double>::max();
  double right = std::numeric_limits<double>::lowest();
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
};

Silhouette silhouette_of(std::span<const Seen> points, double x, double y, double nearness_per_length) {
  Silhouette box;
  for (const Seen& p : points) {
    const double depth = std::max(1 - p.z * nearness_per_length, 1e-3);
    box.left = std::min(box.left, (p.x + x) / depth);
    box.right = std::max(box.right, (p.x + x) / depth);
    box.low = std::min(box.low, (p.y + y) / depth);
    box.high = std::max(box.high, (p.y + y) / depth);
  }
  return box;
}

Camera fit_points(const Camera& camera, std::span<const Vec3> points, const Vec3& center, PictureSize size,
                  const FitOptions& options) {
  Camera fitted = camera;
  fitted.target = center;
  if (points.empty()) {
    fitted.extent = 1;
    return fitted;
  }
  const std::vector<Seen> seen = see(fitted, points);
  const FreeArea free = free_area(size, options);
  double x = 0;
  double y = 0;
  double extent = extent_for(fitted, seen, x, y, free);
  const double least = 1e-6 * extent;
  // In perspective the silhouette depends on the extent; a few rounds settle both to less than a pixel.
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    const Silhouette box = silhouette_of(seen, x, y, nearness(fitted) / extent);
    extent = std::max({(box.right - box.left) / (free.right - free.left),
                       (box.high - box.low) / (free.high - free.low), least});
    // No further than needed: a shape that fits in the picture's middle stays there.
    const double middle = std::min(0.0, free.right * extent - 0.5 * (box.right - box.left));
    const double half_height = 0.5 * (box.high - box.low);
    const double level =
        std::max(free.low * extent + half_height, std::min(0.0, free.high * extent - half_height));
    x -= 0.5 * (box.left + box.right) - middle;
    y -= 0.5 * (box.low + box.high) - level;
  }
  const CameraAxes axes = axes_of(fitted);
  fitted.target -= x * axes.right + y * axes.up;
  fitted.extent = extent_for(fitted, seen, x, y, free);
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
