#include "cli/frames.h"

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <array>
#include <filesystem>

#include "cli/console.h"
#include "io/atomic_file.h"
#include "io/text_out.h"
#include "mesh/error.h"
#include "view/picture.h"

namespace isorelax::cli {
namespace {

namespace fs = std::filesystem;

bool is_animation(const std::string& target) {
  return fs::path(target).extension() == ".png";
}

/// A name that means an animation, of a kind that is not written.
bool is_other_picture(const std::string& target) {
  constexpr std::array kKinds = {".gif", ".apng", ".jpg", ".jpeg", ".webp", ".mp4", ".webm", ".avi", ".mov"};
  return std::ranges::find(kKinds, fs::path(target).extension().string()) != kKinds.end();
}

/// A view from a file, or the default one from a direction.
view::View view_from(const std::string& text) {
  const std::string extension = fs::path(text).extension().string();
  if (extension == ".json" || extension == ".png") return view::read_view(text);
  view::View view;
  view.camera = text;
  view.wire = true;
  return view;
}

std::string numbered(std::size_t number) {
  return "frame_" + zero_padded(number, 4) + ".png";
}

void make_folder(const std::string& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem) throw OutputError(folder, problem.message());
}

}  // namespace

void Frames::declare(CLI::App& app) {
  CLI::Option* const frames = app.add_option("--frames", target_,
                                             "Draw the run: numbered pictures in this folder, or an animated "
                                             "PNG, on one camera and one range")
                                  ->type_name("DIR|FILE.png");
  app.add_option("--every", every_, "A frame every K iterations, the start and the end too (default 1)")
      ->type_name("K")
      ->check(CLI::Range(1U, 1000000U))
      ->needs(frames);
  app.add_option("--view", view_,
                 "How the frames are drawn: a saved view, a picture of isorelax, or a camera")
      ->type_name("FILE|SPEC")
      ->needs(frames);
}

void Frames::start(std::span<const Vec3> positions) {
  if (target_.empty()) return;
  // A mistake in the camera is told now, not after the run.
  if (const view::View view = view_from(view_); const auto* camera = std::get_if<std::string>(&view.camera))
    (void)render::parse_camera(*camera, positions, view.size);
  if (is_animation(target_)) {
    check_writable(target_);
  } else if (is_other_picture(target_)) {
    throw UsageError("--frames " + target_ + ": an animation is a .png; anything else is a folder");
  } else {
    make_folder(target_);
    check_writable(fs::path(target_) / numbered(0));
  }
  frames_ = {{0, {positions.begin(), positions.end()}}};
}

void Frames::take(unsigned iteration, std::span<const Vec3> positions) {
  if (target_.empty()) return;
  while (frames_.back().iteration >= iteration && frames_.size() > 1) frames_.pop_back();
  if (iteration % every_ == 0) frames_.push_back({iteration, {positions.begin(), positions.end()}});
}

void Frames::write(Console& console, const TriangleMesh& mesh, unsigned iterations) const {
  if (target_.empty()) return;
  // The start and the end are shown however many iterations there were.
  std::vector<Frame> frames = frames_;
  if (frames.size() > 1 && frames.back().iteration >= iterations) frames.pop_back();
  if (iterations > 0) frames.push_back({iterations, mesh.positions});
  std::vector<TriangleMesh> meshes(frames.size());
  view::Exhibits all;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    meshes[i].positions = std::move(frames[i].positions);
    meshes[i].triangles = mesh.triangles;
    all.meshes.push_back(&meshes[i]);
  }
  all.against = all.meshes.front();
  view::View fixed = view::resolve(view_from(view_), all, view::Arrangement::one_by_one);
  view::Studio studio;
  render::Animation animation;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    fixed.labels = {"iteration " + std::to_string(frames[i].iteration)};
    const view::Picture picture = studio.draw(fixed, {{&meshes[i]}, all.against});
    if (is_animation(target_))
      animation.frames.push_back(picture.image);
    else
      view::write_picture(fs::path(target_) / numbered(i), picture);
  }
  if (is_animation(target_)) {
    const auto bytes = render::encode_animated_png(animation, view::texts_of(fixed));
    write_file_atomically(target_, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  console.message(target_ + ": " + std::to_string(meshes.size()) + " frames");
}

}  // namespace isorelax::cli
