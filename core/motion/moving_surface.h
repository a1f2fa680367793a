#pragma once

#include <memory>
#include <optional>
#include <string>

#include "motion/carrier_relaxation.h"
#include "motion/motion_measure.h"
#include "motion/motion_spec.h"
#include "motion/runge_kutta.h"
#include "motion/volume_balance.h"
#include "smoothing/run.h"

namespace isorelax {

/// How vertices are redistributed between the steps of a motion.
enum class Redistribution : std::uint8_t {
  none,     ///< they go with the flow
  tangent,  ///< moves in tangent planes of the mesh itself: the paper's
  carrier,  ///< moves on the surface that the motion made of the start surface: no error accumulates
};

/// How points go along a velocity field.
enum class Integration : std::uint8_t {
  vertices,         ///< every vertex by Runge and Kutta's method
  face_offsetting,  ///< faces move so, vertices are found where they meet
};

struct MovingSurfaceOptions {
  double step = 0.01;
  /// Largest error of a step estimated by an embedded pair, over the start's bounding-box diagonal; none:
  /// steps are fixed.
  std::optional<double> tolerance;
  Integration integration = Integration::vertices;

  Redistribution redistribution = Redistribution::carrier;
  CarrierRelaxationOptions carrier;
  bool balance_volume = true;                           ///< of the carrier family
  Solver solver = Solver::jacobi;                       ///< of tangent moves
  unsigned iterations = 1;                              ///< of tangent moves
  EnergyWeights weights = EnergyWeights::from_mu(0.5);  ///< of tangent moves
  /// Redistribute after every k-th step.
  unsigned every = 1;
  /// Only about triangles with an angle under this, degrees; 0: everywhere.
  double only_below_deg = 0;
  /// Initial: the start.
  ReferenceChoice reference = InitialReference{};
  unsigned threads = 0;
};

/// Options by name: none, paper, accuracy, balanced, angles. Throws UsageError.
///   none      pure advection
///   paper     as printed: face offsetting, one Jacobi step of Eq. (9) in tangent planes after every step
///   accuracy, balanced, angles   the carrier family, with less and less weight on the shape's finest parts
[[nodiscard]] MovingSurfaceOptions motion_preset(std::string_view name);

/// All that the future of a moving surface depends on, beside its start and its options.
struct MovingState {
  std::size_t step = 0;
  double time = 0;
  double next_step = 0;  ///< length that error control proposes
  std::vector<Vec3> positions;
  std::vector<MaterialPoint> points;  ///< of the carrier family, else empty
};

/// What the last step did.
struct MovingReport {
  double dt = 0;
  unsigned parts = 1;  ///< it was cut into
  RelaxationReport relaxation;
  BalanceReport balance;
  bool redistributed = false;
  /// Of the carrier family: of the surface from the middles of the mesh's edges, and of the vertices from the
  /// surface. Of tangent moves: of the vertices from the mesh before the moves of this step; that gathers
  /// from step to step.
  Distances deviation;
};

/// A mesh that a motion carries, its vertices redistributed on the way. Connectivity never changes.
class MovingSurface {
 public:
  /// Throws MeshError for what cannot be carried: a triangle without area, a vertex in no triangle, another
  /// number of vertices in the reference; UsageError for options out of range.
  MovingSurface(const TriangleMesh& start, Motion motion, const MovingSurfaceOptions& options);

  [[nodiscard]] const MovingState& state() const { return state_; }
  [[nodiscard]] const MovingReport& report() const { return report_; }
  [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }
  [[nodiscard]] const Topology& topology() const { return topology_; }

  /// One step, not beyond `end`. Throws MotionError, which names the time and the vertex; the state is then
  /// the one before. Precondition: state().time < end.
  void advance(double end);

  /// Goes on from a state that a surface with the same start, motion and options was in, with the same result
  /// to the bit. Throws MeshError when it cannot be such a state; the surface is then where it was.
  void restore(const MovingState& state, double end);

 private:
  void check(const TriangleMesh& start) const;
  void make_carrier(const TriangleMesh& start);
  double next_dt(double time, std::size_t step, double proposed, double end) const;
  double move(std::vector<Vec3>& x, double time, double end, std::size_t step, double& proposed);
  double controlled_step(std::span<const Vec3> x, double time, double dt, double end, double& proposed);
  void check_in_reach(std::span<const Vec3> x, double time) const;
  void check_encloses(std::span<const Vec3> x, double time) const;
  void offset_along(std::vector<Vec3>& x, double time, double dt);
  bool choose_held(std::span<const Vec3> positions);
  void redistribute_tangent(std::vector<Vec3>& x);
  void measure_deviation_of(const MovingState& state, std::span<const Vec3> on_surface);
  [[nodiscard]] double wanted_volume() const;

  std::vector<Triangle> triangles_;
  Topology topology_;
  std::vector<Vec3> start_;
  Motion motion_;
  MovingSurfaceOptions options_;
  double diagonal_ = 1;
  double start_volume_ = 0, carrier_volume_ = 0;
  bool closed_ = false;
  MovingState state_;
  MovingReport report_;
  std::optional<RungeKutta> integrator_;
  std::optional<FaceOffsetting> offsetting_;
  std::vector<Vec3> moved_;
  // The carrier family.
  std::unique_ptr<MaterialSurface> material_;
  std::unique_ptr<FlowMap> map_;
  std::unique_ptr<CarrierRelaxation> relaxation_;
  std::unique_ptr<VolumeBalance> balance_;
  std::unique_ptr<EdgeMiddles> middles_;
  std::vector<Vec3> carrier_;
  std::vector<std::uint8_t> always_held_, held_;
};

}  // namespace isorelax
