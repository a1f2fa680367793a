#include "io/vtk_xml_file.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "io/text_scanner.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

constexpr std::string_view kXmlBlanks = " \t\r\n";

/// All text of an element; other elements may stand in between.
std::string text_of(pugi::xml_node node) {
  std::string text;
  for (const pugi::xml_node part : node.children()) {
    if (part.type() == pugi::node_pcdata || part.type() == pugi::node_cdata) {
      text += part.value();
    }
  }
  return text;
}

std::string_view next_xml_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kXmlBlanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kXmlBlanks));
  text.remove_prefix(word.size());
  return word;
}

/// Where the element AppendedData begins; comments, which may speak of it, are passed over.
std::size_t find_appended_data(std::string_view bytes) {
  std::size_t at = bytes.find('<');
  while (at != std::string_view::npos && !bytes.substr(at).starts_with("<AppendedData")) {
    const bool is_comment = bytes.substr(at).starts_with("<!--");
    const std::size_t end = is_comment ? bytes.find("-->", at + 4) : at + 1;
    at = bytes.find('<', end);
  }
  return at;
}

}  // namespace

VtkXmlFile::VtkXmlFile(std::string_view bytes, std::string name) : name_(std::move(name)) {
  cut_appended_data(bytes);
  const pugi::xml_parse_result result = document_.load_buffer(
      text_.data(), text_.size(), pugi::parse_default | pugi::parse_comments, pugi::encoding_utf8);
  if (!result) {
    fail_at(static_cast<std::size_t>(result.offset), std::string("is not XML: ") + result.description());
  }
  check_form();
}

/// Appended data may be any bytes, which no parser of XML takes: they are set apart before.
void VtkXmlFile::cut_appended_data(std::string_view bytes) {
  static constexpr std::string_view kEnd = "</AppendedData";
  text_ = bytes;
  const std::size_t tag = find_appended_data(bytes);
  const std::size_t tag_end = bytes.find('>', std::min(tag, bytes.size()));
  if (tag_end == std::string_view::npos || bytes[tag_end - 1] == '/') {
    return;
  }
  const std::size_t begin = bytes.find_first_not_of(kXmlBlanks, tag_end + 1);
  const std::size_t end = bytes.rfind(kEnd);
  if (end == std::string_view::npos || end <= tag_end) {
    fail_at(tag, "the file ends within AppendedData");
  }
  if (bytes[begin] != '_') {
    fail_at(tag, "AppendedData does not begin with '_'");
  }
  appended_ = bytes.substr(begin + 1, end - begin - 1);
  text_.erase(begin, end - begin);
}

void VtkXmlFile::check_form() {
  if (std::string_view(root().name()) != "VTKFile") {
    fail(root(), "expected the element VTKFile, found " + in_quotes(root().name()));
  }
  const std::string_view order = root().attribute("byte_order").as_string("LittleEndian");
  const std::string_view header = root().attribute("header_type").as_string("UInt32");
  const std::string_view compressor = root().attribute("compressor").value();
  if (order != "LittleEndian" && order != "BigEndian") {
    fail(root(), "unknown byte_order " + in_quotes(order));
  }
  if (header != "UInt32" && header != "UInt64") {
    fail(root(), "unknown header_type " + in_quotes(header));
  }
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor") {
    fail(root(), "compressed by " + in_quotes(compressor) + "; vtkZLibDataCompressor and none are read");
  }
  layout_ = {order == "BigEndian" ? std::endian::big : std::endian::little, header == "UInt64",
             !compressor.empty()};
}

std::vector<std::string> VtkXmlFile::comments() const {
  std::vector<std::string> lines;
  for (const pugi::xml_node node : document_.children()) {
    if (node == root()) {
      break;
    }
    std::string_view text = node.type() == pugi::node_comment ? node.value() : "";
    while (!text.empty()) {
      std::string_view line = text.substr(0, text.find('\n'));
      text.remove_prefix(std::min(line.size() + 1, text.size()));
      line.remove_prefix(std::min(line.find_first_not_of(kXmlBlanks), line.size()));
      line = line.substr(0, line.find_last_not_of(kXmlBlanks) + 1);
      if (!line.empty()) {
        lines.emplace_back(line);
      }
    }
  }
  return lines;
}

