#pragma once

#include <glm/mat4x4.hpp>
#include <span>
#include <string_view>

#include "mesh/triangle_mesh.h"

namespace isorelax::render {

enum class Projection { perspective, orthographic };

/// Which coordinate points up in the picture at elevation 0.
enum class UpAxis { y, z };

/// Where one looks from, as a value: two equal cameras give equal pictures.
///
/// A turntable: the eye goes around `target`. Azimuth 0 and elevation 0 look at the front: along -z when y is
/// up, along +y when z is up; x points right in both. Positive azimuth takes the eye to the right (towards
/// +x), positive elevation lifts it.
struct Camera {
  Vec3 target = Vec3::Zero();
  double azimuth_deg = 0;
  double elevation_deg = 0;  ///< -90..90
  UpAxis up = UpAxis::y;
  /// World length, at the target, that the shorter side of the picture shows. > 0.
  double extent = 2;
  Projection projection = Projection::perspective;
  double field_of_view_deg = 30;  ///< across the shorter side of the picture; perspective only

  friend bool operator==(const Camera&, const Camera&) = default;
};

struct Bounds {
  Vec3 low = Vec3::Zero();
  Vec3 high = Vec3::Zero();

  [[nodiscard]] Vec3 center() const { return 0.5 * low + 0.5 * high; }
  [[nodiscard]] double diagonal() const { return (high - low).norm(); }
};

/// Smallest box around the points; a point at the origin when there are none.
Bounds bounds_of(std::span<const Vec3> positions);

/// Orthonormal axes of the picture in world coordinates. `toward_eye` points from the target to the eye.
struct CameraAxes {
  Vec3 right;
  Vec3 up;
  Vec3 toward_eye;
};
CameraAxes axes_of(const Camera& camera);

/// Distance from eye to target; for an orthographic camera that of the perspective one of the same extent.
double eye_distance(const Camera& camera);

struct PictureSize {
  int width = 1280;
  int height = 720;

  friend bool operator==(const PictureSize&, const PictureSize&) = default;
};

/// Where single-precision coordinates live: world = origin + scale * local. With the origin in the mesh and
/// the scale of its size, meshes far from the world's origin, tiny or huge are all drawn alike.
struct MeshFrame {
  Vec3 origin = Vec3::Zero();
  double scale = 1;
};

/// From a frame to OpenGL clip space, computed in double. Near and far planes enclose `bounds` (world).
glm::mat4 view_projection(const Camera& camera, PictureSize size, const MeshFrame& frame,
                          const Bounds& bounds);

/// From world directions to the picture's axes (right, up, toward the eye), for normals.
glm::mat3 view_rotation(const Camera& camera);

/// Turns by a drag of (dx, dy) pixels, y downwards: the object follows the pointer.
Camera orbit(const Camera& camera, double dx, double dy, PictureSize size);
/// Shifts the target so that the point at the target's depth follows a drag of (dx, dy) pixels.
Camera pan(const Camera& camera, double dx, double dy, PictureSize size);
/// Magnifies by `factor` > 0 (2: twice as large) and keeps what is under the pixel (x, y) in place.
Camera zoom_to(const Camera& camera, double factor, double x, double y, PictureSize size);

struct FitOptions {
  /// Share of the picture's shorter side left free around the mesh.
  double margin = 0.06;
  /// Length left free on the right (a legend stands there), as a share of the picture's height;
  /// never more than four fifths of the right half.
  double right = 0;
  /// The same at the top and the bottom, for what is laid over the picture there.
  double top = 0;
  double bottom = 0;
};

/// The same direction, all of `bounds` in sight and centred, or as near to the centre as the space kept free
/// allows. A single point is shown with extent 1.
Camera fit(const Camera& camera, const Bounds& bounds, PictureSize size, const FitOptions& options = {});
/// The same for the points themselves: tighter than their box.
Camera fit(const Camera& camera, std::span<const Vec3> positions, PictureSize size,
           const FitOptions& options = {});

enum class NamedView { front, back, left, right, top, bottom, iso };
/// The same target, extent and projection, seen from a named side.
Camera look_from(const Camera& camera, NamedView view);

/// How a mesh is seen first: planar ones orthographically from above (in the xy plane: x right, y up; any
/// other plane along its normal), others in perspective from the front, right and above; z is up when the
/// mesh is much flatter in z than in x and y, else y.
Camera default_camera(std::span<const Vec3> positions, PictureSize size, const FitOptions& options = {});

/// A camera from text, for the mesh given by its points: VIEW[:OPTION...].
/// VIEW: fit (the default camera), front, back, left, right, top, bottom, iso, or
/// AZIMUTH,ELEVATION[,ZOOM] in degrees. OPTION: perspective, orthographic, y-up, z-up, zoom=FACTOR. Example:
/// "30,20:z-up:zoom=2". Throws UsageError naming the part that is wrong.
Camera parse_camera(std::string_view text, std::span<const Vec3> positions, PictureSize size,
                    const FitOptions& options = {});

}  // namespace isorelax::render
