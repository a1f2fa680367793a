#pragma once

#include <optional>
#include <string>
#include <vector>

#include "motion/dense_copy.h"
#include "motion/moving_surface.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace isorelax::cli {

class Console;

/// A sphere to start from.
struct SphereStart {
  std::size_t vertices = 5832;
  double radius = 0.15;
  Vec3 centre = Vec3(0.5, 0.75, 0.5);
};
/// N[:RADIUS[:X,Y,Z]]. Throws UsageError.
[[nodiscard]] SphereStart parse_sphere(const std::string& text);
[[nodiscard]] TriangleMesh make_sphere(const SphereStart& sphere);

/// Everything that decides how a surface moves, ready to run.
struct MotionSetup {
  TriangleMesh start;
  std::optional<SphereStart> sphere;  ///< where the start is one
  Motion motion;
  MovingSurfaceOptions options;
  double until = 0;
};

/// The options that decide how a surface moves, as typed. The same words do the same again.
class MotionSpec {
 public:
  MotionSpec() = default;
  MotionSpec(const MotionSpec&) = delete;
  MotionSpec& operator=(const MotionSpec&) = delete;

  /// Declares them. `app` and this live until the set-up.
  void declare(CLI::App& app);
  /// The typed ones as words, for a later run.
  [[nodiscard]] std::vector<std::string> words() const;
  /// Reads files that are named. `input`: the mesh; empty for a sphere. Throws UsageError, InputError.
  [[nodiscard]] MotionSetup set_up(Console& console, const std::string& input) const;

 private:
  [[nodiscard]] MovingSurfaceOptions parse_options(Console& console) const;

  CLI::App* app_ = nullptr;
  std::vector<const CLI::Option*> options_;
  std::string sphere_, field_ = "paper", preset_ = "balanced";
  std::string method_, redistribute_, solver_, reference_ = "initial", volume_;
  double until_ = 0, step_ = 0.01, tolerance_ = 0, mu_ = 0.5, only_below_ = 0;
  unsigned every_ = 1, iterations_ = 0, threads_ = 0;
};

}  // namespace isorelax::cli
