#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "io/byte_order.h"
#include "io/mesh_file.h"
#include "io/polygon_soup.h"
#include "io/stl_layout.h"
#include "io/text_scanner.h"
#include "io/vertex_merger.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

std::string merge_message(std::size_t corners, std::size_t vertices) {
  return std::to_string(corners) + " corner positions merged into " +
         counted(vertices, "vertex", "vertices") + ": those with the same coordinates are shared";
}

bool is_printable(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= 0x20 && c < 0x7f; });
}

/// Reads text STL: any number of solids, each a list of facets. Keywords in any case of letters.
class StlTextReader {
 public:
  StlTextReader(std::string_view bytes, const std::string& name)
      : text_(bytes, name, {}), merger_(bytes.size() / 80) {}

  RawMesh read() {
    while (text_.find_word()) {
      read_solid();
    }
    finish();
    return std::move(raw_);
  }

 private:
  void read_solid();
  void read_facet();
  void read_vertex();
  void expect(const char* keyword);
  void finish();
  static bool same_word(std::string_view word, std::string_view keyword);

  TextScanner text_;
  VertexMerger merger_;
  RawMesh raw_;
  FaceLabels solids_{"g", {}, {}};
};

bool StlTextReader::same_word(std::string_view word, std::string_view keyword) {
  return word.size() == keyword.size() &&
         std::equal(word.begin(), word.end(), keyword.begin(), [](char a, char b) {
           return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
         });
}

void StlTextReader::expect(const char* keyword) {
  const std::string_view word = text_.word_across_lines();
  if (word.empty()) {
    text_.fail(std::string("the file ends where '") + keyword + "' should stand");
  }
  if (!same_word(word, keyword)) {
    text_.fail(std::string("expected '") + keyword + "', found " + in_quotes(word));
  }
}

void StlTextReader::read_solid() {
  expect("solid");
  solids_.labels.emplace_back(text_.rest_of_line());
  for (;;) {
    const std::string_view word = text_.word_across_lines();
    if (same_word(word, "endsolid")) {
      static_cast<void>(text_.rest_of_line());
      return;
    }
    if (word.empty()) {
      text_.fail("the file ends within a solid: 'endsolid' is missing");
    }
    if (!same_word(word, "facet")) {
      text_.fail("expected 'facet' or 'endsolid', found " + in_quotes(word));
    }
    read_facet();
  }
}

void StlTextReader::read_facet() {
  // The normal is left out: it follows from the corners, and those will move.
  expect("normal");
  for (unsigned k = 0; k < 3; ++k) {
    text_.number("the normal of a facet");
  }
  expect("outer");
  expect("loop");
  std::size_t corners = 0;
  for (;;) {
    const std::string_view word = text_.word_across_lines();
    if (same_word(word, "endloop")) {
      break;
    }
    if (!same_word(word, "vertex")) {
      text_.fail(word.empty() ? "the file ends within a facet"
                              : "expected 'vertex' or 'endloop', found " + in_quotes(word));
    }
    read_vertex();
    ++corners;
  }
  if (corners < 3) {
    text_.fail("a facet has " + std::to_string(corners) + " vertices; 3 are needed");
  }
  expect("endfacet");
  raw_.faces.end_face();
  solids_.face_label.push_back(static_cast<std::uint32_t>(solids_.labels.size() - 1));
}

void StlTextReader::read_vertex() {
  const double x = text_.finite_number("the x coordinate of a vertex");
  const double y = text_.finite_number("the y coordinate of a vertex");
  const double z = text_.finite_number("the z coordinate of a vertex");
  raw_.faces.vertices.push_back(merger_.add({x, y, z}));
  if (raw_.faces.vertices.size() >= kNone) {
    text_.fail("the facets have more corners than can be held");
  }
}

void StlTextReader::finish() {
  raw_.positions = std::move(merger_.positions());
  raw_.messages.push_back(merge_message(raw_.faces.vertices.size(), raw_.positions.size()));
  if (solids_.labels.size() > 1) {
    raw_.attributes.face_labels.push_back(std::move(solids_));
  } else if (!solids_.labels.empty() && !solids_.labels.front().empty()) {
    raw_.attributes.header_lines.push_back("solid " + solids_.labels.front());
  }
}

