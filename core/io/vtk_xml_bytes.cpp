#include "io/vtk_xml_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "io/byte_order.h"
#include "io/vtk_numbers.h"

namespace isorelax {
namespace {

/// The six bits that a letter of base64 stands for; 64 for any other byte.
unsigned base64_value(char c) {
  static constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  static const std::string kValues = [] {
    std::string values(256, 64);
    for (std::size_t i = 0; i < kLetters.size(); ++i) {
      values[static_cast<unsigned char>(kLetters[i])] = static_cast<char>(i);
    }
    return values;
  }();
  return static_cast<unsigned char>(kValues[static_cast<unsigned char>(c)]);
}

bool is_xml_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

const std::string kEndsEarly = "its bytes end early or are not encoded as the file says";

std::optional<std::uint64_t> take_number(EncodedBytes& source, const VtkXmlLayout& layout) {
  std::string bytes;
  if (!source.take(layout.wide_header ? 8 : 4, bytes)) {
    return std::nullopt;
  }
  return layout.wide_header ? load_bytes<std::uint64_t>(bytes.data(), layout.order)
                            : load_bytes<std::uint32_t>(bytes.data(), layout.order);
}

std::string size_refusal(std::uint64_t found, std::uint64_t needed) {
  return "it holds " + std::to_string(found) + " bytes where " + std::to_string(needed) + " are needed";
}

struct Blocks {
  std::uint64_t block_size = 0;
  /// Of the last block, where that is not a whole one.
  std::uint64_t last_size = 0;
  std::vector<std::uint64_t> compressed_sizes;

  [[nodiscard]] std::uint64_t size_of_block(std::size_t block) const {
    return block + 1 == compressed_sizes.size() && last_size != 0 ? last_size : block_size;
  }
};

/// Reads what stands before compressed blocks: their number, the size of each when uncompressed, that of the
/// last, and how many bytes each takes.
std::optional<Blocks> take_block_sizes(EncodedBytes& source, const VtkXmlLayout& layout) {
  const auto count = take_number(source, layout);
  const auto block_size = take_number(source, layout);
  const auto last_size = take_number(source, layout);
  if (!count || !block_size || !last_size) {
    return std::nullopt;
  }
  Blocks blocks{*block_size, *last_size, {}};
  for (std::uint64_t i = 0; i < *count; ++i) {
    const auto size = take_number(source, layout);
    if (!size) {
      return std::nullopt;
    }
    blocks.compressed_sizes.push_back(*size);
  }
  return blocks;
}

/// Inflates one block to exactly `size` bytes.
std::string inflate_block(const std::string& compressed, std::uint64_t size, std::string& out) {
  // The densest code of deflate makes 258 bytes of two bits.
  constexpr std::uint64_t kMostPerByte = 1032;
  if (size > capped_product(compressed.size() + 1, kMostPerByte)) {
    return "a block of " + std::to_string(compressed.size()) + " bytes cannot inflate to " +
           std::to_string(size);
  }
  const std::size_t begin = out.size();
  out.resize(begin + size);
  uLongf inflated = size;
  const int status = ::uncompress(reinterpret_cast<Bytef*>(out.data() + begin), &inflated,
                                  reinterpret_cast<const Bytef*>(compressed.data()), compressed.size());
  return status == Z_OK && inflated == size ? "" : "a block of it is not what zlib wrote";
}

std::string take_compressed(EncodedBytes& source, const VtkXmlLayout& layout, std::uint64_t size,
                            std::string& out) {
  const std::optional<Blocks> blocks = take_block_sizes(source, layout);
  if (!blocks) {
    return kEndsEarly;
  }
  const std::size_t count = blocks->compressed_sizes.size();
  const std::uint64_t whole = capped_product(count == 0 ? 0 : count - 1, blocks->block_size);
  const std::uint64_t last = count == 0 ? 0 : blocks->size_of_block(count - 1);
  if (whole > size || size - whole != last) {
    return size_refusal(whole + std::min(last, ~whole), size);
  }
  for (std::size_t i = 0; i < count; ++i) {
    std::string compressed;
    if (!source.take(blocks->compressed_sizes[i], compressed)) {
      return kEndsEarly;
    }
    std::string refusal = inflate_block(compressed, blocks->size_of_block(i), out);
    if (!refusal.empty()) {
      return refusal;
    }
  }
  return "";
}

}  // namespace

bool EncodedBytes::take(std::uint64_t size, std::string& out) {
  // Base64 has fewer bytes than letters.
  if (size > text_.size() - position_ + decoded_.size()) {
    return false;
  }
  if (form_ == Form::raw) {
    out += text_.substr(position_, size);
    position_ += size;
    return true;
  }
  const std::size_t wanted = out.size() + size;
  out.reserve(wanted);
  while (out.size() < wanted) {
    if (decoded_.empty() && !decode_group()) {
      return false;
    }
    const std::size_t part = std::min(decoded_.size(), wanted - out.size());
    out.append(decoded_, 0, part);
    decoded_.erase(0, part);
  }
  return true;
}

/// Decodes four letters to three bytes; to fewer where = stands for the last letters.
bool EncodedBytes::decode_group() {
  unsigned bits = 0;
  unsigned letters = 0;
  unsigned padding = 0;
  while (letters + padding < 4) {
    while (position_ < text_.size() && is_xml_blank(text_[position_])) {
      ++position_;
    }
    if (position_ == text_.size()) {
      return false;
    }
    const char c = text_[position_++];
    if (c == '=') {
      ++padding;
      bits <<= 6U;
      continue;
    }
    const unsigned value = base64_value(c);
    if (value == 64 || padding > 0) {
      return false;
    }
    ++letters;
    bits = bits << 6U | value;
  }
  if (padding > 2) {
    return false;
  }
  for (unsigned k = 0; k < 3 - padding; ++k) {
    decoded_ += static_cast<char>(bits >> (16 - 8 * k) & 0xffU);
  }
  return true;
}

std::string take_array(EncodedBytes& source, const VtkXmlLayout& layout, std::uint64_t size,
                       std::string& out) {
  if (layout.zlib) {
    return take_compressed(source, layout, size, out);
  }
  const std::optional<std::uint64_t> found = take_number(source, layout);
  if (!found) {
    return kEndsEarly;
  }
  if (*found != size) {
    return size_refusal(*found, size);
  }
  return source.take(size, out) ? "" : kEndsEarly;
}

}  // namespace isorelax
