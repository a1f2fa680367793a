#pragma once

#include <vector>

#include "render/camera.h"
#include "render/image.h"
#include "render/scene.h"

namespace isorelax::render {

/// A bitmap to be laid over the picture, colours multiplied by alpha; its upper left corner in pixels.
struct Overlay {
  Image bitmap;
  int left = 0;
  int top = 0;
};

/// Pixels per point for a scene in a picture.
double pixels_per_point(const Scene& scene, PictureSize size);

/// The legend, the caption, the key of the markers and the notes of a scene.
std::vector<Overlay> make_overlays(const Scene& scene, PictureSize size);

/// Share of the picture's height that the legend takes from the right side; 0 without one.
double legend_share(const Scene& scene, PictureSize size);
/// The same of the strip at the bottom in which the caption stands; 0 without one.
double caption_share(const Scene& scene, PictureSize size);

}  // namespace isorelax::render
