#include "io/ply_header.h"

#include <algorithm>
#include <array>

#include "io/text_scanner.h"

namespace isorelax {
namespace {

/// No file in use comes near these; they keep the cost of a hostile header small.
constexpr std::size_t kMostElements = 1000;
constexpr std::size_t kMostProperties = 10000;

struct TypeName {
  const char* name;
  ScalarType type;
};

constexpr std::array<TypeName, 16> kTypeNames{{{"char", ScalarType::int8},
                                               {"uchar", ScalarType::uint8},
                                               {"short", ScalarType::int16},
                                               {"ushort", ScalarType::uint16},
                                               {"int", ScalarType::int32},
                                               {"uint", ScalarType::uint32},
                                               {"float", ScalarType::float32},
                                               {"double", ScalarType::float64},
                                               {"int8", ScalarType::int8},
                                               {"uint8", ScalarType::uint8},
                                               {"int16", ScalarType::int16},
                                               {"uint16", ScalarType::uint16},
                                               {"int32", ScalarType::int32},
                                               {"uint32", ScalarType::uint32},
                                               {"float32", ScalarType::float32},
                                               {"float64", ScalarType::float64}}};

ScalarType scalar_type(const TextScanner& text, std::string_view word) {
  const auto found =
      std::find_if(kTypeNames.begin(), kTypeNames.end(), [&](const TypeName& t) { return word == t.name; });
  if (found == kTypeNames.end()) {
    text.fail("unknown type of a property: " + in_quotes(word));
  }
  return found->type;
}

void read_format(TextScanner& text, PlyHeader& header) {
  const std::string_view encoding = text.word();
  if (encoding == "ascii") {
    header.encoding = FileEncoding::text;
  } else if (encoding == "binary_little_endian") {
    header.encoding = FileEncoding::binary_little_endian;
  } else if (encoding == "binary_big_endian") {
    header.encoding = FileEncoding::binary_big_endian;
  } else {
    text.fail("unknown PLY format " + in_quotes(encoding));
  }
  const std::string_view version = text.word();
  if (version != "1.0") {
    text.fail("unknown PLY version " + in_quotes(version));
  }
}

void read_element(TextScanner& text, PlyHeader& header) {
  PlyElement element;
  element.name = text.word();
  element.line = text.line();
  if (text.peek_word().empty()) {
    text.fail("element " + in_quotes(element.name) + " has no count");
  }
  element.count = text.count("the count of an element");
  if (std::any_of(header.elements.begin(), header.elements.end(),
                  [&](const PlyElement& other) { return other.name == element.name; })) {
    text.fail("element " + in_quotes(element.name) + " stands twice");
  }
  if (header.elements.size() == kMostElements) {
    text.fail("more than " + std::to_string(kMostElements) + " elements");
  }
  header.elements.push_back(std::move(element));
}

void read_property(TextScanner& text, PlyHeader& header) {
  if (header.elements.empty()) {
    text.fail("a property stands before the first element");
  }
  PlyElement& element = header.elements.back();
  PlyProperty property;
  std::string_view word = text.word();
  if (word == "list") {
    property.list_count = scalar_type(text, text.word());
    if (*property.list_count == ScalarType::float32 || *property.list_count == ScalarType::float64) {
      text.fail("the count of a list is not of a whole-number type");
    }
    word = text.word();
  }
  property.type = scalar_type(text, word);
  property.name = text.word();
  if (property.name.empty()) {
    text.fail("a property has no name");
  }
  if (element.find(property.name)) {
    text.fail("property " + in_quotes(property.name) + " stands twice");
  }
  if (element.properties.size() == kMostProperties) {
    text.fail("more than " + std::to_string(kMostProperties) + " properties of one element");
  }
  element.properties.push_back(std::move(property));
}

}  // namespace

const char* ply_type_name(ScalarType type) {
  return kTypeNames[static_cast<std::size_t>(type)].name;
}

std::optional<std::size_t> PlyElement::find(std::string_view property) const {
  const auto found = std::find_if(properties.begin(), properties.end(),
                                  [&](const PlyProperty& p) { return p.name == property; });
  return found == properties.end() ? std::nullopt : std::optional<std::size_t>(found - properties.begin());
}

PlyHeader read_ply_header(std::string_view bytes, const std::string& name) {
  TextScanner text(bytes, name, {});
  PlyHeader header;
  text.next_line();
  if (const std::string_view magic = text.word(); magic != "ply") {
    text.fail("expected ply, found " + (magic.empty() ? std::string("nothing") : in_quotes(magic)));
  }
  bool has_format = false;
  while (text.next_line()) {
    const std::string_view keyword = text.word();
    if (keyword == "format") {
      read_format(text, header);
      has_format = true;
    } else if (keyword == "comment") {
      header.comments.emplace_back(text.rest_of_line());
    } else if (keyword == "obj_info") {
      header.object_information.emplace_back(text.rest_of_line());
    } else if (keyword == "element") {
      read_element(text, header);
    } else if (keyword == "property") {
      read_property(text, header);
    } else if (keyword == "end_header") {
      if (!has_format) {
        text.fail("the header ends without a format");
      }
      header.size = bytes.size() - text.bytes_after_line();
      header.lines = text.line();
      return header;
    } else if (!keyword.empty()) {
      text.fail("unknown word in the header: " + in_quotes(keyword));
    }
  }
  text.fail("the header has no end_header");
}

}  // namespace isorelax
