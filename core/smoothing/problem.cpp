#include "smoothing/problem.h"

#include <algorithm>
#include <cmath>

#include "mesh/error.h"
#include "smoothing/initial_normals.h"
#include "smoothing/outline.h"
#include "smoothing/renumbered_problem.h"
#include "smoothing/sentences.h"
#include "smoothing/size_field.h"
#include "smoothing/step_record.h"
#include "surface/deviation.h"

namespace isorelax {
namespace {

/// A triangle with a doubled area below this share of its longest edge squared has no usable normal.
constexpr double kDegenerate = 1e-12;
/// A mesh within this share of its extent of a plane is planar.
constexpr double kPlanar = 1e-12;

/// A mesh of right triangles, as design programs make them, could hardly move if no angle were to grow: where
/// none is larger than the first of these, all may grow up to the second. Cotangents of 100 and 120 degrees.
constexpr double kRightAngledCot = -0.17632698070846498;
constexpr double kHarmlessCot = -0.57735026918962576;
constexpr double kAngleRounding = 1e-12;

class ProblemBuilder {
 public:
  ProblemBuilder(std::span<const Vec3> positions, const ProblemOptions& options, SmoothingProblem& problem)
      : x_(positions), options_(options), p_(problem) {}

  void build() {
    find_plane();
    choose_treated();
    p_.mobility.assign(p_.vertex_count(), Mobility::plane);
    p_.fixed_limits.assign(p_.vertex_count(), 0);
    for (Index v = 0; v < p_.vertex_count(); ++v) apply_class(v);
    pin_flaws();
    pin_choice();
    note_if_nothing_may_move();
    measure_edges();
    limit_worst_angles();
    freeze_surface();
  }

 private:
  [[nodiscard]] Vec3 area_of(Index t) const {
    const Triangle& v = p_.triangles[t];
    return area_vector(x_[v[0]], x_[v[1]], x_[v[2]]);
  }

  void find_plane() {
    Vec3 sum = Vec3::Zero();
    for (Index t = 0; t < p_.triangle_count(); ++t) sum += area_of(t);
    Vec3 low = Vec3::Constant(INFINITY);
    Vec3 high = -low;
    Vec3 used = Vec3::Zero();
    for (const Triangle& t : p_.triangles) {
      used = x_[t[0]];
      for (const Index v : t) {
        low = low.cwiseMin(x_[v]);
        high = high.cwiseMax(x_[v]);
      }
    }
    const double extent = (high - low).norm();
    if (!(sum.norm() > 1e-6 * extent * extent)) return;
    const Vec3 normal = sum.normalized();
    for (const Triangle& t : p_.triangles) {
      for (const Index v : t) {
        if (std::abs(normal.dot(x_[v] - used)) > kPlanar * extent) return;
      }
    }
    p_.plane_normal = normal;
  }

  void choose_treated() {
    p_.treated.assign(p_.triangle_count(), 1);
    std::vector<Index> degenerate, inverted;
    for (Index t = 0; t < p_.triangle_count(); ++t) {
      const Triangle& v = p_.triangles[t];
      const Vec3 area = area_of(t);
      const double longest =
          std::max({(x_[v[1]] - x_[v[0]]).squaredNorm(), (x_[v[2]] - x_[v[1]]).squaredNorm(),
                    (x_[v[0]] - x_[v[2]]).squaredNorm()});
      if (!(area.norm() > kDegenerate * longest)) {
        degenerate.push_back(t);
      } else if (p_.plane_normal && area.dot(*p_.plane_normal) < 0) {
        inverted.push_back(t);
      }
    }
    leave_out(degenerate, "degenerate");
    leave_out(inverted, "inverted");
    if (std::find(p_.treated.begin(), p_.treated.end(), 1) == p_.treated.end()) {
      throw MeshError("the mesh has no triangle that can be smoothed");
    }
  }

  void leave_out(const std::vector<Index>& triangles, const std::string& kind) {
    for (const Index t : triangles) {
      p_.treated[t] = 0;
      left_out_.push_back(t);
    }
    if (triangles.empty()) return;
    const std::string whose = triangles.size() == 1 ? "it is, its" : "they are, their";
    p_.notes.push_back(counted(triangles.size(), kind + " triangle is", kind + " triangles are") +
                       " left as " + whose + " vertices pinned: " + list_ids(triangles));
  }

