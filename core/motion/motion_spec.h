#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "motion/face_offsetting.h"
#include "motion/velocity_field.h"

namespace isorelax {

/// What moves a surface: a velocity field, or a speed along its normal.
struct Motion {
  std::shared_ptr<const VelocityField> field;  ///< null: `speed` moves it
  NormalSpeed speed;
  std::optional<double> constant_speed;  ///< where the speed is one number
  /// Where a point is after a time, where that is known of the field; a negative time leads back.
  std::function<Vec3(const Vec3& x, double t)> place;
  bool keeps_volume = false;     ///< the field is known to have no divergence
  std::optional<double> period;  ///< everything is back where it was after this time
};

/// What a motion can be; `FieldSpec` holds the numbers of each.
enum class FieldKind : std::uint8_t { paper, enright, rigid, shear, normal, expressions, file };

/// A motion as it is asked for, not yet made: texts may still hold mistakes. Those of the other kinds keep
/// their values, so that nothing typed is lost when another kind is chosen.
struct FieldSpec {
  FieldKind kind = FieldKind::paper;
  double period = 3;           ///< of paper and enright
  RigidMotion rigid;           ///< of rigid
  double rate = 1;             ///< of shear
  std::string speed = "0.05";  ///< of normal: a number or an expression
  std::array<std::string, 3> expressions{"-(y-0.5)", "x-0.5", "0"};
  std::string path;  ///< of file
};

/// Takes the text of a motion apart:
///   paper[:T]  enright[:T]                  T defaults to 3
///   rigid:WX,WY,WZ[@CX,CY,CZ][+VX,VY,VZ]    angular velocity, centre, velocity
///   shear:RATE                              u = RATE y along x
///   normal:EXPRESSION                       speed along the normal, in x, y, z, t
///   expr:U;V;W                              three expressions in x, y, z, t
///   file:PATH                               see read_sampled_field
/// Expressions and files are not looked into. Throws UsageError.
[[nodiscard]] FieldSpec parse_field(std::string_view text, const FieldSpec& others = {});
/// The inverse.
[[nodiscard]] std::string to_text(const FieldSpec& spec);
/// Throws UsageError, InputError.
[[nodiscard]] Motion make_motion(const FieldSpec& spec);
/// Both in one.
[[nodiscard]] Motion parse_motion(std::string_view text);

}  // namespace isorelax
