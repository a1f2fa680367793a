#pragma once

#include <gtest/gtest.h>

#include <string>

#include "compare/image_metrics.h"
#include "render/image.h"

namespace isorelax::test {

/// tests/baselines/NAME.png. Throws InputError when there is none.
render::Image read_baseline(const std::string& name);

/// Whether a picture passes for the accepted one, by the limits of `isorelax compare`. Leaves nothing behind.
bool passes_for_baseline(const render::Image& actual, const std::string& name,
                         const compare::ImageLimits& limits = {});

/// Whether `actual` is the accepted picture, by the limits of `isorelax compare`. If not, or if there is none
/// yet, actual, expected and difference are left in the build folder under image_failures/, and the message
/// says where; tests/support/promote_baselines.sh accepts them.
testing::AssertionResult matches_baseline(const render::Image& actual, const std::string& name,
                                          const compare::ImageLimits& limits = {});

}  // namespace isorelax::test
