#include <algorithm>

#include "io/color_column.h"
#include "io/mesh_file.h"
#include "io/polygon_soup.h"
#include "io/text_scanner.h"

namespace isorelax {
namespace {

/// More words than can follow an element on its line: four of a colour and two of a texture coordinate.
constexpr std::size_t kManyElementWords = 7;

/// Reads [ST][C][N][4][n]OFF: counts, vertices (position, normal, colour, texture coordinates), faces
/// (degree, vertices, colour). See Geomview's manual, OFF(5).
class OffReader {
 public:
  OffReader(std::string_view bytes, const std::string& name) : text_(bytes, name, {CommentRule::anywhere}) {}

  RawMesh read() {
    read_header();
    read_counts();
    for (std::size_t i = 0; i < vertex_count_; ++i) {
      read_vertex(i);
    }
    for (std::size_t i = 0; i < face_count_; ++i) {
      read_face(i);
    }
    finish();
    return std::move(raw_);
  }

 private:
  void read_header();
  void read_counts();
  void read_vertex(std::size_t index);
  void read_vertex_color(std::size_t index, bool began_line);
  void read_face(std::size_t index);
  void read_face_color(std::size_t index);
  void finish();
  std::size_t bounded_count(const char* what, const char* elements, std::size_t least_bytes);

