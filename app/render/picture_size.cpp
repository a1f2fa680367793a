#include "render/picture_size.h"

#include <cmath>
#include <string>

#include "io/text_in.h"
#include "mesh/error.h"

namespace isorelax::render {
namespace {

/// What OpenGL implementations, OSMesa among them, can still draw into.
constexpr int kLargestSide = 16384;

}  // namespace

PictureSize parse_size(std::string_view text) {
  PictureSize size;
  const std::size_t by = text.find('x');
  if (by == std::string_view::npos || !read_number(text.substr(0, by), size.width) ||
      !read_number(text.substr(by + 1), size.height) || size.width < 1 || size.height < 1)
    throw UsageError("picture size '" + std::string(text) +
                     "' is not WIDTHxHEIGHT in pixels, such as 1280x720");
  if (size.width > kLargestSide || size.height > kLargestSide)
    throw UsageError("picture size '" + std::string(text) + "': no side may be longer than " +
                     std::to_string(kLargestSide) + " pixels");
  return size;
}

Range parse_range(std::string_view text) {
  Range range;
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos || !read_number(text.substr(0, colon), range.low) ||
      !read_number(text.substr(colon + 1), range.high) || !std::isfinite(range.low) ||
      !std::isfinite(range.high) || !(range.low < range.high))
    throw UsageError("range '" + std::string(text) + "' is not LO:HI with LO below HI, such as 0:60");
  return range;
}

}  // namespace isorelax::render
