#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <variant>

#include "energy/reference.h"
#include "energy/triangle_energy.h"
#include "smoothing/renumbering.h"
#include "smoothing/untangle.h"
#include "smoothing/worst_angles.h"
#include "surface/frozen_surface.h"
#include "surface/vertex_class.h"

namespace isorelax {

/// What boundary vertices may do.
enum class BoundaryRule : std::uint8_t {
  fixed,  ///< nothing
  slide,  ///< move along the border; its corners stay
  free,   ///< move in the tangent plane like any other vertex
};

/// Where vertices go on a curved surface.
enum class SurfaceRule : std::uint8_t {
  tangent,  ///< along their tangent space, which leaves the surface at second order (the paper)
  project,  ///< along it and back to the surface as it was at the start: closest point, high-order local fits
};

/// Equilateral references with the mean area of the mesh.
struct MeanAreaReference {};
/// Equilateral references with this edge length.
struct EdgeLengthReference {
  double edge_length;
};
/// The mesh itself as it is when smoothing starts.
struct InitialReference {};
/// Another mesh with the same connectivity: its positions.
struct MeshReference {
  std::vector<Vec3> positions;
};
/// Equilateral references whose edge length is the mean of what their vertices ask for. Only the ratios
/// count: one factor makes the areas of all references add up to that of the mesh, since triangles are
/// neither made nor removed.
struct SizeFieldReference {
  std::vector<double> edge_lengths;  ///< per vertex
};
/// The same with a field that follows the curvature (curvature_size_field).
struct CurvatureReference {
  FeatureOptions features;
};
using ReferenceChoice = std::variant<MeanAreaReference, EdgeLengthReference, InitialReference, MeshReference,
                                     SizeFieldReference, CurvatureReference>;

/// The reference triangles that a choice means for these triangles. Throws MeshError when another mesh or a
/// field does not have as many vertices or there is no area, UsageError for an edge length that is not
/// positive.
[[nodiscard]] ReferenceMesh make_reference(const ReferenceChoice& choice, std::span<const Vec3> positions,
                                           std::span<const Triangle> triangles, unsigned threads = 0);

/// The exponent where none is asked for.
inline constexpr double kDefaultExponent = 2;

/// What a run found it must hold, to stay near the surface and keep it from folding or crossing itself.
struct SurfaceHolds {
  std::vector<Index> still;  ///< vertices that stay where they are
  /// In no step does the surface go farther than this from where it is; length units.
  double distance = std::numeric_limits<double>::infinity();
  /// Vertices stay on the local fits of the surface even where these rise far above its triangles.
  bool on_fits = false;
  /// Every step keeps triangles from coming to cross each other, and not only the run as a whole.
  bool apart = false;

