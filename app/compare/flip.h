#pragma once

#include <vector>

#include "render/image.h"

namespace isorelax::compare {

/// Pixels per degree of the observer that FLIP is made for: a 0.7 m wide screen of 3840 pixels seen from 0.7
/// m.
inline constexpr double kPixelsPerDegree = 67.0206;

/// Perceptual difference of every pixel after FLIP (Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom &
/// Fairchild, "FLIP: A Difference Evaluator for Alternating Images", 2020, the version for pictures of low
/// dynamic range): what someone sees who flips between the two, from 0, nothing, to 1. Colours are blurred as
/// the eye does at this distance and compared in a uniform colour space (HyAB in Hunt-adjusted L*a*b*);
/// differing edges and points make a difference count more. Precondition: one size; alpha is ignored.
[[nodiscard]] std::vector<float> flip_difference(const render::Image& a, const render::Image& b,
                                                 double pixels_per_degree = kPixelsPerDegree);

}  // namespace isorelax::compare