void keep_header(std::string_view header, RawMesh& raw) {
  header = header.substr(0, std::min(header.find('\0'), header.size()));
  header = header.substr(0, header.find_last_not_of(' ') + 1);
  if (!header.empty() && is_printable(header)) {
    raw.attributes.header_lines.push_back("solid " + std::string(header));
  } else if (!header.empty()) {
    raw.messages.emplace_back("header of the STL file left out: it is not text");
  }
}

Vec3 read_corner(const char* bytes, std::size_t place, const std::string& name) {
  Vec3 position;
  for (unsigned k = 0; k < 3; ++k) {
    const float value = load_bytes<float>(bytes + place + 4 * k, std::endian::little);
    if (!std::isfinite(value)) {
      throw InputError(one_line(name), "byte " + std::to_string(place + 4 * k),
                       std::string("a coordinate of a vertex ") +
                           (std::isnan(value) ? "is not a number (NaN)" : "is infinite"));
    }
    position[k] = static_cast<double>(value);
  }
  return position;
}

RawMesh read_binary(std::string_view bytes, const std::string& name) {
  if (bytes.size() < kStlHeader) {
    throw InputError(one_line(name), "byte " + std::to_string(bytes.size()),
                     "the file ends within the header of binary STL, which has 84 bytes");
  }
  const auto count = load_bytes<std::uint32_t>(bytes.data() + kStlTitle, std::endian::little);
  if (count > (bytes.size() - kStlHeader) / kStlFacet) {
    throw InputError(one_line(name), "byte " + std::to_string(kStlTitle),
                     "the header promises " + std::to_string(count) + " triangles, but the file holds " +
                         std::to_string((bytes.size() - kStlHeader) / kStlFacet));
  }
  if (count >= kNone / 3) {
    throw InputError(one_line(name), "byte " + std::to_string(kStlTitle),
                     std::to_string(count) + " triangles are more than can be held");
  }
  const std::size_t rest = bytes.size() - kStlHeader - kStlFacet * count;
  if (rest > kStlHeader + kStlFacet * count) {
    // Any file of another kind has some number in this place.
    throw InputError(one_line(name), "byte " + std::to_string(kStlTitle),
                     "the header promises " + std::to_string(count) + " triangles, but " +
                         std::to_string(rest) + " more bytes follow them: this is no STL file");
  }
  RawMesh raw;
  keep_header(bytes.substr(0, kStlTitle), raw);
  raw.attributes.position_type = ScalarType::float32;
  raw.faces.vertices.reserve(std::size_t{3} * count);
  raw.faces.first_corner.reserve(std::size_t{count} + 1);
  VertexMerger merger(count);
  Attribute color{"stl_attribute", ScalarType::uint16, 1, {}};
  for (std::size_t t = 0; t < count; ++t) {
    const std::size_t place = kStlHeader + kStlFacet * t;
    for (unsigned k = 0; k < 3; ++k) {
      raw.faces.vertices.push_back(merger.add(read_corner(bytes.data(), place + 12 * (k + 1), name)));
    }
    raw.faces.end_face();
    color.values.push_back(load_bytes<std::uint16_t>(bytes.data() + place + 48, std::endian::little));
  }
  raw.positions = std::move(merger.positions());
  raw.messages.push_back(merge_message(raw.faces.vertices.size(), raw.positions.size()));
  if (std::any_of(color.values.begin(), color.values.end(), [](double v) { return v != 0.0; })) {
    raw.attributes.face.push_back(std::move(color));
  }
  if (rest >= kStlFacet && rest % kStlFacet == 0) {
    throw InputError(one_line(name), "byte " + std::to_string(kStlTitle),
                     "the header promises " + std::to_string(count) + " triangles, but the file holds " +
                         std::to_string(count + rest / kStlFacet));
  }
  if (rest > 0) {
    raw.messages.push_back(counted(rest, "byte", "bytes") + " after the last triangle left out");
  }
  return raw;
}

}  // namespace

MeshFile read_stl(std::string_view bytes, const std::string& name) {
  if (is_text_stl(bytes)) {
    return finish_mesh(StlTextReader(bytes, name).read(), FileFormat::stl, FileEncoding::text, name);
  }
  return finish_mesh(read_binary(bytes, name), FileFormat::stl, FileEncoding::binary_little_endian, name);
}

}  // namespace isorelax
