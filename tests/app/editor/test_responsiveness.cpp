// The interface thread never waits for the worker, however large the mesh.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <string>
#include <thread>

#include "app/temporary_mesh.h"
#include "editor/editor.h"
#include "render/offscreen.h"

namespace isorelax::editor {
namespace {

std::size_t triangle_count() {
  const char* wanted = std::getenv("ISORELAX_RESPONSIVENESS_TRIANGLES");
  return wanted != nullptr ? std::stoul(wanted) : 100000;
}

TEST(Responsiveness, NoFrameWaitsForLoadingSmoothingMovingOrSaving) {
  const test::TemporaryFolder folder;
  GenerateOptions options;
  options.triangles = triangle_count();
  const auto path = folder / "sphere.ply";
  (void)write_mesh(path, generate(ShapeKind::sphere, options));

  const auto context = render::OffscreenContext::create(render::ContextKind::osmesa);
  Editor editor(context->loader(), Motion::instant);
  double time = 0;
  const auto work_through = [&](const char* what, const auto& done) {
    double thinking = 0;
    double drawing = 0;
    unsigned frames = 0;
    const auto start = std::chrono::steady_clock::now();
    do {
      editor.frame({.size = {1280, 720}, .scale = 1, .time = time += 0.02});
      thinking = std::max(thinking, editor.times().thinking);
      drawing = std::max(drawing, editor.times().drawing);
      ++frames;
      // As fast as a display: frames that nobody waits for would only pile up in the software renderer's
      // queue.
      std::this_thread::sleep_for(std::chrono::milliseconds(16));
    } while (!done());
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::cout << what << ": " << frames << " frames in " << seconds.count() << " s, longest without drawing "
              << 1e3 * thinking << " ms, longest drawing " << 1e3 * drawing << " ms\n";
    // A busy machine may take the processor away; waiting for the worker would take far longer at this size.
    EXPECT_LT(thinking, 0.25) << what;
  };

  model::Session& session = editor.session();
  const auto idle = [&] { return session.activity == model::Activity::idle && !session.engine.busy(); };
  model::execute(session, model::OpenFile{path});
  work_through("open", idle);
  ASSERT_TRUE(session.current);
  model::SmoothingSettings settings = session.smoothing;
  settings.mu_a = 0.5;
  settings.iterations = 4;
  settings.tolerance = 0;
  model::execute(session, model::SetSmoothing{settings, "Settings"});
  work_through("settings", idle);
  model::execute(session, model::Run{});
  work_through("run", idle);
  EXPECT_EQ(session.current->iteration, 4U);
  model::execute(session, model::SelectNextWorst{});
  model::execute(session, model::Reset{});
  work_through("reset", idle);
  model::execute(session, model::Undo{});
  work_through("undo", idle);
  model::execute(session, model::SaveFile{folder / "saved.ply"});
  work_through("save", idle);
  EXPECT_FALSE(session.has_unsaved_changes());
  MotionChoices motion;
  read_words(std::array<std::string, 6>{"field", "shear", "step", "0.5", "preset", "none"}, motion);
  model::execute(session, model::SetMotion{motion, "Motion"});
  model::execute(session, model::Move{});
  work_through("move", idle);
  ASSERT_NE(session.moving(), nullptr);
  EXPECT_EQ(session.moment().time, 1);
  model::execute(session, model::Seek{session.current->iteration - 1, {}});
  work_through("seek", idle);
}

}  // namespace
}  // namespace isorelax::editor