std::uint64_t VtkXmlFile::count(pugi::xml_node node, const char* attribute) const {
  const std::string_view value = node.attribute(attribute).as_string("0");
  const std::optional<std::int64_t> number = parse_integer(value);
  if (!number || *number < 0) {
    fail(node, std::string(attribute) + " is not a whole number from 0 on: " + in_quotes(value));
  }
  return static_cast<std::uint64_t>(*number);
}

VtkArray VtkXmlFile::array(pugi::xml_node node, std::uint64_t rows) {
  VtkArray array;
  array.name = node.attribute("Name").value();
  array.rows = rows;
  array.width = node.attribute("NumberOfComponents") ? count(node, "NumberOfComponents") : 1;
  if (array.width > std::numeric_limits<std::uint32_t>::max()) {
    fail(node, "an array has " + std::to_string(array.width) + " components");
  }
  const char* const word = node.attribute("type").value();
  const std::optional<VtkType> type = xml_vtk_type(word);
  if (!type) {
    fail(node, "unknown type of numbers: " + in_quotes(word));
  }
  array.type = *type;
  if (array.size() == 0) {
    return array;
  }
  const std::string_view format = node.attribute("format").as_string("ascii");
  if (format == "ascii") {
    read_words(node, array);
  } else if (format == "binary" || format == "appended") {
    read_bytes(node, array);
  } else {
    fail(node, "unknown format of an array: " + in_quotes(format));
  }
  return array;
}

void VtkXmlFile::read_words(pugi::xml_node node, VtkArray& array) const {
  const std::string text = text_of(node);
  const std::uint64_t count = array.size();
  // A number takes two bytes; the last one has no blank after it.
  if (capped_product(count, 2) > text.size() + 1) {
    fail(node, "the array has to hold " + std::to_string(count) + " numbers, but is a text of " +
                   std::to_string(text.size()) + " bytes");
  }
  array.values.reserve(count);
  std::string_view left = text;
  for (std::string_view word = next_xml_word(left); !word.empty(); word = next_xml_word(left)) {
    if (array.values.size() == count) {
      fail(node, "the array has to hold " + std::to_string(count) + " numbers, but more follow");
    }
    if (!append_word(array, word)) {
      fail(node, "a number of the array is none: " + in_quotes(word));
    }
  }
  if (array.values.size() < count) {
    fail(node, "the array ends after " + std::to_string(array.values.size()) + " of " +
                   std::to_string(count) + " numbers");
  }
}

/// The place of an array's bytes: `text` in the element itself, or from its offset into AppendedData on.
EncodedBytes VtkXmlFile::source_of(pugi::xml_node node, const std::string& text) const {
  if (std::string_view(node.attribute("format").value()) == "binary") {
    return {text, EncodedBytes::Form::base64};
  }
  const std::uint64_t offset = count(node, "offset");
  if (offset >= appended_.size()) {
    fail(node, "the array begins at byte " + std::to_string(offset) + " of AppendedData, which has " +
                   std::to_string(appended_.size()));
  }
  const std::string_view encoding = root().child("AppendedData").attribute("encoding").as_string("base64");
  if (encoding != "raw" && encoding != "base64") {
    fail(root().child("AppendedData"), "unknown encoding " + in_quotes(encoding));
  }
  return {appended_.substr(offset), encoding == "raw" ? EncodedBytes::Form::raw : EncodedBytes::Form::base64};
}

void VtkXmlFile::read_bytes(pugi::xml_node node, VtkArray& array) {
  has_binary_ = true;
  const std::uint64_t size = binary_size(array.type, array.size());
  const std::string text = text_of(node);
  EncodedBytes source = source_of(node, text);
  std::string bytes;
  const std::string refusal = take_array(source, layout_, size, bytes);
  if (!refusal.empty()) {
    fail(node, "the array " + in_quotes(array.name) + " cannot be read: " + refusal);
  }
  // Many arrays that name the same bytes could otherwise take far more memory than the file.
  appended_read_ += text.empty() ? source.consumed() : 0;
  if (appended_read_ > appended_.size()) {
    fail(node, "the arrays take more bytes than AppendedData has");
  }
  append_binary(array, bytes.data(), layout_.order);
}

void VtkXmlFile::fail(pugi::xml_node node, const std::string& reason) const {
  fail_at(static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0)), reason);
}

void VtkXmlFile::fail_at(std::size_t byte, const std::string& reason) const {
  const auto* const begin = text_.data();
  const auto line = 1 + std::count(begin, begin + std::min(byte, text_.size()), '\n');
  throw InputError(one_line(name_), "line " + std::to_string(line), reason);
}

}  // namespace isorelax