  void apply_class(Index v) {
    const auto hold = [&](std::uint16_t limits) {
      p_.mobility[v] = Mobility::none;
      p_.fixed_limits[v] |= limits;
    };
    const bool border = p_.topology.is_boundary(v);
    if (border && options_.boundary == BoundaryRule::fixed) return hold(kLimitBoundary);
    switch (p_.classes.classes[v]) {
      case VertexClass::smooth:
        return;
      case VertexClass::corner:
        return hold(border ? kLimitCorner | kLimitBoundary : kLimitCorner);
      case VertexClass::ridge:
        p_.mobility[v] = Mobility::line;
        p_.fixed_limits[v] |= kLimitRidge;
        return;
      case VertexClass::boundary:
        if (options_.boundary == BoundaryRule::free) return;
        p_.mobility[v] = Mobility::line;
        p_.fixed_limits[v] |= kLimitBoundary;
        p_.border[v] = border_neighbours(v);
        return;
    }
  }

  /// The two far ends of the border edges at a vertex of class `boundary`, which has exactly two.
  [[nodiscard]] std::array<Index, 2> border_neighbours(Index v) const {
    std::array<Index, 2> ends{v, v};
    for (const Corner c : p_.topology.corners_of(v)) {
      const unsigned k = c % 3;
      const Triangle& t = p_.triangles[c / 3];
      if (p_.topology.is_boundary_edge(c - k + next(k))) ends[0] = t[previous(k)];
      if (p_.topology.is_boundary_edge(c - k + previous(k))) ends[1] = t[next(k)];
    }
    return ends;
  }

  void pin(Index v) {
    p_.mobility[v] = Mobility::none;
    p_.fixed_limits[v] |= kLimitPinned;
  }

  void pin_flaws() {
    struct Flaw {
      std::uint8_t flag;
      const char* what;
    };
    for (const Flaw& flaw :
         {Flaw{kNonManifoldVertex, "non-manifold"}, Flaw{kInconsistentVertex, "inconsistently oriented"},
          Flaw{kRepeatedVertex, "twice-named"}, Flaw{kIsolatedVertex, "isolated"}}) {
      std::vector<Index> found;
      for (Index v = 0; v < p_.vertex_count(); ++v) {
        if ((p_.topology.flags(v) & flaw.flag) == 0) continue;
        pin(v);
        found.push_back(v);
      }
      if (found.empty()) continue;
      p_.notes.push_back(counted(found.size(), std::string(flaw.what) + " vertex is",
                                 std::string(flaw.what) + " vertices are") +
                         " pinned: " + list_ids(found));
    }
    for (const Index t : left_out_) {
      for (const Index v : p_.triangles[t]) pin(v);
    }
  }

  void pin_choice() {
    for (const Index v : options_.pinned) {
      if (v >= p_.vertex_count()) {
        throw UsageError("vertex " + std::to_string(v) + " cannot be pinned: the mesh has " +
                         std::to_string(p_.vertex_count()) + " vertices, numbered from 0");
      }
      pin(v);
    }
  }

  void note_if_nothing_may_move() {
    if (std::ranges::any_of(p_.mobility, [](Mobility m) { return m != Mobility::none; })) return;
    const auto held = [&](std::uint16_t limit) {
      return std::ranges::count_if(p_.fixed_limits, [&](std::uint16_t all) { return (all & limit) != 0; });
    };
    std::string text;
    const auto name = [&](std::uint16_t limit, const char* one, const char* many) {
      const auto count = static_cast<std::size_t>(held(limit));
      if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, one, many);
    };
    name(kLimitCorner, "is a corner", "are corners");
    name(kLimitBoundary, "is on the border", "are on the border");
    name(kLimitPinned, "is pinned", "are pinned");
    p_.notes.push_back("no vertex may move: " + text);
  }

  void freeze_surface() {
    if (!p_.plane_normal) {
      InitialNormals normals = initial_normals(x_, p_.triangles, p_.topology, p_.classes);
      p_.initial_normals = std::move(normals.own);
      p_.surrounding_normals = std::move(normals.around);
    }
    // In a plane only vertices that slide along a curved border could leave the surface.
    const bool can_leave = !p_.plane_normal || !p_.border.empty();
    if (options_.surface == SurfaceRule::tangent || !can_leave) return;
    if (p_.numbering.empty()) {
      freeze(x_, p_);
    } else {
      freeze(in_order(p_.numbering.vertices, x_), renumbered(p_));
      p_.anchors = in_order(inverse(p_.numbering.vertices), p_.anchors);
    }
  }

  void freeze(std::span<const Vec3> x, const SmoothingProblem& p) {
    p_.surface = std::make_shared<FrozenSurface>(x, p.triangles, p.topology, p.classes, options_.threads);
    for (Index v = 0; v < p.vertex_count(); ++v) p_.anchors.push_back(p_.surface->anchor(v));
  }

