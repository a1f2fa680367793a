#include <algorithm>
#include <array>
#include <cctype>

#include "io/byte_order.h"
#include "io/mesh_file.h"
#include "io/stl_layout.h"
#include "io/text_scanner.h"

namespace isorelax {
namespace {

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Enough for titles and comments before the first statement.
constexpr std::size_t kSniffed = 65536;

bool looks_like_off(std::string_view bytes) {
  TextScanner text(bytes.substr(0, kSniffed), "", {CommentRule::anywhere});
  const std::string_view word = text.word_across_lines();
  return word.size() >= 3 && word.size() <= 8 && word.ends_with("OFF") &&
         word.find_first_not_of("STCN4nOF") == std::string_view::npos;
}

bool looks_like_ply(std::string_view bytes) {
  TextScanner text(bytes.substr(0, kSniffed), "", {});
  return text.next_line() && text.word() == "ply" && text.peek_word().empty();
}

/// Whether the first statement is one of OBJ's and, for those with numbers, has a number.
bool looks_like_obj(std::string_view bytes) {
  static constexpr std::array<std::string_view, 4> kWithNumbers{"v", "vt", "vn", "vp"};
  static constexpr std::array<std::string_view, 7> kOthers{"mtllib", "usemtl", "g", "o", "s", "f", "l"};
  TextScanner text(bytes.substr(0, kSniffed), "", {CommentRule::at_token, LineJoin::backslash});
  const std::string_view word = text.word_across_lines();
  if (std::find(kWithNumbers.begin(), kWithNumbers.end(), word) != kWithNumbers.end()) {
    return parse_double(text.peek_word()).has_value();
  }
  return std::find(kOthers.begin(), kOthers.end(), word) != kOthers.end();
}

/// Gmsh writes sections between $Name and $EndName; others than the format may come first.
bool looks_like_msh(std::string_view bytes) {
  static constexpr std::array<std::string_view, 3> kFirst{"$MeshFormat", "$Comments", "$NOD"};
  TextScanner text(bytes.substr(0, kSniffed), "", {});
  const std::string_view word = text.word_across_lines();
  return std::find(kFirst.begin(), kFirst.end(), word) != kFirst.end();
}

bool looks_like_vtk(std::string_view bytes) {
  return lower_case(std::string(bytes.substr(0, kSniffed)).substr(0, 14)) == "# vtk datafile";
}

/// The format that an XML file of VTK's names; of one that holds no surface, too, so that its reader says so.
std::optional<FileFormat> vtk_xml_format(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, kSniffed);
  const std::size_t begin = head.find("<VTKFile");
  if (begin == std::string_view::npos || head.find_first_not_of(" \t\r\n\xef\xbb\xbf") != head.find('<'))
    return std::nullopt;
  const std::string_view tag = head.substr(begin, head.find('>', begin) - begin);
  return tag.find("PolyData") != std::string_view::npos ? FileFormat::vtp : FileFormat::vtu;
}

}  // namespace

const char* format_name(FileFormat format) {
  static constexpr std::array<const char*, kFileFormats.size()> kNames{"OFF", "OBJ", "PLY", "STL",
                                                                       "MSH", "VTK", "VTP", "VTU"};
  return kNames[static_cast<std::size_t>(format)];
}

std::string format_names() {
  std::string names;
  for (const FileFormat format : kFileFormats) {
    if (!names.empty()) {
      names += format == kFileFormats.back() ? " or " : ", ";
    }
    names += format_name(format);
  }
  return names;
}

std::optional<FileFormat> format_of_extension(const std::filesystem::path& path) {
  const std::string extension = lower_case(path.extension().string());
  for (const FileFormat format : kFileFormats) {
    if (extension == "." + lower_case(format_name(format))) {
      return format;
    }
  }
  return std::nullopt;
}

std::optional<FileFormat> format_of_content(std::string_view bytes) {
  // Before OFF, where # begins a comment.
  if (looks_like_vtk(bytes)) {
    return FileFormat::vtk;
  }
  if (const auto xml = vtk_xml_format(bytes)) {
    return xml;
  }
  if (looks_like_msh(bytes)) {
    return FileFormat::msh;
  }
  if (looks_like_ply(bytes)) {
    return FileFormat::ply;
  }
  if (looks_like_off(bytes)) {
    return FileFormat::off;
  }
  if (has_binary_stl_size(bytes) || is_text_stl(bytes)) {
    return FileFormat::stl;
  }
  if (looks_like_obj(bytes)) {
    return FileFormat::obj;
  }
  return std::nullopt;
}

bool has_binary_stl_size(std::string_view bytes) {
  return bytes.size() >= kStlHeader &&
         bytes.size() == kStlHeader + kStlFacet * std::size_t{load_bytes<std::uint32_t>(
                                                      bytes.data() + kStlTitle, std::endian::little)};
}

bool is_text_stl(std::string_view bytes) {
  static constexpr std::size_t kChecked = 512;
  TextScanner text(bytes.substr(0, kSniffed), "", {});
  return lower_case(std::string(text.word_across_lines())) == "solid" && !has_binary_stl_size(bytes) &&
         bytes.substr(0, kChecked).find('\0') == std::string_view::npos;
}

}  // namespace isorelax
