#include "motion/moving_surface.h"

namespace isorelax {

MovingSurfaceOptions motion_preset(std::string_view name) {
  MovingSurfaceOptions options;
  CarrierRelaxationOptions& carrier = options.carrier;
  // d^3 + d^-3 hardly counts before a triangle is several times too large, and then rules.
  carrier.weights.power = 3;
  carrier.weights.area = 0.001;
  carrier.iterations = 3;
  carrier.ridge_damping = 500;
  if (name == "none") {
    options.redistribution = Redistribution::none;
  } else if (name == "paper") {
    options.redistribution = Redistribution::tangent;
    options.integration = Integration::face_offsetting;
  } else if (name == "accuracy") {
    carrier.weights.area = 0.003;
    carrier.ridge_damping = 5000;
    carrier.height_weight = 300;
    carrier.iterations = 2;
  } else if (name == "balanced") {
    carrier.height_weight = 100;
  } else if (name == "angles") {
    carrier.weights.area = 0.0003;
    carrier.height_weight = 1;
  } else {
    throw UsageError(std::string(name) + ": expected none, paper, accuracy, balanced or angles");
  }
  return options;
}

}  // namespace isorelax
