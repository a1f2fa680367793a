#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/mesh_file.h"
#include "mesh/triangle_mesh.h"

namespace isorelax {

/// Faces with any number of corners, as flat arrays: face f has corners first_corner[f] up to, but without,
/// first_corner[f + 1].
struct PolygonSoup {
  std::vector<std::uint32_t> first_corner{0};
  std::vector<Index> vertices;

  [[nodiscard]] std::size_t face_count() const { return first_corner.size() - 1; }
  void end_face() { first_corner.push_back(static_cast<std::uint32_t>(vertices.size())); }
};

/// What a reader found, before polygons are cut into triangles: face attributes and labels have one entry per
/// face of `faces`, corner attributes one index per entry of `faces.vertices`.
struct RawMesh {
  std::vector<Vec3> positions;
  PolygonSoup faces;
  MeshAttributes attributes;
  std::vector<std::string> messages;
};

/// Triangles cut from polygons, with the face and the corners that each came from.
struct Triangulation {
  std::vector<Triangle> triangles;
  /// Per triangle: its face.
  std::vector<std::uint32_t> face;
  /// Per triangle corner: its place in PolygonSoup::vertices.
  std::vector<std::uint32_t> corner;
  std::size_t polygons = 0;
  std::size_t polygon_triangles = 0;
  std::size_t skipped_faces = 0;
  std::size_t self_crossing = 0;
};

/// Cuts every face with more than three corners into triangles over its own corners, n - 2 of them, and keeps
/// their orientation; faces with fewer than three corners are skipped and counted. Order of faces is kept.
/// Precondition: indices below positions.size().
Triangulation triangulate(std::span<const Vec3> positions, const PolygonSoup& faces);

/// Cuts one polygon, given by its corners in space, into n - 2 triangles of corner numbers 0 .. n - 1,
/// appended to `out`. Quadrilaterals are cut along the shorter diagonal that does not fold them; others by
/// clipping the best-shaped ear in the plane of the polygon's area vector. Returns false when no ear is left
/// (the polygon crosses itself): the rest is then cut without regard to overlaps. Deterministic.
/// Precondition: three corners or more.
bool triangulate_polygon(std::span<const Vec3> corners, std::vector<std::array<std::uint32_t, 3>>& out);

/// Triangulates what a reader found and carries its attributes over to the triangles. Throws InputError when
/// no triangle comes out.
MeshFile finish_mesh(RawMesh&& raw, FileFormat format, FileEncoding encoding, const std::string& name);

/// "1 vertex", "2 vertices": a count with the right form of its noun.
std::string counted(std::size_t count, const char* singular, const char* plural);

}  // namespace isorelax
