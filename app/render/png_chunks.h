#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace isorelax::render {

/// One chunk of a PNG file: four letters and what they announce.
struct PngChunk {
  std::string type;
  std::vector<std::uint8_t> data;
};

/// The chunks of a PNG file in their order; nothing when the bytes are none, and only the whole chunks of one
/// that is cut off or damaged.
[[nodiscard]] std::vector<PngChunk> split_png(std::span<const std::uint8_t> bytes);
/// A PNG file of these chunks, with lengths and check sums.
[[nodiscard]] std::vector<std::uint8_t> join_png(std::span<const PngChunk> chunks);

/// An iTXt chunk: a keyword of 1 to 79 characters of Latin-1, a text in UTF-8.
[[nodiscard]] PngChunk text_chunk(const std::string& keyword, const std::string& text);
/// All texts of a PNG file by keyword: of tEXt chunks and of uncompressed iTXt chunks.
[[nodiscard]] std::map<std::string, std::string> texts_of_png(std::span<const std::uint8_t> bytes);

/// Four bytes, highest first, as PNG has its numbers.
void append_big_endian(std::vector<std::uint8_t>& bytes, std::uint32_t value);

}  // namespace isorelax::render
