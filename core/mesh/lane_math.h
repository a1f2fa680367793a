#pragma once

#include "mesh/lanes.h"

namespace isorelax {

/// Angles in degrees, 0 to 180, of eight vectors (x, y) with y >= 0: atan2, to 1e-15 of itself below 90, of
/// 180 above; 0 for (0, 0). By arithmetic alone: the same bits with any C library.
void angles_deg(const Lanes& y, const Lanes& x, Lanes& angles);

/// e to the power of eight numbers that are not positive, to 1e-15 of itself; 0 below -700. By arithmetic
/// alone, too.
void exp_of_negative(const Lanes& x, Lanes& powers);

}  // namespace isorelax
