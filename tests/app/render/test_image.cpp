#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "mesh/error.h"
#include "render/image.h"
#include "render/picture_size.h"

namespace isorelax::render {
namespace {

namespace fs = std::filesystem;

Image pattern(int width, int height, std::uint8_t alpha) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto p = image.at(x, y);
      p[0] = static_cast<std::uint8_t>(x * 7);
      p[1] = static_cast<std::uint8_t>(y * 11);
      p[2] = static_cast<std::uint8_t>(x * y);
      p[3] = alpha;
    }
  return image;
}

TEST(Png, keeps_every_pixel_with_and_without_alpha) {
  const fs::path path = fs::path(testing::TempDir()) / "isorelax_png_round_trip.png";
  for (const std::uint8_t alpha : {std::uint8_t{255}, std::uint8_t{128}}) {
    const Image image = pattern(33, 17, alpha);
    write_png(path, image);
    EXPECT_EQ(read_png(path), image);
  }
  fs::remove(path);
}

TEST(Png, the_same_image_gives_the_same_bytes) {
  EXPECT_EQ(encode_png(pattern(40, 30, 255)), encode_png(pattern(40, 30, 255)));
}

TEST(Png, unreadable_and_unwritable_files_are_named) {
  EXPECT_THROW(read_png("/nowhere/a.png"), InputError);
  EXPECT_THROW(write_png("/nowhere/a.png", pattern(2, 2, 255)), OutputError);
  const fs::path path = fs::path(testing::TempDir()) / "isorelax_not_a_png.png";
  std::ofstream(path) << "this is no picture";
  EXPECT_THROW(read_png(path), InputError);
  fs::remove(path);
}

TEST(PictureOptions, sizes_and_ranges_are_read_and_nonsense_is_refused) {
  EXPECT_EQ(parse_size("640x480"), (PictureSize{640, 480}));
  EXPECT_EQ(parse_range("-1.5:2e3"), (Range{-1.5, 2000}));
  for (const char* text : {"", "640", "640x", "x480", "0x10", "-5x10", "640x480x2", "6.4x5", "99999999999x1"})
    EXPECT_THROW(parse_size(text), UsageError) << text;
  for (const char* text : {"", "1", "1:", ":1", "2:1", "1:1", "nan:1", "0:inf", "0:1:2"})
    EXPECT_THROW(parse_range(text), UsageError) << text;
}

}  // namespace
}  // namespace isorelax::render
