#pragma once

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
  bool keeps_volume = false;             ///< the field is known to have no divergence
  std::optional<double> period;          ///< everything is back where it was after this time
};

/// Reads a motion from text:
///   paper[:T]  enright[:T]                  T defaults to 3
///   rigid:WX,WY,WZ[@CX,CY,CZ][+VX,VY,VZ]    angular velocity, centre, velocity
///   shear:RATE                              u = RATE y along x
///   normal:EXPRESSION                       speed along the normal, in x, y, z, t
///   expr:U;V;W                              three expressions in x, y, z, t
///   file:PATH                               see read_sampled_field
/// Throws UsageError, InputError.
[[nodiscard]] Motion parse_motion(std::string_view text);

}  // namespace isorelax
