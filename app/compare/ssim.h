#pragma once

#include "compare/planes.h"

namespace isorelax::compare {

/// Structural similarity of every pixel (Wang, Bovik, Sheikh & Simoncelli 2004): Gaussian windows of
/// sigma 1.5 and radius 5, K1 = 0.01, K2 = 0.03, for planes of values from 0 to 255. 1 where both are the
/// same, down to -1.
[[nodiscard]] Plane structural_similarity(const Plane& a, const Plane& b);

}  // namespace isorelax::compare
