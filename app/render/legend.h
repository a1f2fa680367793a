#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/colormap.h"

namespace isorelax::render {

/// A colour with its meaning.
struct Swatch {
  Color color;
  std::string text;

  friend bool operator==(const Swatch&, const Swatch&) = default;
};

/// What the bar at the right of a picture says. Plain data.
struct Legend {
  std::string title;  ///< UTF-8, "Smallest angle"
  std::string unit;   ///< put behind the title in brackets; may be empty
  Coloring coloring;
  /// Words beside the ends of the bar ("worst", "best"); may be empty.
  std::string low_note;
  std::string high_note;
  /// Swatches for the greys, drawn when such values are in the picture.
  bool shows_below = false;
  bool shows_above = false;
  bool shows_missing = false;
  bool shows_backs = false;  ///< of triangles that lie upside down
  /// Where colours stand for kinds: one row each instead of the bar.
  std::vector<Swatch> kinds;

  friend bool operator==(const Legend&, const Legend&) = default;
};

/// A labelled place on the bar.
struct Tick {
  double position = 0;  ///< 0 at the low end, 1 at the high end
  std::string text;
};

/// Both ends of the range and round numbers (1, 2 or 5 times a power of ten) between them, at most
/// `most` >= 2 in all, lowest first; labels do not stand closer than 0.6 / (most - 1) of the bar.
std::vector<Tick> legend_ticks(const Coloring& coloring, int most);

}  // namespace isorelax::render
