#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "motion/motion_spec.h"
#include "motion/moving_surface.h"

namespace isorelax {

/// A sphere to start from: by default the paper's.
struct SphereStart {
  std::size_t vertices = 5832;
  double radius = 0.15;
  Vec3 centre = Vec3(0.5, 0.75, 0.5);
};
/// N[:RADIUS[:X,Y,Z]]. Throws UsageError.
[[nodiscard]] SphereStart parse_sphere(const std::string& text);
/// The inverse.
[[nodiscard]] std::string to_text(const SphereStart& sphere);
[[nodiscard]] TriangleMesh make_sphere(const SphereStart& sphere);

/// What decides how a surface moves, as it is asked for on the command line and in the editor. What is none
/// is as the preset, or the field, has it.
struct MotionChoices {
  std::optional<SphereStart> sphere;  ///< to start from where there is no mesh
  FieldSpec field;
  std::optional<double> until;  ///< none: the field's period, else 1
  double step = 0.01;
  std::optional<double> tolerance;  ///< as in MovingSurfaceOptions; none: fixed steps
  std::string preset = "balanced";
  std::optional<Integration> method;
  std::optional<Redistribution> redistribute;
  std::optional<Solver> solver;  ///< of tangent moves
  std::optional<double> mu;      ///< of tangent moves
  std::optional<unsigned> iterations;
  std::optional<bool> keep_volume;    ///< of carrier moves
  std::string reference = "initial";  ///< or equilateral, equilateral:EDGE, the name of a mesh
  unsigned every = 1;
  double only_below_deg = 0;
  unsigned threads = 0;
};

/// An option by its name on the command line, without dashes.
struct MotionOption {
  std::string_view name, type, help;
  /// Takes a word over. Throws UsageError, with the option's name.
  void (*read)(const std::string& word, MotionChoices& choices);
  /// The word; empty for what is as by default.
  std::string (*text)(const MotionChoices& choices);
};
[[nodiscard]] std::span<const MotionOption> motion_options();

/// Takes options over: name, value, name, value, ...; names with or without dashes. Throws UsageError.
void read_words(std::span<const std::string> words, MotionChoices& choices);
/// What is not as by default, as words of a command line.
[[nodiscard]] std::vector<std::string> to_words(const MotionChoices& choices);

/// The time at which it ends: as asked for, else the field's period, else 1.
[[nodiscard]] double end_time(const MotionChoices& choices);

/// Everything that decides how a surface moves, ready to run.
struct MotionSetup {
  TriangleMesh start;
  std::optional<SphereStart> sphere;  ///< where the start is one
  Motion motion;
  MovingSurfaceOptions options;
  double until = 0;
};

/// The options alone. Reads the reference's file; what was changed in reading is added to `notes`. Throws
/// UsageError, InputError.
[[nodiscard]] MovingSurfaceOptions motion_options_of(const MotionChoices& choices,
                                                     std::vector<std::string>& notes);
/// Makes the motion and the options; none as `start`: a sphere. Throws as motion_options_of.
[[nodiscard]] MotionSetup set_up_motion(const MotionChoices& choices, std::optional<TriangleMesh> start,
                                        std::vector<std::string>& notes);

/// What triangles ought to look like, from a word: initial, equilateral, equilateral:EDGE, or the name of a
/// mesh with the same vertices. Throws UsageError, InputError.
[[nodiscard]] ReferenceChoice read_reference(const std::string& word, std::vector<std::string>& notes);

}  // namespace isorelax