  bool operator==(const SurfaceHolds&) const = default;
};

/// What is minimised and what may move.
struct ProblemOptions {
  EnergyWeights weights;
  /// p >= 1 in sum E^p: larger values drive the worst triangles. None: 2; a bounded run takes 1 where squares
  /// lower the mean of the triangles' smallest angles.
  std::optional<double> exponent;
  ReferenceChoice reference = MeanAreaReference{};
  BoundaryRule boundary = BoundaryRule::fixed;
  FeatureOptions features;
  SurfaceRule surface = SurfaceRule::project;
  /// What a run does first about triangles that lie upside down.
  UntangleRule untangle = UntangleRule::automatic;
  /// Vertices that the user holds.
  std::vector<Index> pinned;
  SurfaceHolds holds;
  /// Threads for the set-up and the steps; 0: all the machine has. Results do not depend on it.
  unsigned threads = 0;
};

/// How far a vertex may move: the dimension of its tangent space.
enum class Mobility : std::uint8_t { none, line, plane };

/// The surface as it was, that the mesh has to stay near.
struct NearSurface {
  double distance;              ///< length units
  std::vector<Vec3> positions;  ///< as they were
  /// Its triangles. Where there is a frozen surface they have its numbers, which are the problem's own only
  /// in the copy that smoothers work on.
  std::shared_ptr<const ClosestPointIndex> surface;
  bool on_fits;  ///< SurfaceHolds
};

/// The frozen part of a run: connectivity, references, classes, who may move. Positions come with each step.
struct SmoothingProblem {
  std::vector<Triangle> triangles;
  Topology topology;
  ReferenceMesh reference;
  EnergyWeights weights;
  double exponent = kDefaultExponent;
  VertexClasses classes;
  std::vector<Mobility> mobility;
  std::vector<std::uint16_t>
      fixed_limits;  ///< bits of Limit that hold in every step (pinned, corner, ridge, boundary)
  std::vector<std::uint8_t> treated;  ///< per triangle: takes part in the energy
  /// The two border neighbours of every vertex that slides along the border.
  std::unordered_map<Index, std::array<Index, 2>> border;
  /// The mesh lies in one plane with this unit normal: moves stay in it exactly.
  std::optional<Vec3> plane_normal;
  /// What vertices are brought back to; none for tangent moves and where there is nothing to leave.
  std::shared_ptr<const FrozenSurface> surface;
  /// Where on it each vertex was at the start; its triangles have their own numbers.
  std::vector<SurfaceAnchor> anchors;
  /// What the surface must not go far from; none where nobody asks.
  std::optional<NearSurface> near;
  bool apart = false;  ///< SurfaceHolds
  /// Unit normals of the triangles at the start, on curved surfaces: no triangle turns far from its own.
  std::vector<Vec3> initial_normals;
  /// Of the surroundings of triangles that stand on them: those may lie down.
  std::unordered_map<Index, Vec3> surrounding_normals;
  /// No step makes a triangle worse than these: the worst angles of the treated triangles at the start, or
  /// 120 degrees where none is larger than 100. No limit where areas count more than angles or the reference
  /// is not equilateral.
  WorstAngles worst_angles;
  /// What smoothers number it by, in a copy.
  Renumbering numbering;
  double mean_edge_length = 0;
  unsigned threads = 0;
  /// What was pinned and left out, in words for the user.
  std::vector<std::string> notes;
  /// Where the border is free: the same, but it slides. None where nothing of it would.
  std::shared_ptr<const SmoothingProblem> sliding;

  [[nodiscard]] Index vertex_count() const { return topology.vertex_count(); }
  [[nodiscard]] Index triangle_count() const { return static_cast<Index>(triangles.size()); }
};

/// Freezes a mesh into a problem. Flawed places (non-manifold, inconsistent, degenerate, inverted in a planar
/// mesh) are pinned and named in `notes`. Throws MeshError if nothing can be treated or the reference has
/// another connectivity, UsageError for weights or an exponent out of range or a pinned vertex that does not
/// exist.
SmoothingProblem make_problem(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                              const ProblemOptions& options);

/// Per triangle: whether it takes part and has a vertex that may move.
[[nodiscard]] std::vector<std::uint8_t> movable_triangles(const SmoothingProblem& problem);

/// Holds vertices of a problem that was made from these positions; says so in its notes.
void hold(SmoothingProblem& problem, const SurfaceHolds& holds, std::span<const Vec3> positions);

/// Turns the triangles of a mesh that lie upside down by `untangle`, as far as the options let vertices move:
/// the border stays whatever its rule, so do pinned vertices, flawed places, and the ridges and corners of
/// sound surroundings. On a surface where fewer than one triangle in 200 lies upside down, only where that
/// leaves it by less than a tenth of the longest edge there and 0.02 of the diagonal: others are sharp folds
/// of its own. Does nothing
/// where options.untangle is off. Throws UsageError as make_problem.
UntangleResult untangle_input(std::span<Vec3> positions, std::span<const Triangle> triangles,
                              const ProblemOptions& options);

}  // namespace isorelax
