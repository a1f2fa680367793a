#include "io/vtk_names.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>

namespace isorelax {
namespace {

/// Bytes of the UTF-8 character that begins the text; 0 where none does.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const auto follows = [&](std::size_t i) { return i < text.size() && (byte(i) & 0xc0U) == 0x80U; };
  if (byte(0) < 0x80U) {
    return 1;
  }
  if (byte(0) >= 0xc2U && byte(0) < 0xe0U) {
    return follows(1) ? 2 : 0;
  }
  if (byte(0) >= 0xe0U && byte(0) < 0xf0U && follows(1) && follows(2)) {
    const unsigned code = (byte(0) & 0x0fU) << 12U | (byte(1) & 0x3fU) << 6U | (byte(2) & 0x3fU);
    return code >= 0x800U && (code < 0xd800U || code >= 0xe000U) && code < 0xfffeU ? 3 : 0;
  }
  if (byte(0) >= 0xf0U && byte(0) < 0xf5U && follows(1) && follows(2) && follows(3)) {
    const unsigned high = (byte(0) & 0x07U) << 6U | (byte(1) & 0x3fU);
    return high >= 0x10U && high < 0x110U ? 4 : 0;
  }
  return 0;
}

}  // namespace

std::string vtk_lower_case(std::string_view word) {
  std::string lower(word);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

bool is_default_vtk_title(std::string_view title) {
  const std::string lower = vtk_lower_case(title);
  return lower.empty() || lower == "vtk output" || lower == "vtk file" || lower.starts_with("written by ");
}

std::string decode_vtk_name(std::string_view word) {
  std::string name;
  for (std::size_t i = 0; i < word.size(); ++i) {
    unsigned char code = 0;
    const char* const end = word.data() + std::min(i + 3, word.size());
    if (word[i] == '%' && i + 2 < word.size() &&
        std::from_chars(word.data() + i + 1, end, code, 16).ptr == end) {
      name += static_cast<char>(code);
      i += 2;
    } else {
      name += word[i];
    }
  }
  return name;
}

std::string encode_vtk_name(std::string_view name) {
  static constexpr std::string_view kDigits = "0123456789ABCDEF";
  // A whole block of a file is called METADATA; no array may be.
  const bool reserved = vtk_lower_case(name) == "metadata";
  std::string word;
  for (const char c : name) {
    const auto code = static_cast<unsigned char>(c);
    if (code > 32 && code < 127 && c != '"' && c != '%' && !(reserved && word.empty())) {
      word += c;
    } else {
      word += {'%', kDigits[code / 16U], kDigits[code % 16U]};
    }
  }
  return word;
}

std::string name_of_point_array(const std::string& name, std::uint64_t width) {
  if (name == "Normals" && width == 3) {
    return "normal";
  }
  return name == "TCoords" && (width == 2 || width == 3) ? "texcoord" : name;
}

std::string point_array_name(const std::string& name, unsigned width) {
  if (name == "normal" && width == 3) {
    return "Normals";
  }
  return name == "texcoord" && (width == 2 || width == 3) ? "TCoords" : name;
}

bool is_xml_text(std::string_view text) {
  while (!text.empty()) {
    const auto first = static_cast<unsigned char>(text.front());
    const std::size_t length = utf8_length(text);
    if (length == 0 || first < 0x20U || first == 0x7fU) {
      return false;
    }
    text.remove_prefix(length);
  }
  return true;
}

std::string escape_xml(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace isorelax
