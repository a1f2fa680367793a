#pragma once

#include "mesh/lanes.h"

namespace isorelax {

/// Angles in degrees, 0 to 180, of eight vectors (x, y) with y >= 0: atan2 to two units in the last place of
/// 180; 0 for (0, 0). The same bits on every machine.
void angles_deg(const Lanes& y, const Lanes& x, Lanes& angles);

/// e to the power of eight numbers that are not positive, to two units in the last place; 0 below -700. The
/// same bits on every machine.
void exp_of_negative(const Lanes& x, Lanes& powers);

}  // namespace isorelax
