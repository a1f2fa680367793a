#include "render/png_chunks.h"

#include <zlib.h>

#include <algorithm>
#include <array>

namespace isorelax::render {
namespace {

constexpr std::array<std::uint8_t, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::size_t kFrame = 12;  // length, type and check sum of a chunk

std::uint32_t read_big_endian(std::span<const std::uint8_t> bytes) {
  return (std::uint32_t{bytes[0]} << 24U) | (std::uint32_t{bytes[1]} << 16U) |
         (std::uint32_t{bytes[2]} << 8U) | bytes[3];
}

std::uint32_t check_sum(std::span<const std::uint8_t> type_and_data) {
  return static_cast<std::uint32_t>(
      crc32(crc32(0, nullptr, 0), type_and_data.data(), static_cast<uInt>(type_and_data.size())));
}

/// Cuts the text before the next zero byte off the front.
std::string take_word(std::span<const std::uint8_t>& rest) {
  const auto zero = std::ranges::find(rest, std::uint8_t{0});
  std::string word(rest.begin(), zero);
  rest = rest.subspan(std::min(rest.size(), word.size() + 1));
  return word;
}

}  // namespace

void append_big_endian(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

std::vector<PngChunk> split_png(std::span<const std::uint8_t> bytes) {
  std::vector<PngChunk> chunks;
  if (bytes.size() < kSignature.size() || !std::ranges::equal(bytes.first(kSignature.size()), kSignature))
    return chunks;
  bytes = bytes.subspan(kSignature.size());
  while (bytes.size() >= kFrame) {
    const std::size_t length = read_big_endian(bytes);
    if (length > bytes.size() - kFrame) break;
    const auto checked = bytes.subspan(4, 4 + length);
    if (check_sum(checked) != read_big_endian(bytes.subspan(8 + length))) break;
    chunks.push_back({std::string(checked.begin(), checked.begin() + 4),
                      std::vector<std::uint8_t>(checked.begin() + 4, checked.end())});
    bytes = bytes.subspan(kFrame + length);
  }
  return chunks;
}

std::vector<std::uint8_t> join_png(std::span<const PngChunk> chunks) {
  std::vector<std::uint8_t> bytes(kSignature.begin(), kSignature.end());
  for (const PngChunk& chunk : chunks) {
    append_big_endian(bytes, static_cast<std::uint32_t>(chunk.data.size()));
    const std::size_t checked = bytes.size();
    bytes.insert(bytes.end(), chunk.type.begin(), chunk.type.end());
    bytes.insert(bytes.end(), chunk.data.begin(), chunk.data.end());
    append_big_endian(bytes, check_sum(std::span(bytes).subspan(checked)));
  }
  return bytes;
}

PngChunk text_chunk(const std::string& keyword, const std::string& text) {
  PngChunk chunk{"iTXt", {keyword.begin(), keyword.end()}};
  // End of the keyword, no compression, no language, no translated keyword.
  chunk.data.insert(chunk.data.end(), {0, 0, 0, 0, 0});
  chunk.data.insert(chunk.data.end(), text.begin(), text.end());
  return chunk;
}

std::map<std::string, std::string> texts_of_png(std::span<const std::uint8_t> bytes) {
  std::map<std::string, std::string> texts;
  for (const PngChunk& chunk : split_png(bytes)) {
    std::span<const std::uint8_t> rest = chunk.data;
    if (chunk.type != "tEXt" && chunk.type != "iTXt") continue;
    const std::string keyword = take_word(rest);
    if (chunk.type == "iTXt") {
      if (rest.size() < 2 || rest[0] != 0) continue;
      rest = rest.subspan(2);
      take_word(rest);
      take_word(rest);
    }
    texts[keyword] = std::string(rest.begin(), rest.end());
  }
  return texts;
}

}  // namespace isorelax::render
