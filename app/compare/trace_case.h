#pragma once

#include "compare/case.h"

namespace isorelax::compare {

/// Compares two recorded runs: what they were told differently, the first iteration and vertex at which they
/// part to the bit, and how far apart they end, which must be at most `displacement`, over the bounding-box
/// diagonal of the first one's mesh. Other triangles or another number of iterations are a failure. Throws
/// InputError (a trace cannot be read).
[[nodiscard]] Case compare_trace_files(const std::filesystem::path& a, const std::filesystem::path& b,
                                       double displacement);

}  // namespace isorelax::compare