  // Where areas count more than angles, or the reference has angles of its own, worse ones may be asked for.
  void limit_worst_angles() {
    const bool equilateral = !std::holds_alternative<InitialReference>(options_.reference) &&
                             !std::holds_alternative<MeshReference>(options_.reference);
    if (!equilateral || options_.weights.area > options_.weights.shape) return;
    p_.worst_angles = WorstAngles::of(x_, p_.triangles, p_.treated);
    if (p_.worst_angles.largest_cot >= kRightAngledCot) p_.worst_angles.largest_cot = kHarmlessCot;
    // Room for rounding: the worst triangle itself must not depend on how its corners are numbered.
    p_.worst_angles.smallest_cot += kAngleRounding * (1 + std::abs(p_.worst_angles.smallest_cot));
    p_.worst_angles.largest_cot -= kAngleRounding * (1 + std::abs(p_.worst_angles.largest_cot));
  }

  void measure_edges() {
    double sum = 0;
    for (const Triangle& t : p_.triangles) {
      for (unsigned k = 0; k < 3; ++k) sum += (x_[t[next(k)]] - x_[t[k]]).norm();
    }
    p_.mean_edge_length = sum / (3.0 * static_cast<double>(p_.triangles.size()));
  }

  std::span<const Vec3> x_;
  const ProblemOptions& options_;
  SmoothingProblem& p_;
  std::vector<Index> left_out_;
};

/// References for target edge lengths per vertex.
ReferenceMesh field_reference(std::span<const double> edge_lengths, std::span<const Vec3> positions,
                              std::span<const Triangle> triangles) {
  if (edge_lengths.size() != positions.size()) {
    throw MeshError("the size field has " + std::to_string(edge_lengths.size()) + " values, the mesh " +
                    std::to_string(positions.size()) + " vertices");
  }
  for (const double length : edge_lengths) {
    if (!(length > 0) || !std::isfinite(length))
      throw UsageError("the edge lengths of a size field must be positive and finite");
  }
  const double largest = *std::max_element(edge_lengths.begin(), edge_lengths.end());
  std::vector<double> doubled_areas;
  double wanted = 0;
  for (const auto& [a, b, c] : triangles) {
    const double edge =
        (edge_lengths[a] / largest + edge_lengths[b] / largest + edge_lengths[c] / largest) / 3;
    doubled_areas.push_back(edge * edge);
    wanted += doubled_areas.back();
  }
  const double mean = ReferenceMesh::equilateral_mean_area(positions, triangles).d1(0);
  const double factor = mean * static_cast<double>(triangles.size()) / wanted;
  for (double& area : doubled_areas) area *= factor;
  return ReferenceMesh::equilateral_areas(std::move(doubled_areas));
}

}  // namespace

ReferenceMesh make_reference(const ReferenceChoice& choice, std::span<const Vec3> positions,
                             std::span<const Triangle> triangles, unsigned threads) {
  if (const auto* edge = std::get_if<EdgeLengthReference>(&choice)) {
    return ReferenceMesh::equilateral_edge(edge->edge_length, static_cast<Index>(triangles.size()));
  }
  if (std::holds_alternative<InitialReference>(choice)) return ReferenceMesh::of_mesh(positions, triangles);
  if (const auto* mesh = std::get_if<MeshReference>(&choice)) {
    if (mesh->positions.size() != positions.size()) {
      throw MeshError("the reference has " + std::to_string(mesh->positions.size()) + " vertices, the mesh " +
                      std::to_string(positions.size()));
    }
    return ReferenceMesh::of_mesh(mesh->positions, triangles);
  }
  if (const auto* field = std::get_if<SizeFieldReference>(&choice))
    return field_reference(field->edge_lengths, positions, triangles);
  if (const auto* curvature = std::get_if<CurvatureReference>(&choice)) {
    const Topology topology(triangles, static_cast<Index>(positions.size()));
    return field_reference(curvature_size_field(positions, triangles, topology,
                                                {.features = curvature->features, .threads = threads}),
                           positions, triangles);
  }
  return ReferenceMesh::equilateral_mean_area(positions, triangles);
}

