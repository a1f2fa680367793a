#pragma once

#include <filesystem>

#include "motion/velocity_field.h"

namespace isorelax {

/// Reads a velocity sampled on a regular grid: a text file of VTK's legacy format with DATASET
/// STRUCTURED_POINTS and one VECTORS array of its POINT_DATA. Steady; linear between the points in each
/// coordinate. Outside of the grid there is no velocity: evaluation throws.
/// Throws InputError with the line. Memory is bounded by the size of the file.
std::unique_ptr<VelocityField> read_sampled_field(const std::filesystem::path& path);

}  // namespace isorelax
