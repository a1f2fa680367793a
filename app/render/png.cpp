#include <png.h>

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "io/atomic_file.h"
#include "io/mesh_file.h"
#include "mesh/error.h"
#include "render/image.h"
#include "render/png_chunks.h"

namespace isorelax::render {
namespace {

bool is_opaque(const Image& image) {
  for (std::size_t i = 3; i < image.pixels.size(); i += 4)
    if (image.pixels[i] != 255) return false;
  return true;
}

std::vector<std::uint8_t> without_alpha(const Image& image) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(image.pixels.size() / 4 * 3);
  for (std::size_t i = 0; i < image.pixels.size(); i += 4)
    rgb.insert(rgb.end(), image.pixels.begin() + static_cast<std::ptrdiff_t>(i),
               image.pixels.begin() + static_cast<std::ptrdiff_t>(i) + 3);
  return rgb;
}

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& path) {
  const std::string bytes = read_bytes(path);
  return {bytes.begin(), bytes.end()};
}

/// Says where a file that is no sound picture ends to be one, or else what the library says.
[[noreturn]] void refuse(const std::filesystem::path& path, std::span<const std::uint8_t> bytes,
                         const std::string& reason) {
  const std::vector<PngChunk> sound = split_png(bytes);
  if (sound.empty()) throw InputError(path.string(), "", "is no PNG file");
  if (sound.back().type == "IEND") throw InputError(path.string(), "", reason);
  throw InputError(path.string(), "byte " + std::to_string(join_png(sound).size()),
                   "the picture is damaged or cut short here");
}

png_image header_of(const Image& image, bool opaque) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = opaque ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  return header;
}

/// The same file with texts behind its header.
std::vector<std::uint8_t> with_texts(std::span<const std::uint8_t> bytes, const PictureTexts& texts) {
  std::vector<PngChunk> chunks = split_png(bytes);
  auto at = chunks.begin() + 1;
  for (const auto& [keyword, text] : texts) at = chunks.insert(at, text_chunk(keyword, text)) + 1;
  return join_png(chunks);
}

/// How many frames, and that they go on for ever.
PngChunk animation_control(const Animation& animation) {
  PngChunk chunk{"acTL", {}};
  append_big_endian(chunk.data, static_cast<std::uint32_t>(animation.frames.size()));
  append_big_endian(chunk.data, 0);
  return chunk;
}

/// What comes before a frame: its size, its place, how long it is shown.
PngChunk frame_control(const Image& frame, std::uint32_t sequence, unsigned milliseconds) {
  PngChunk chunk{"fcTL", {}};
  append_big_endian(chunk.data, sequence);
  append_big_endian(chunk.data, static_cast<std::uint32_t>(frame.width));
  append_big_endian(chunk.data, static_cast<std::uint32_t>(frame.height));
  append_big_endian(chunk.data, 0);
  append_big_endian(chunk.data, 0);
  // The delay as a fraction of seconds in two times 16 bits; the frame replaces the one before.
  append_big_endian(chunk.data, (std::min(milliseconds, 65535U) << 16U) | 1000U);
  chunk.data.insert(chunk.data.end(), {0, 0});
  return chunk;
}

/// Image data of a later frame.
PngChunk frame_data(const PngChunk& image_data, std::uint32_t sequence) {
  PngChunk chunk{"fdAT", {}};
  append_big_endian(chunk.data, sequence);
  chunk.data.insert(chunk.data.end(), image_data.data.begin(), image_data.data.end());
  return chunk;
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image, const PictureTexts& texts) {
  const bool opaque = is_opaque(image);
  const std::vector<std::uint8_t> rows = opaque ? without_alpha(image) : image.pixels;
  png_image header = header_of(image, opaque);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::vector<std::uint8_t> bytes(size);
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, rows.data(), 0, nullptr) == 0)
    throw Error(std::string("the picture cannot be encoded: ") + header.message);
  bytes.resize(size);
  return texts.empty() ? bytes : with_texts(bytes, texts);
}

std::vector<std::uint8_t> encode_animated_png(const Animation& animation, const PictureTexts& texts) {
  std::vector<PngChunk> chunks;
  std::uint32_t sequence = 0;
  for (std::size_t i = 0; i < animation.frames.size(); ++i) {
    const bool first = i == 0;
    const bool last = i + 1 == animation.frames.size();
    bool announced = false;
    for (PngChunk& chunk : split_png(encode_png(animation.frames[i], first ? texts : PictureTexts{}))) {
      if (chunk.type == "IDAT") {
        if (!std::exchange(announced, true)) {
          if (first) chunks.push_back(animation_control(animation));
          chunks.push_back(frame_control(animation.frames[i], sequence++,
                                         last ? animation.last_milliseconds : animation.milliseconds));
        }
        if (!first) chunk = frame_data(chunk, sequence++);
        chunks.push_back(std::move(chunk));
      } else if (chunk.type == "IEND" ? last : first) {
        chunks.push_back(std::move(chunk));
      }
    }
  }
  return join_png(chunks);
}

void require_png_name(const std::filesystem::path& path) {
  if (path.extension() != ".png") throw UsageError(path.string() + ": pictures are PNG files, named .png");
}

void write_png(const std::filesystem::path& path, const Image& image, const PictureTexts& texts) {
  const std::vector<std::uint8_t> bytes = encode_png(image, texts);
  write_file_atomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Image read_png(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = bytes_of(path);
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) == 0)
    refuse(path, bytes, header.message);
  header.format = PNG_FORMAT_RGBA;
  Image image(static_cast<int>(header.width), static_cast<int>(header.height));
  if (png_image_finish_read(&header, nullptr, image.pixels.data(), 0, nullptr) == 0)
    refuse(path, bytes, header.message);
  return image;
}

PictureTexts read_png_texts(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = bytes_of(path);
  if (split_png(bytes).empty()) throw InputError(path.string(), "", "is no PNG file");
  return texts_of_png(bytes);
}

}  // namespace isorelax::render