namespace {

void check(const ProblemOptions& options) {
  const EnergyWeights& w = options.weights;
  if (!(w.shape >= 0) || !(w.area >= 0) || !(w.shape + w.area > 0) || !std::isfinite(w.shape + w.area)) {
    throw UsageError("the weights must be finite, not negative, and not both zero");
  }
  if (options.exponent && (!(*options.exponent >= 1) || !(*options.exponent <= 64)))
    throw UsageError("the exponent must be from 1 to 64");
  // What is made of the powers of the energies must not leave the range of double.
  constexpr double kLargestWeight = 1e12, kLargestPower = 1e100;
  const double limit =
      std::min(kLargestWeight, std::pow(kLargestPower, 1 / options.exponent.value_or(kDefaultExponent)));
  const double larger = std::max(w.shape, w.area);
  if (larger > limit || larger < 1 / limit) {
    throw UsageError(
        "the larger weight must be from 1e-12 to 1e12, and nearer to 1 with an exponent over 8: only the "
        "ratio of the weights matters");
  }
}

/// SmoothingProblem::sliding, where nothing is held yet.
std::shared_ptr<const SmoothingProblem> make_sliding(std::span<const Vec3> positions,
                                                     std::span<const Triangle> triangles,
                                                     ProblemOptions options) {
  if (options.boundary != BoundaryRule::free) return nullptr;
  options.boundary = BoundaryRule::slide;
  options.holds = {};
  auto problem = std::make_shared<const SmoothingProblem>(make_problem(positions, triangles, options));
  const bool any = std::ranges::any_of(
      problem->border, [&](const auto& one) { return problem->mobility[one.first] != Mobility::none; });
  return any ? problem : nullptr;
}

}  // namespace

SmoothingProblem make_problem(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                              const ProblemOptions& options) {
  check(options);
  if (triangles.empty()) throw MeshError("the mesh has no triangle that can be smoothed");
  Topology topology(triangles, static_cast<Index>(positions.size()));
  VertexClasses classes =
      classify_vertices(positions, triangles, topology, options.features, options.threads);
  SmoothingProblem problem{
      .triangles = {triangles.begin(), triangles.end()},
      .topology = std::move(topology),
      .reference = make_reference(options.reference, positions, triangles, options.threads),
      .weights = options.weights,
      .exponent = options.exponent.value_or(kDefaultExponent),
      .classes = std::move(classes),
      .mobility = {},
      .fixed_limits = {},
      .treated = {},
      .border = {},
      .plane_normal = {},
      .surface = {},
      .anchors = {},
      .near = {},
      .initial_normals = {},
      .surrounding_normals = {},
      .worst_angles = {},
      .numbering = Renumbering(positions, triangles),
      .mean_edge_length = 0,
      .threads = options.threads,
      .notes = {},
      .sliding = make_sliding(positions, triangles, options)};
  const bool field = std::holds_alternative<SizeFieldReference>(options.reference) ||
                     std::holds_alternative<CurvatureReference>(options.reference);
  if (field && options.weights.area == 0) {
    problem.notes.emplace_back(
        "the size field has no effect: areas have no weight (--mu 0 is the default; try --mu 0.9)");
  }
  for (const Index t : problem.reference.replaced()) {
    problem.notes.push_back("triangle " + std::to_string(t) +
                            " of the reference is degenerate: an equilateral one stands in");
  }
  ProblemBuilder(positions, options, problem).build();
  hold(problem, options.holds, positions);
  return problem;
}

std::vector<std::uint8_t> movable_triangles(const SmoothingProblem& problem) {
  std::vector<std::uint8_t> flags = problem.treated;
  for (Index t = 0; t < problem.triangle_count(); ++t) {
    const Triangle& v = problem.triangles[t];
    if (std::all_of(v.begin(), v.end(), [&](Index i) { return problem.mobility[i] == Mobility::none; }))
      flags[t] = 0;
  }
  return flags;
}

void hold(SmoothingProblem& problem, const SurfaceHolds& holds, std::span<const Vec3> positions) {
  if (problem.sliding) {
    auto sliding = std::make_shared<SmoothingProblem>(*problem.sliding);
    hold(*sliding, holds, positions);
    problem.sliding = std::move(sliding);
  }
  for (const Index v : holds.still) {
    problem.mobility[v] = Mobility::none;
    problem.fixed_limits[v] |= kLimitSurface;
  }
  problem.apart = holds.apart;
  // In a plane only a border that moves, and not along straight stretches alone, could leave what the mesh
  // covers.
  bool can_leave = !problem.plane_normal;
  const double rounding = 1e-14 * bounding_diagonal(positions);
  for (Index v = 0; v < problem.vertex_count() && !can_leave; ++v)
    can_leave = changes_outline(problem, positions, v, rounding);
  if (std::isfinite(holds.distance) && can_leave) {
    problem.near = {holds.distance,
                    {positions.begin(), positions.end()},
                    problem.surface ? problem.surface->flat()
                                    : std::make_shared<ClosestPointIndex>(positions, problem.triangles),
                    holds.on_fits};
  }
  if (!holds.still.empty()) {
    problem.notes.push_back(counted(holds.still.size(), "vertex is", "vertices are") +
                            " held, to stay near the surface and keep it from folding or crossing itself: " +
                            list_ids(holds.still));
  }
}

}  // namespace isorelax
