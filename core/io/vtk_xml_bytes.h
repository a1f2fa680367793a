#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace isorelax {

/// Bytes as they stand in an XML file, themselves or in base64, taken one stretch after another. Stretches in
/// base64 may be joined or padded each for itself.
class EncodedBytes {
 public:
  enum class Form : std::uint8_t { raw, base64 };
  EncodedBytes(std::string_view text, Form form) : text_(text), form_(form) {}

  /// Appends the next `size` bytes; false where there are not so many.
  [[nodiscard]] bool take(std::uint64_t size, std::string& out);
  /// Bytes of the file looked at so far.
  [[nodiscard]] std::size_t consumed() const { return position_; }

 private:
  bool decode_group();

  std::string_view text_;
  Form form_;
  std::size_t position_ = 0;
  std::string decoded_;  ///< of the last group, and not taken yet
};

/// How binary arrays of a file are laid out: in front of each stand numbers of four or eight bytes.
struct VtkXmlLayout {
  std::endian order = std::endian::little;
  bool wide_header = false;
  bool zlib = false;
};

/// Takes the `size` bytes of one array, which are uncompressed when they come out. Returns why they cannot be
/// had, else an empty text. Sets aside no more than zlib can make of the bytes there are.
[[nodiscard]] std::string take_array(EncodedBytes& source, const VtkXmlLayout& layout, std::uint64_t size,
                                     std::string& out);

}  // namespace isorelax
