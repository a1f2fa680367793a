// Views that leave the editor and come back, and what is compared in it.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "app/editor/editor_fixture.h"
#include "io/mesh_file.h"
#include "view/picture.h"

namespace isorelax::editor {
namespace {

using render::Image;

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

class EditorViews : public EditorTest {
 protected:
  [[nodiscard]] std::string clipboard() {
    ImGui::SetCurrentContext(&editor.interface().context());
    return ImGui::GetClipboardText();
  }
  void set_clipboard(const std::string& text) {
    ImGui::SetCurrentContext(&editor.interface().context());
    ImGui::SetClipboardText(text.c_str());
  }
  void run(unsigned iterations) {
    editor.session().smoothing.iterations = iterations;
    editor.session().smoothing.tolerance = 0;
    press(ui::Key::space);
  }
  /// The picture of the viewport as F12 saves it.
  std::filesystem::path save_picture(const std::string& name) {
    press(ui::Key::f12);
    type(name);
    click("browser-accept");
    return folder / name;
  }
  void compare(ui::CompareMode mode) {
    editor.interface().state().comparison.mode = mode;
    settle();
  }
  void settle() {
    if (editor.interface().state().comparison.mode == ui::CompareMode::blink)
      frames(4);  // it never rests
    else
      EditorTest::settle();
  }
};

TEST_F(EditorViews, ACopiedViewPastedBackRestoresThePixels) {
  open(folder.make_square());
  run(5);
  press(ui::Key::n);
  move_to("viewport");
  const Image before = part("viewport");
  press(ui::Key::c, {.control = true});
  const std::string text = clipboard();
  EXPECT_EQ(view::parse_view(text, "text").meshes,
            std::vector<std::string>{(folder / "square.off").string()});
  press(ui::Key::digit3);
  press(ui::Key::w);
  press(ui::Key::s);
  editor.interface().input().push(ui::WheelTurned{0, 3});
  settle();
  EXPECT_FALSE(part("viewport") == before);
  set_clipboard(text);
  press(ui::Key::v, {.control = true});
  EXPECT_TRUE(part("viewport") == before);
}

TEST_F(EditorViews, APastedViewBringsItsMarkedTriangle) {
  open(folder.make_square());
  press(ui::Key::n);
  press(ui::Key::h);
  press(ui::Key::c, {.control = true});
  const auto marked = view::parse_view(clipboard(), "text").selected;
  ASSERT_TRUE(marked);
  press(ui::Key::escape);
  press(ui::Key::c, {.control = true});
  const std::string without = clipboard();
  EXPECT_FALSE(view::parse_view(without, "text").selected);
  const Image plain = part("viewport");
  view::View view = view::parse_view(without, "text");
  view.selected = marked;
  set_clipboard(view::to_json(view));
  press(ui::Key::v, {.control = true});
  EXPECT_FALSE(part("viewport") == plain);
  press(ui::Key::c, {.control = true});
  EXPECT_EQ(view::parse_view(clipboard(), "text").selected, marked);
}

TEST_F(EditorViews, AMeshThatFacesInwardIsToldSoAndSeenFromOutside) {
  TriangleMesh mesh = generate(ShapeKind::sphere, {});
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  (void)write_mesh(folder / "inward.ply", mesh);
  open(folder / "inward.ply");
  EXPECT_TRUE(std::ranges::any_of(editor.session().notes, [](const std::string& note) {
    return note.find("faces inward") != std::string::npos;
  }));
  model::execute(editor.session(), model::SelectTriangle{0});
  editor.ask(ui::FlyToSelection{});
  const Vec3 eye = render::axes_of(editor.camera()).toward_eye;
  EXPECT_GT(eye.dot(editor.camera().target.normalized()), 0.9);
}

TEST_F(EditorViews, TextThatIsNoViewIsRefusedWithAMessageAndChangesNothing) {
  open(folder.make_square());
  const render::Camera camera = editor.camera();
  set_clipboard(R"({"version": 1, "zoom": 3})");
  press(ui::Key::v, {.control = true});
  EXPECT_EQ(editor.camera(), camera);
  EXPECT_NE(editor.session().messages.back().text.find("key 'zoom': is unknown"), std::string::npos)
      << editor.session().messages.back().text;
}

TEST_F(EditorViews, ASavedPictureIsTheOneThatRenderMakesOfItsViewByteForByte) {
  const auto mesh = folder.make_square();
  open(mesh);
  view::Studio studio;
  context->make_current();
  for (const ui::Key key :
       {ui::Key::digit1, ui::Key::digit2, ui::Key::digit3, ui::Key::digit4, ui::Key::digit5}) {
    press(key);
    const auto saved = save_picture("saved.png");
    const TriangleMesh read = read_mesh(mesh).mesh;
    const view::Picture again = studio.draw(view::read_view(saved), {{&read}});
    view::write_picture(folder / "again.png", again);
    context->make_current();
    EXPECT_TRUE(render::read_png(saved) == again.image);
    EXPECT_EQ(bytes_of(saved), bytes_of(folder / "again.png"));
    std::filesystem::remove(saved);
  }
}

TEST_F(EditorViews, WhatTheSessionHasNoSettingForComesWithAPastedView) {
  open(folder.make_square());
  set_clipboard(R"({"version": 1, "background": "white", "numbers": true, "only_worse_than": 20})");
  press(ui::Key::v, {.control = true});
  keep("pasted_view");
  const Image picture = part("viewport");
  EXPECT_GT(picture.at(picture.width - 3, picture.height - 3)[0], 250);
  press(ui::Key::c, {.control = true});
  const view::View copied = view::parse_view(clipboard(), "text");
  EXPECT_TRUE(copied.numbers);
  EXPECT_EQ(copied.only_worse_than, 20);
}

TEST_F(EditorViews, BeforeAndAfterAreComparedOnOneCamera) {
  open(folder.make_square());
  const Image original = part("viewport");
  run(20);
  const Image current = part("viewport");
  const int middle = current.width / 2;
  const int low = 200;  // below the controls
  const auto same = [&](const Image& a, const Image& b, int x0, int x1) {
    for (int y = low; y < a.height - 60; ++y)
      for (int x = x0; x < x1; ++x)
        if (!std::ranges::equal(a.at(x, y), b.at(x, y))) return false;
    return true;
  };
  compare(ui::CompareMode::split);
  keep("compare_split");
  const Image split = part("viewport");
  EXPECT_TRUE(same(split, original, 0, middle - 10));
  EXPECT_TRUE(same(split, current, middle + 10, current.width));
  // The divider follows the pointer.
  const ui::Rect divider = editor.interface().state().rects.at("divider");
  editor.interface().input().push(ui::PointerMoved{divider.center().x, divider.low.y - 60});
  editor.interface().input().push(ui::ButtonChanged{0, true});
  settle();
  const render::Camera camera = editor.camera();
  editor.interface().input().push(ui::PointerMoved{divider.center().x - 120, divider.low.y - 60});
  settle();
  editor.interface().input().push(ui::ButtonChanged{0, false});
  settle();
  EXPECT_EQ(editor.camera(), camera);
  EXPECT_TRUE(same(part("viewport"), current, middle - 110, current.width));
  EXPECT_TRUE(same(part("viewport"), original, 0, middle - 130));

  compare(ui::CompareMode::blink);
  bool seen[2] = {false, false};
  for (int k = 0; k < 90; ++k) {
    frames(1);
    seen[0] = seen[0] || same(part("viewport"), original, 0, current.width);
    seen[1] = seen[1] || same(part("viewport"), current, 0, current.width);
  }
  EXPECT_TRUE(seen[0] && seen[1]);

  compare(ui::CompareMode::side_by_side);
  keep("compare_side_by_side");
  EXPECT_FALSE(same(part("viewport"), current, 0, middle));
  compare(ui::CompareMode::ghost);
  keep("compare_ghost");
  EXPECT_FALSE(same(part("viewport"), current, 0, current.width));
  compare(ui::CompareMode::change);
  keep("compare_change");
  const Image change = part("viewport");
  EXPECT_FALSE(same(change, current, 0, current.width));
  compare(ui::CompareMode::off);
  EXPECT_TRUE(same(part("viewport"), current, 0, current.width));
}

TEST_F(EditorViews, AChangeIsFromWhatItSaysOrToldToBeNone) {
  open(folder.make_square());
  run(20);
  compare(ui::CompareMode::change);
  const Image from_original = part("viewport");
  click("compare-with");
  click("compare-with/The run beside");
  press(ui::Key::escape);
  const ui::Comparison& comparison = editor.interface().state().comparison;
  EXPECT_EQ(comparison.with, ui::CompareWith::original) << "there is one run";
  (void)folder.make_square(100, "other.off");
  click("compare-file");
  type("other.off");
  click("browser-accept");
  keep("compare_change_refused");
  EXPECT_EQ(comparison.with, ui::CompareWith::original);
  EXPECT_EQ(editor.session().messages.back().text,
            "other.off: has other vertices or triangles than square.off, so there is no change from it");
  click("dismiss");
  EXPECT_TRUE(part("viewport") == from_original);
}

TEST_F(EditorViews, TheMeshStandsClearOfTheWiderLegendOfAChange) {
  open(folder.make_square());
  run(5);
  const render::Camera before = editor.camera();
  compare(ui::CompareMode::change);
  EXPECT_GT(editor.camera().extent, before.extent);
  compare(ui::CompareMode::off);
  EXPECT_EQ(editor.camera(), before);
}

TEST_F(EditorViews, AChangeHasZeroInTheMiddleWhateverRangeIsTyped) {
  open(folder.make_square());
  run(20);
  compare(ui::CompareMode::change);
  const Image change = part("viewport");
  model::ViewSettings settings = editor.session().view;
  settings.range_mode = model::RangeMode::typed;
  editor.act(model::SetView{settings});
  settle();
  EXPECT_TRUE(part("viewport") == change);
}

TEST_F(EditorViews, NothingWaitsForABlinkToEnd) {
  open(folder.make_square());
  compare(ui::CompareMode::blink);
  frames(4);
  EXPECT_TRUE(editor.has_settled());
  EXPECT_TRUE(editor.is_restless()) << "a window goes on drawing it";
}

/// Bytes of memory that the program holds.
std::size_t resident() {
  std::ifstream file("/proc/self/statm");
  std::size_t whole = 0;
  std::size_t pages = 0;
  file >> whole >> pages;
  return pages * 4096;
}

TEST_F(EditorViews, FramesThatNobodyLooksAtLeaveNothingBehind) {
  open(folder.make_square());
  frames(20);
  const std::size_t before = resident();
  frames(300);
  EXPECT_LT(resident(), before + (std::size_t{150} << 20U)) << "it was 490 MB where nothing was flushed";
}

TEST_F(EditorViews, ASplitShowsWhatIsFlownToBesideItsDivider) {
  open(folder.make_square());
  run(3);
  compare(ui::CompareMode::split);
  press(ui::Key::n);
  ASSERT_TRUE(editor.session().selected_triangle);
  const auto& t = editor.session().document->mesh().triangles[*editor.session().selected_triangle];
  const auto x = editor.session().current->positions();
  const Vec3 middle = (x[t[0]] + x[t[1]] + x[t[2]]) / 3;
  const render::Camera& camera = editor.camera();
  const double right = (middle - camera.target).dot(render::axes_of(camera).right) / camera.extent;
  EXPECT_GT(right, 0.2) << "of the shorter side, from the middle";
}

TEST_F(EditorViews, PanesBeginUnderTheControlsOfTheComparison) {
  open(folder.make_square());
  run(3);
  compare(ui::CompareMode::side_by_side);
  const auto& rects = editor.interface().state().rects;
  EXPECT_GE(rects.at("pane-legend").low.y, rects.at("compare-bar").high.y - 1);
}

TEST(Partner, ASecondFileIsNotKeptWaitingForTheFirst) {
  const test::TemporaryFolder folder;
  const std::filesystem::path large = folder.make_square(60000, "large.off");
  const std::filesystem::path small = folder.make_square();
  const auto now = [] { return std::chrono::steady_clock::now(); };
  Partner partner;
  ui::Comparison comparison;
  const auto take_over = [&] {
    std::optional<model::Message> news;
    while (!news) news = partner.take_over(comparison);
  };
  const auto begin = now();
  partner.read(large);
  take_over();
  const auto whole = now() - begin;
  partner.read(large);
  const auto again = now();
  partner.read(small);
  EXPECT_LT(now() - again, whole / 2);
  take_over();
  EXPECT_EQ(comparison.file, "square.off");
}

TEST_F(EditorViews, CardsLeaveNamesOfPicturesAndEachOtherAlone) {
  const auto& rects = editor.interface().state().rects;
  const auto apart = [&](const std::string& a, const std::string& b) {
    const ui::Rect& p = rects.at(a);
    const ui::Rect& q = rects.at(b);
    return p.high.x <= q.low.x || q.high.x <= p.low.x || p.high.y <= q.low.y || q.high.y <= p.low.y;
  };
  open(folder.make_square());
  editor.interface().state().comparison.mode = ui::CompareMode::split;
  model::execute(editor.session(), model::SelectTriangle{7});
  settle();
  ASSERT_TRUE(rects.contains("selection"));
  EXPECT_TRUE(apart("selection", "name/Original"));
  EXPECT_TRUE(apart("selection", "name/Current"));
  keep("cards_split");
  model::execute(editor.session(), model::OpenSphere{{.vertices = 200}});
  model::finish(editor.session());
  model::execute(editor.session(), model::Move{1});
  model::finish(editor.session());
  editor.interface().state().comparison.mode = ui::CompareMode::side_by_side;
  model::execute(editor.session(), model::SelectTriangle{7});
  settle();
  for (const char* name : {"selection", "name/Original", "name/Current"})
    EXPECT_TRUE(apart("moment", name)) << name;
  keep("cards_moving");
}

TEST_F(EditorViews, ANoticeLeavesTheLegendsTitleAlone) {
  open(folder.make_square());
  const auto& rects = editor.interface().state().rects;
  const auto legend_text = [&](float top) {
    const ui::Rect view = rects.at("viewport");
    const Image image = part("viewport");
    std::size_t light = 0;
    for (int y = static_cast<int>(std::max(0.0F, top - view.low.y)); y < image.height; ++y)
      for (int x = image.width - static_cast<int>(ui::kLegendStrip); x < image.width; ++x)
        if (std::ranges::min(image.at(x, y).subspan(0, 3)) > 150) ++light;
    return light;
  };
  const std::size_t whole = legend_text(rects.at("compare-bar").high.y);
  std::string text;
  for (int k = 0; k < 20; ++k) text += "something long ";
  model::execute(editor.session(), model::Say{{model::MessageKind::warning, text}});
  settle();
  ASSERT_TRUE(rects.contains("notice"));
  ASSERT_GT(rects.at("notice").high.x, rects.at("viewport").high.x - ui::kLegendStrip);
  EXPECT_NEAR(static_cast<double>(legend_text(rects.at("notice").high.y)), static_cast<double>(whole),
              0.05 * static_cast<double>(whole));
  keep("notice_and_legend");
}

TEST_F(EditorViews, ASavedPictureShowsRunsBesideEachOther) {
  open(folder.make_square());
  editor.session().smoothing.iterations = 3;
  model::execute(editor.session(), model::Teach{});
  model::finish(editor.session());
  settle();
  ASSERT_EQ(editor.session().other_states.size(), 2U);
  editor.ask(ui::SavePicture{folder / "beside.png"});
  const Image saved = render::read_png(folder / "beside.png");
  settle();
  const Image shown = part("pictures");
  ASSERT_EQ(saved.width, shown.width);
  ASSERT_EQ(saved.height, shown.height);
  // The edges of names may be rounded otherwise at another place.
  for (int y = 120; y < shown.height; ++y)
    for (int x = 0; x < shown.width; ++x)
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_NEAR(saved.at(x, y)[k], shown.at(x, y)[k], 3) << x << ", " << y;
}

TEST_F(EditorViews, ASavedPictureShowsTheComparisonAsTheViewportDoes) {
  open(folder.make_square());
  run(5);
  for (const ui::CompareMode mode :
       {ui::CompareMode::split, ui::CompareMode::side_by_side, ui::CompareMode::ghost}) {
    compare(mode);
    const auto path = folder / "compared.png";
    editor.ask(ui::SavePicture{path});
    const Image saved = render::read_png(path);
    settle();
    const Image shown = part("pictures");
    ASSERT_EQ(saved.width, shown.width);
    ASSERT_EQ(saved.height, shown.height);
    // All below the controls.
    for (int y = 120; y < shown.height; ++y)
      for (int x = 0; x < shown.width; ++x)
        ASSERT_TRUE(std::ranges::equal(saved.at(x, y), shown.at(x, y))) << x << ", " << y;
  }
}

TEST_F(EditorViews, AnotherNumberOfPanesIsFramedAgainUnlessTheCameraWasMoved) {
  open(folder.make_square());
  const render::Camera whole = editor.camera();
  compare(ui::CompareMode::side_by_side);
  EXPECT_NE(editor.camera(), whole) << "half the room";
  compare(ui::CompareMode::ghost);
  EXPECT_EQ(editor.camera(), whole);
  compare(ui::CompareMode::split);
  EXPECT_EQ(editor.camera(), whole) << "the same room";
  editor.ask(ui::PanView{30, 0});
  const render::Camera moved = editor.camera();
  compare(ui::CompareMode::side_by_side);
  EXPECT_EQ(editor.camera(), moved);
}

TEST_F(EditorViews, StandardViewsAreThoseOfRender) {
  (void)write_mesh(folder / "ball.ply", generate(ShapeKind::part, {}));
  open(folder / "ball.ply");
  constexpr std::array kKeys{ui::Key::digit1, ui::Key::digit2, ui::Key::digit3, ui::Key::digit4,
                             ui::Key::digit5, ui::Key::digit6, ui::Key::digit7};
  constexpr std::array<const char*, 7> kViews{"front", "back", "left", "right", "top", "bottom", "iso"};
  for (std::size_t k = 0; k < kKeys.size(); ++k) {
    press(kKeys.at(k), {.control = true});
    const render::Camera pressed = editor.camera();
    editor.look(kViews.at(k));
    EXPECT_EQ(pressed, editor.camera()) << kViews.at(k);
  }
}

TEST_F(EditorViews, AFramedMeshIsClearOfTheControls) {
  open(folder.make_square());
  const auto& rects = editor.interface().state().rects;
  const ui::Rect viewport = rects.at("viewport");
  ASSERT_LT(viewport.height(), viewport.width());
  // Of the unit square, seen from above.
  const double pixels_per_length = viewport.height() / editor.camera().extent;
  const double top = viewport.center().y - (1 - editor.camera().target.y()) * pixels_per_length;
  EXPECT_GT(top, rects.at("compare-bar").high.y);
}

TEST_F(EditorViews, ANoticeLeavesTheControlsOfTheComparisonFree) {
  std::ofstream(folder / "flawed.off")
      << "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 3 2\n3 0 0 1\n";
  open(folder / "flawed.off");
  const auto& rects = editor.interface().state().rects;
  ASSERT_TRUE(rects.contains("notice"));
  EXPECT_GE(rects.at("notice").low.y, rects.at("compare-bar").high.y);
}

TEST_F(EditorViews, SideBySideOneLegendStandsBesideBothMeshes) {
  open(folder.make_square());
  EXPECT_FALSE(editor.interface().state().rects.contains("pane-legend"));
  compare(ui::CompareMode::side_by_side);
  keep("compare_side_by_side_legend");
  EXPECT_TRUE(editor.interface().state().rects.contains("pane-legend"));
  const Image viewport = part("viewport");
  const int pane = (viewport.width - static_cast<int>(ui::kLegendStrip)) / 2;
  // Both panes are the same picture: nothing has been run.
  for (int y = 200; y < viewport.height - 60; ++y)
    for (int x = 0; x < pane; ++x)
      ASSERT_TRUE(std::ranges::equal(viewport.at(x, y), viewport.at(pane + x, y))) << x << ", " << y;
}

TEST_F(EditorViews, ARememberedStateOrAnotherFileCanBeTheOther) {
  open(folder.make_square());
  run(3);
  compare(ui::CompareMode::split);
  const Image with_original = part("viewport");
  click("remember");
  EXPECT_EQ(editor.interface().state().comparison.remembered, "Iteration 3");
  EXPECT_FALSE(part("viewport") == with_original);
  run(10);
  const Image with_third = part("viewport");
  (void)folder.make_square(100, "other.off");
  click("compare-file");
  type("other.off");
  click("browser-accept");
  EXPECT_EQ(editor.interface().state().comparison.file, "other.off");
  EXPECT_FALSE(part("viewport") == with_third);
  keep("compare_file");
  (void)folder.make_square(200, "third.off");
  open(folder / "third.off");
  EXPECT_FALSE(editor.interface().state().comparison.remembers) << "of another document";
}

}  // namespace
}  // namespace isorelax::editor
