#include "cli/motion_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "quality/triangle_metrics.h"
#include "render/offscreen.h"
#include "render/overlay.h"
#include "render/renderer.h"
#include "view/scene.h"

namespace isorelax::cli {

namespace {

/// Directions spread evenly over the sphere (a Fibonacci spiral): a smooth outline is met to 2 % of its
/// radius, less than the margin that pictures leave.
std::vector<Vec3> many_directions() {
  constexpr int kCount = 100;
  std::vector<Vec3> directions(kCount);
  for (int i = 0; i < kCount; ++i) {
    const double z = (2 * i + 1) / static_cast<double>(kCount) - 1;
    const double around = std::numbers::pi * (3 - std::sqrt(5.0)) * i;
    const double radius = std::sqrt(1 - z * z);
    directions[static_cast<std::size_t>(i)] = {radius * std::cos(around), radius * std::sin(around), z};
  }
  return directions;
}

}  // namespace

MotionPictures::MotionPictures(std::string camera, int width, int height)
    : camera_(std::move(camera)), width_(width), height_(height) {
  static_cast<void>(
      render::parse_camera(camera_, std::array<Vec3, 2>{Vec3::Zero(), Vec3::Ones()}, {width_, height_}));
}

void MotionPictures::look_at(const TriangleMesh& mesh) {
  std::vector<double> areas = face_metric(FaceMetric::area, mesh.positions, mesh.triangles);
  if (mean_area_ == 0) {
    for (const double area : areas) mean_area_ += area / static_cast<double>(areas.size());
  }
  // The extremes of a few slivers would leave nothing for the others: 0.5 % at each end may lie outside.
  std::ranges::sort(areas);
  const std::size_t rim = areas.size() / 200;
  low_ = std::min(low_, areas[rim] / mean_area_);
  high_ = std::max(high_, areas[areas.size() - 1 - rim] / mean_area_);
  static const std::vector<Vec3> directions = many_directions();
  if (farthest_.empty()) farthest_.assign(directions.size(), mesh.positions[0]);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    for (const Vec3& x : mesh.positions)
      if (x.dot(directions[i]) > farthest_[i].dot(directions[i])) farthest_[i] = x;
  }
}

render::Image MotionPictures::draw(const TriangleMesh& mesh, const std::string& caption) const {
  std::vector<double> areas = face_metric(FaceMetric::area, mesh.positions, mesh.triangles);
  for (double& area : areas) area /= mean_area_;
  view::View view;
  view.color = view::ColorBy::area;
  view.size = {width_, height_};
  view.points = 1;
  view.wire = true;
  view.background = render::kWhiteBackground;
  // The same on both sides of 1, and never without width.
  constexpr double kLeast = 1.01;
  const double most = std::max({high_, 1 / std::max(low_, 1e-12), kLeast});
  view.range = {view::RangeRule::ends, {1 / most, most}};
  const render::Coloring coloring = view::coloring_of(view, areas);
  view::Subject subject;
  subject.positions = mesh.positions;
  subject.triangles = mesh.triangles;
  subject.values = areas;
  subject.label = caption;
  view::Depiction depiction = view::depict(view, coloring, subject);
  depiction.scene.legend = view::legend_of(view, coloring, areas);
  const render::FitOptions fitting{.right = render::legend_share(depiction.scene, view.size),
                                   .bottom = render::caption_share(depiction.scene, view.size)};
  const auto context = render::OffscreenContext::create(render::ContextKind::osmesa);
  render::Renderer renderer(context->loader());
  renderer.draw(depiction.scene, render::parse_camera(camera_, farthest_, view.size, fitting), view.size);
  return renderer.read_back();
}

render::Image tile(std::span<const render::Image> images, std::size_t columns) {
  const int width = images[0].width;
  const int height = images[0].height;
  const std::size_t rows = (images.size() + columns - 1) / columns;
  render::Image all(width * static_cast<int>(columns), height * static_cast<int>(rows));
  std::ranges::fill(all.pixels, std::uint8_t{255});
  for (std::size_t i = 0; i < images.size(); ++i) {
    const int left = width * static_cast<int>(i % columns);
    const int top = height * static_cast<int>(i / columns);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        std::ranges::copy(images[i].at(x, y), all.at(left + x, top + y).begin());
  }
  return all;
}

}  // namespace isorelax::cli
