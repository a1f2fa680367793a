#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "surface/normal_covariance.h"

namespace isorelax {

/// What the surface is like at a vertex, and so how many directions its tangent space has.
enum class VertexClass : std::uint8_t {
  smooth,    ///< two: the plane of the covariance's two smaller eigenvectors
  ridge,     ///< one: along the crease, the smallest eigenvector
  corner,    ///< none
  boundary,  ///< on the border of the surface; what it may do is the boundary rule's matter
};

/// Name for people: "smooth", "ridge", "corner", "boundary".
std::string_view to_string(VertexClass c);

/// Thresholds of the classification, all in degrees. Method Sec. 4; defaults are those of face offsetting's
/// own code where it has one.
struct FeatureOptions {
  /// A vertex whose normals spread like those of a crease with at least this dihedral turn is not smooth: the
  /// spread is 2 atan(sqrt(l2 / l1)).
  double ridge_angle_deg = 30;
  /// An edge whose two faces turn by more than this makes both its ends ridge.
  double sharp_edge_deg = 65;
  /// A vertex whose angles miss 2 pi by at least this is a corner, on a crease also where they exceed it.
  double corner_defect_deg = 60;
  /// A ridge that turns by more than this in a vertex has a corner there.
  double turn_deg = 45;
  /// An edge that turns by less than this many times the mean of the smooth edges about it is roughness, not
  /// a crease.
  double over_roughness = 2.5;
  /// A line of fewer crease edges that ends in the middle of a face is no feature, nor one of fewer than
  /// twice as many that does so at both ends, nor a loop of fewer.
  unsigned least_crease_edges = 4;
  /// A boundary that turns by more than this in a vertex has a corner there.
  double boundary_turn_deg = 45;

  /// No ridges and no corners but those of borders.
  static constexpr FeatureOptions none() { return {180, 180, 1e9, 45}; }

  /// Ridges that turn by at least this, with a sharp edge no lower; from 180 on none.
  static constexpr FeatureOptions ridges_from(double degrees) {
    if (!(degrees < 180)) return none();
    FeatureOptions options;
    options.ridge_angle_deg = degrees;
    options.sharp_edge_deg = std::max(options.sharp_edge_deg, degrees);
    return options;
  }
};

/// An edge that is part of a feature, once, by the smaller of the corners opposite to it.
struct FeatureEdge {
  std::array<Index, 2> vertices;
  Corner corner;
};

/// The class of every vertex with the measurements that decided it, so that nothing about it is hidden.
struct VertexClasses {
  std::vector<VertexClass> classes;
  std::vector<Vec3> eigenvalues;         ///< l1 >= l2 >= l3 of the normal covariance, length units squared
  std::vector<double> spread_deg;        ///< 2 atan(sqrt(l2 / l1)), compared with ridge_angle_deg
  std::vector<double> angle_defect_deg;  ///< 2 pi minus the sum of angles (pi at the boundary), compared with
                                         ///< corner_defect_deg
  std::vector<double>
      sharpest_edge_deg;  ///< largest dihedral turn of the incident edges, compared with sharp_edge_deg
  std::vector<double> turn_deg;  ///< turn of the ridge or boundary line in the vertex, of a ridge the smaller
                                 ///< of that to its neighbours and to theirs; 0 where there is none
  /// Degrees between the measurement that decided and its threshold: how far the vertex is from another
  /// class.
  std::vector<double> margin_deg;
  /// The creases, in the order of their corners; none of their ends is smooth.
  std::vector<FeatureEdge> creases;
};

/// Classifies every vertex (paper Sec. 3, method Sec. 4). A vertex in no triangle is a corner.
///
/// Creases are those of find_creases, and the rims of meshed flat faces (inner_shares: as many vertices
/// inside as on the rim, or, where two of them meet, a quarter) that turn by more than 2 degrees, unless
/// nothing is to be a ridge. Boundary vertices are `boundary`, or `corner` where the border turns by more
/// than boundary_turn_deg, where a straight stretch of it ends in a turn however small (so that straight
/// outlines are kept), where a crease runs into it, or where several borders meet. Elsewhere: a corner where
/// the angles miss 2 pi by corner_defect_deg (or exceed it, on a crease; without a crease only where it
/// stands out by a fifth of its edges' mean length, which noise at a short edge does not), where one crease
/// ends, where three or more meet, or where the line of two turns by more than turn_deg, both between the
/// neighbours on it and between theirs: a line that only follows the zigzag of its edges has no corner; or
/// where it comes to a flat face or leaves one (flat_patches), whose rim would slide along with it. A ridge
/// where two creases meet; else smooth.
VertexClasses classify_vertices(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                const Topology& topology, const FeatureOptions& options,
                                unsigned threads = 0);

}  // namespace isorelax
