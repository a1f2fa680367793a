// Folders of pictures, the page and JUnit's file.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "app/temporary_mesh.h"
#include "compare/case.h"
#include "compare/markup.h"
#include "mesh/error.h"
#include "view/view.h"

namespace isorelax::compare {
namespace {

namespace fs = std::filesystem;

render::Image picture(std::uint8_t value, int side = 32) {
  render::Image image(side, side);
  std::ranges::fill(image.pixels, value);
  for (std::size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = 255;
  return image;
}

class FolderTest : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"a", "b/below", "a/below"}) fs::create_directories(folder_ / name);
    write_png(folder_ / "a/same.png", picture(90));
    write_png(folder_ / "b/same.png", picture(90));
    write_png(folder_ / "a/below/other.png", picture(90));
    write_png(folder_ / "b/below/other.png", picture(30));
    write_png(folder_ / "a/missing.png", picture(10));
    write_png(folder_ / "b/extra.png", picture(10));
    write_png(folder_ / "a/size.png", picture(10, 8));
    write_png(folder_ / "b/size.png", picture(10, 9));
    write_png(folder_ / "a/broken.png", picture(10));
    std::ofstream(folder_ / "b/broken.png") << "no picture";
    std::ofstream(folder_ / "a/notes.txt") << "not looked at";
  }
  [[nodiscard]] std::vector<Case> compare(Detail detail = Detail::figures) const {
    return compare_folders(folder_ / "a", folder_ / "b", {}, detail);
  }
  test::TemporaryFolder folder_;
};

TEST_F(FolderTest, pictures_are_compared_by_name_and_missing_and_extra_ones_fail) {
  std::vector<std::string> found;
  for (const Case& one : compare()) found.push_back(one.name + (one.passes() ? " passes" : " fails"));
  EXPECT_EQ(found, (std::vector<std::string>{"below/other.png fails", "broken.png fails", "extra.png fails",
                                             "missing.png fails", "same.png passes", "size.png fails"}));
  const std::vector<Case> cases = compare();
  EXPECT_NE(cases[1].failure.find("broken.png"), std::string::npos) << cases[1].failure;
  EXPECT_EQ(cases[2].failure.rfind("extra", 0), 0U);
  EXPECT_EQ(cases[3].failure.rfind("missing", 0), 0U);
  EXPECT_NE(cases[5].failure.find("8x8 and 9x9"), std::string::npos) << cases[5].failure;
}

TEST_F(FolderTest, folders_without_pictures_and_no_folders_are_refused) {
  const test::TemporaryFolder& folder = folder_;
  fs::create_directories(folder / "empty");
  EXPECT_THROW((void)compare_folders(folder / "empty", folder / "empty", {}, Detail::figures), UsageError);
  EXPECT_THROW((void)compare_folders(folder / "nowhere", folder / "b", {}, Detail::figures), InputError);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST_F(FolderTest, the_page_holds_every_case_with_its_pictures_and_loads_nothing) {
  const std::string page = html_page("title", compare(Detail::pictures));
  EXPECT_EQ(count(page, "<section"), 6U);
  // Two with three pictures, two with one; those that could not be read have none.
  EXPECT_EQ(count(page, "src=\"data:image/png;base64,"), 8U);
  EXPECT_EQ(count(page, " src="), count(page, " src=\"data:"));
  EXPECT_EQ(count(page, "http://") + count(page, "https://") + count(page, "<link"), 0U);
  EXPECT_NE(page.find("1 of 6 comparisons pass"), std::string::npos);
  // All but slider and blink is there before any script runs.
  EXPECT_EQ(count(page, "hidden><div class=\"bar\">"), 2U);
}

TEST_F(FolderTest, junit_counts_and_names_failures) {
  const std::string xml = junit_xml(compare());
  EXPECT_NE(xml.find("tests=\"6\" failures=\"5\""), std::string::npos) << xml;
  EXPECT_EQ(count(xml, "<testcase "), 6U);
  EXPECT_EQ(count(xml, "<failure "), 5U);
  EXPECT_NE(xml.find("name=\"same.png\"/>"), std::string::npos);
}

TEST(PictureCase, carries_both_views_into_the_page) {
  const test::TemporaryFolder folder;
  write_png(folder / "a.png", picture(5), {{view::kViewKeyword, "{\"version\": 1, \"wire\": true}"}});
  write_png(folder / "b.png", picture(5));
  const Case one = compare_picture_files(folder / "a.png", folder / "b.png", {}, Detail::pictures);
  EXPECT_EQ(one.view_a, "{\"version\": 1, \"wire\": true}");
  EXPECT_EQ(one.view_b, "");
  EXPECT_NE(html_page("t", {one}).find("&quot;wire&quot;: true"), std::string::npos);
}

TEST(Markup, cannot_be_left_by_a_name) {
  EXPECT_EQ(escaped("<script>\"x\" & 'y'\x01"), "&lt;script&gt;&quot;x&quot; &amp; &#39;y&#39;\xEF\xBF\xBD");
  Case one;
  one.name = "</h2><script>alert(1)</script>";
  one.failure = "]]> \" onload=x";
  const std::string page = html_page(one.name, {one});
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_EQ(junit_xml({one}).find("<script>"), std::string::npos);
}

TEST(Markup, base64_is_that_of_the_standard) {
  const auto encode = [](const std::string& text) {
    return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  EXPECT_EQ(encode(""), "");
  EXPECT_EQ(encode("f"), "Zg==");
  EXPECT_EQ(encode("fo"), "Zm8=");
  EXPECT_EQ(encode("foo"), "Zm9v");
  EXPECT_EQ(encode("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace isorelax::compare