  TextScanner text_;
  RawMesh raw_;
  bool has_texture_ = false;
  bool has_color_ = false;
  bool has_normal_ = false;
  std::size_t vertex_count_ = 0;
  std::size_t face_count_ = 0;
  std::vector<double> normals_;
  std::vector<double> texture_;
  ColorColumn vertex_colors_{ColorNumbers::bytes_or_fractions};
  ColorColumn face_colors_{ColorNumbers::bytes_or_fractions};
  std::vector<double> color_indices_;
  std::size_t faces_with_index_ = 0;
  std::size_t odd_extras_ = 0;
};

/// Takes the prefix off a header word; says whether it was there.
bool take_prefix(std::string_view& word, std::string_view prefix) {
  if (word.substr(0, prefix.size()) != prefix) {
    return false;
  }
  word.remove_prefix(prefix.size());
  return true;
}

void OffReader::read_header() {
  const std::string_view first = text_.word_across_lines();
  std::string_view rest = first;
  has_texture_ = take_prefix(rest, "ST");
  has_color_ = take_prefix(rest, "C");
  has_normal_ = take_prefix(rest, "N");
  const bool four = take_prefix(rest, "4");
  const bool any_dimension = take_prefix(rest, "n");
  if (rest != "OFF") {
    text_.fail("expected OFF, found " + (first.empty() ? std::string("nothing") : in_quotes(first)));
  }
  if (four || any_dimension) {
    text_.fail(in_quotes(first) + " holds points with other than three coordinates; only three are read");
  }
}

std::size_t OffReader::bounded_count(const char* what, const char* elements, std::size_t least_bytes) {
  const std::uint64_t count = text_.count(what);
  if (count > text_.bytes_left() / least_bytes + 1) {
    text_.fail("the header promises " + std::to_string(count) + " " + elements + ", but only " +
               std::to_string(text_.bytes_left()) + " bytes follow");
  }
  if (count >= kNone) {
    text_.fail(std::to_string(count) + " " + elements + " are more than can be held");
  }
  return static_cast<std::size_t>(count);
}

void OffReader::read_counts() {
  if (text_.peek_word() == "BINARY") {
    text_.fail("binary OFF is not read; text OFF is");
  }
  // The shortest vertex is "0 0 0" and a line end, the shortest face "1 0" and a line end.
  vertex_count_ = bounded_count("the number of vertices", "vertices", 6);
  const std::size_t line = text_.line();
  face_count_ = bounded_count("the number of faces", "faces", 4);
  // The number of edges is not used and often left out.
  if (text_.line() == line) {
    static_cast<void>(text_.word());
  } else {
    text_.count("the number of edges");
  }
  raw_.positions.reserve(vertex_count_);
  raw_.faces.first_corner.reserve(face_count_ + 1);
}

void OffReader::read_vertex(std::size_t index) {
  if (!text_.find_word()) {
    text_.fail("the file ends after " + std::to_string(index) + " of " + std::to_string(vertex_count_) +
               " vertices");
  }
  const bool began_line = text_.at_line_start();
  const double x = text_.finite_number("the x coordinate of a vertex");
  const double y = text_.finite_number("the y coordinate of a vertex");
  const double z = text_.finite_number("the z coordinate of a vertex");
  raw_.positions.emplace_back(x, y, z);
  for (unsigned k = 0; has_normal_ && k < 3; ++k) {
    normals_.push_back(text_.number("a normal of a vertex"));
  }
  read_vertex_color(index, began_line);
  for (unsigned k = 0; has_texture_ && k < 2; ++k) {
    texture_.push_back(text_.number("a texture coordinate of a vertex"));
  }
}

void OffReader::read_vertex_color(std::size_t index, bool began_line) {
  const std::size_t words = text_.words_left(kManyElementWords);
  const std::size_t texture_words = has_texture_ ? 2 : 0;
  const std::size_t color_words = words - std::min(words, texture_words);
  if (began_line && (color_words == 3 || color_words == 4)) {
    // Plain OFF with colours after the coordinates is common, though the header should say COFF.
    vertex_colors_.take(text_, index, static_cast<unsigned>(color_words));
  } else if (has_color_) {
    if (words < 4) {
      text_.fail("the colour of a vertex has " + std::to_string(color_words) + " numbers; 3 or 4 are needed");
    }
    vertex_colors_.take(text_, index, 4);
  }
}

void OffReader::read_face(std::size_t index) {
  if (!text_.find_word()) {
    text_.fail("the file ends after " + std::to_string(index) + " of " + std::to_string(face_count_) +
               " faces");
  }
  const bool began_line = text_.at_line_start();
  const std::uint64_t degree = text_.count("the number of corners of a face");
  if (degree > text_.bytes_left() / 2 + 1 || raw_.faces.vertices.size() + degree >= kNone) {
    text_.fail("a face promises " + std::to_string(degree) + " corners, but only " +
               std::to_string(text_.bytes_left()) + " bytes follow");
  }
  for (std::uint64_t k = 0; k < degree; ++k) {
    const std::string_view word = text_.word_across_lines();
    const std::optional<std::int64_t> vertex = parse_integer(word);
    if (word.empty()) {
      text_.fail("the file ends within face " + std::to_string(index));
    }
    if (!vertex) {
      text_.fail("a vertex index is not a whole number: " + in_quotes(word));
    }
    if (*vertex < 0 || static_cast<std::uint64_t>(*vertex) >= vertex_count_) {
      text_.fail("face " + std::to_string(index) + " names vertex " + std::to_string(*vertex) +
                 ", but there are " + std::to_string(vertex_count_) + " (numbered from 0)");
    }
    raw_.faces.vertices.push_back(static_cast<Index>(*vertex));
  }
  raw_.faces.end_face();
  if (began_line) {
    read_face_color(index);
  }
}

void OffReader::read_face_color(std::size_t index) {
  const std::size_t words = text_.words_left(kManyElementWords);
  if (words == 3 || words == 4) {
    face_colors_.take(text_, index, static_cast<unsigned>(words));
    return;
  }
  if (words == 1) {
    const std::optional<double> value = parse_double(text_.peek_word());
    if (!value) {
      text_.fail("the colour of a face is not a number: " + in_quotes(text_.peek_word()));
    }
    color_indices_.resize(index, 0.0);
    color_indices_.push_back(*value);
    ++faces_with_index_;
  } else if (words != 0) {
    ++odd_extras_;
  }
  static_cast<void>(text_.rest_of_line());
}

void OffReader::finish() {
  MeshAttributes& attributes = raw_.attributes;
  if (has_normal_) {
    attributes.vertex.push_back({"normal", ScalarType::float64, 3, std::move(normals_)});
  }
  vertex_colors_.finish(vertex_count_, "vertices", attributes.vertex, raw_.messages);
  if (has_texture_) {
    attributes.vertex.push_back({"texcoord", ScalarType::float64, 2, std::move(texture_)});
  }
  face_colors_.finish(face_count_, "faces", attributes.face, raw_.messages);
  if (faces_with_index_ > 0) {
    if (faces_with_index_ < face_count_) {
      raw_.messages.push_back(std::to_string(face_count_ - faces_with_index_) +
                              " faces without an index into the colour map given index 0");
    }
    color_indices_.resize(face_count_, 0.0);
    attributes.face.push_back({"color_index", ScalarType::float64, 1, std::move(color_indices_)});
  }
  if (odd_extras_ > 0) {
    raw_.messages.push_back("values after the corners of " + counted(odd_extras_, "face", "faces") +
                            " left out: a colour has 1, 3 or 4");
  }
  if (text_.find_word()) {
    if (parse_integer(text_.peek_word())) {
      text_.fail("the header promises " + std::to_string(face_count_) + " faces, but more follow");
    }
    raw_.messages.push_back("everything after the last face, from line " + std::to_string(text_.line()) +
                            " on, left out");
  }
  attributes.comments = std::move(text_.comments());
}

}  // namespace

MeshFile read_off(std::string_view bytes, const std::string& name) {
  return finish_mesh(OffReader(bytes, name).read(), FileFormat::off, FileEncoding::text, name);
}

}  // namespace isorelax
