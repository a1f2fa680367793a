#include "motion/dense_copy.h"

#include <cmath>
#include <utility>

#include "mesh/parallel.h"
#include "motion/edge_middles.h"
#include "motion/runge_kutta.h"
#include "surface/closest_point.h"
#include "surface/vertex_class.h"

namespace isorelax {
namespace {

/// Middles of the edges on the smooth surface.
std::vector<Vec3> smooth_middles(const TriangleMesh& mesh, const Topology& topology, EdgeMiddles& edges,
                                 unsigned threads) {
  const VertexClasses classes =
      classify_vertices(mesh.positions, mesh.triangles, topology, FeatureOptions{}, threads);
  EdgeWalls walls(3 * mesh.triangles.size(), 0);
  for (Corner c = 0; c < walls.size(); ++c) walls[c] = topology.opposite(c) == kNone ? 1 : 0;
  for (const FeatureEdge& crease : classes.creases) {
    walls[crease.corner] = 1;
    if (topology.opposite(crease.corner) != kNone) walls[topology.opposite(crease.corner)] = 1;
  }
  const MaterialSurface surface(mesh.positions, mesh.triangles, topology, walls);
  const FlowMap map(surface, topology, walls, threads);
  std::vector<MaterialPoint> points(mesh.positions.size());
  for (Index v = 0; v < points.size(); ++v) {
    if (topology.corners_of(v).empty()) continue;
    const Corner corner = topology.corners_of(v)[0];
    points[v].triangle = corner / 3;
    points[v].weights[corner % 3] = 1;
  }
  edges.measure(map, points, mesh.positions);
  std::vector<Vec3> middles;
  for (std::size_t e = 0; e < edges.edges().size(); ++e) {
    const MiddledEdge& edge = edges.edges()[e];
    const Vec3 chord = 0.5 * (mesh.positions[edge.a] + mesh.positions[edge.b]);
    middles.push_back(walls[edge.corner] != 0 ? chord : edges.mapped(e).position);
  }
  return middles;
}

TriangleMesh refine(const TriangleMesh& mesh, const SurfacePlacement& place, unsigned threads) {
  const Topology topology(mesh.triangles, mesh.vertex_count());
  EdgeMiddles edges(mesh.triangles, topology, threads);
  std::vector<Vec3> middles;
  if (place) {
    for (const MiddledEdge& edge : edges.edges())
      middles.push_back(place(0.5 * (mesh.positions[edge.a] + mesh.positions[edge.b])));
  } else {
    middles = smooth_middles(mesh, topology, edges, threads);
  }
  TriangleMesh fine;
  fine.positions = mesh.positions;
  std::vector<Index> at(3 * mesh.triangles.size());
  for (std::size_t e = 0; e < middles.size(); ++e) {
    const Corner corner = edges.edges()[e].corner;
    at[corner] = fine.vertex_count();
    if (topology.opposite(corner) != kNone) at[topology.opposite(corner)] = fine.vertex_count();
    fine.positions.push_back(middles[e]);
  }
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Triangle& v = mesh.triangles[t];
    const std::array<Index, 3> m = {at[3 * t], at[3 * t + 1], at[3 * t + 2]};
    for (const Triangle& part :
         {Triangle{v[0], m[2], m[1]}, {m[2], v[1], m[0]}, {m[1], m[0], v[2]}, {m[0], m[1], m[2]}})
      fine.triangles.push_back(part);
  }
  return fine;
}

Distances distances_to(const ClosestPointIndex& index, std::span<const Vec3> points, unsigned threads) {
  std::vector<double> each(points.size());
  parallel_for_blocks(points.size(), threads, [&](std::size_t begin, std::size_t end) {
    Index hint = kNone;
    for (std::size_t i = begin; i < end; ++i) {
      const SurfacePoint closest = index.closest(points[i], hint);
      each[i] = closest.distance;
      hint = closest.triangle;
    }
  });
  DistanceSum sum;
  for (const double distance : each) sum.add(distance);
  return sum.result();
}

}  // namespace

DenseCopy::DenseCopy(const TriangleMesh& start, unsigned levels, const SurfacePlacement& place,
                     unsigned threads)
    : threads_(threads) {
  mesh_.positions = start.positions;
  mesh_.triangles = start.triangles;
  for (unsigned i = 0; i < levels; ++i) mesh_ = refine(mesh_, place, threads);
}

void DenseCopy::advance(const VelocityField& field, double t, double dt) {
  RungeKutta(field, threads_).step(mesh_.positions, t, dt);
}

std::pair<Distances, Distances> DenseCopy::distances(std::span<const Vec3> positions,
                                                     std::span<const Triangle> triangles) const {
  const ClosestPointIndex truth(mesh_.positions, mesh_.triangles);
  const ClosestPointIndex coarse(positions, triangles);
  return {distances_to(truth, positions, threads_), distances_to(coarse, mesh_.positions, threads_)};
}

}  // namespace isorelax
