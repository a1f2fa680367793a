// The real window, once, under a virtual display.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "app/temporary_mesh.h"
#include "render/image.h"

namespace isorelax::window {
namespace {

using render::Image;

bool has_tool(const std::string& name) {
  return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

std::size_t count_color(const Image& image, int red, int green, int blue) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < image.pixels.size(); k += 4)
    if (image.pixels[k] == red && image.pixels[k + 1] == green && image.pixels[k + 2] == blue) ++count;
  return count;
}

std::string in_display(const std::string& command) {
  return "timeout 90 xvfb-run -a -s '-screen 0 1280x720x24' sh -c \"" + command + "\"";
}

void expect_editor(const Image& image) {
  ASSERT_EQ(image.width, 1280);
  ASSERT_EQ(image.height, 720);
  EXPECT_LT(count_color(image, 0, 0, 0), image.pixels.size() / 4 / 10) << "mostly black";
  EXPECT_GT(count_color(image, 242, 140, 79), 3000U) << "the Run button";
  EXPECT_GT(count_color(image, 28, 31, 36), 50000U) << "the panels";
  // The bright end of viridis: the legend.
  std::size_t yellow = 0;
  for (std::size_t k = 0; k < image.pixels.size(); k += 4)
    if (image.pixels[k] > 225 && image.pixels[k + 1] > 210 && image.pixels[k + 2] < 60) ++yellow;
  EXPECT_GT(yellow, 40U);
}

TEST(Window, ShowsTheEditorOnARealDisplayAndStaysWithinIt) {
  if (!has_tool("xvfb-run")) GTEST_SKIP() << "xvfb-run is not installed";
  const test::TemporaryFolder folder;
  const std::string mesh = folder.make_square().string();
  const std::string own = (folder / "own.png").string();
  const std::string program = ISORELAX_PROGRAM;
  const std::string view = "XDG_STATE_HOME=" + folder.path().string() + " " + program + " view " + mesh +
                           " --size 2000x1400 --frames 10 --window-screenshot " + own;
  ASSERT_EQ(std::system(in_display(view).c_str()), 0);
  expect_editor(render::read_png(own));
}

TEST(Window, ItsScaleCanBeChosen) {
  if (!has_tool("xvfb-run")) GTEST_SKIP() << "xvfb-run is not installed";
  const test::TemporaryFolder folder;
  const std::string mesh = folder.make_square().string();
  const std::string own = (folder / "own.png").string();
  const std::string drawn = (folder / "drawn.png").string();
  const std::string program = ISORELAX_PROGRAM;
  const std::string view = "XDG_STATE_HOME=" + folder.path().string() + " " + program + " view " + mesh +
                           " --size 1280x720 --scale 1.5 ";
  ASSERT_EQ(std::system(in_display(view + "--frames 10 --window-screenshot " + own).c_str()), 0);
  ASSERT_EQ(std::system((view + "--screenshot " + drawn + " 2>/dev/null").c_str()), 0);
  EXPECT_TRUE(render::read_png(own) == render::read_png(drawn)) << "as the same without a window";
}

TEST(Window, WhatTheDisplayShowsIsWhatTheProgramDrew) {
  if (!has_tool("xvfb-run") || !has_tool("import")) GTEST_SKIP() << "xvfb-run or import is not installed";
  const test::TemporaryFolder folder;
  const std::string mesh = folder.make_square().string();
  const std::string screen = (folder / "screen.png").string();
  // The display is asked until the accent colour has come up, at most for a minute.
  const std::string command =
      "XDG_STATE_HOME=" + folder.path().string() + " " + ISORELAX_PROGRAM + " view " + mesh +
      " --size 1280x720 & editor=\\$!; for try in 1 2 3 4 5 6 7 8 9 10 11 12; do sleep 3; "
      "import -window root PNG32:" +
      screen + "; convert " + screen +
      " -format %k info: | grep -qE '[0-9]{4}' && break; done; "
      "kill \\$editor; wait \\$editor; true";
  ASSERT_EQ(std::system(in_display(command).c_str()), 0);
  expect_editor(render::read_png(screen));
}

TEST(Window, WithoutADisplayOneLineNamesTheCommandsThatNeedNone) {
  const test::TemporaryFolder folder;
  const std::string text = (folder / "error.txt").string();
  const int status =
      std::system(("env -u DISPLAY -u WAYLAND_DISPLAY " ISORELAX_PROGRAM " view 2>" + text).c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  std::ifstream file(text);
  std::string line;
  std::getline(file, line);
  EXPECT_NE(line.find("isorelax smooth"), std::string::npos) << line;
  EXPECT_FALSE(std::getline(file, line)) << "one line only";
}

}  // namespace
}  // namespace isorelax::window
