#include <algorithm>
#include <map>
#include <unordered_map>

#include "io/color_column.h"
#include "io/mesh_file.h"
#include "io/polygon_soup.h"
#include "io/text_scanner.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

/// More words than any statement with numbers has.
constexpr std::size_t kManyWords = 16;

/// A table that faces point into: v, vt or vn.
struct Table {
  const char* noun;
  std::size_t count = 0;
};

/// An index that was not defined when a face named it; allowed if it is by the end of the file.
struct ForwardReference {
  const Table* table;
  std::size_t line;
  std::uint32_t index;
};

/// Labels in force from a g, o, usemtl or s statement on.
struct LabelState {
  FaceLabels labels;
  std::unordered_map<std::string, std::uint32_t> numbers;
  std::uint32_t current = kNone;
};

/// Reads Wavefront OBJ: v, vt, vn, f, and g, o, usemtl, s, mtllib as labels. Other statements are counted.
class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& name)
      : text_(bytes, name, {CommentRule::at_token, LineJoin::backslash}) {
    for (const char* keyword : {"o", "g", "usemtl", "s"}) {
      labels_.emplace_back();
      labels_.back().labels.keyword = keyword;
    }
  }

  RawMesh read() {
    while (text_.next_line()) {
      read_statement(text_.word());
    }
    finish();
    return std::move(raw_);
  }

 private:
  void read_statement(std::string_view keyword);
  void read_position();
  void read_texture();
  void read_normal();
  void read_face();
  void read_corner(std::string_view word);
  std::uint32_t index_in(const Table& table, std::string_view text, std::string_view word);
  void read_label(LabelState& state);
  void finish();
  void finish_labels();
  void check_forward_references();
  void report_unknown();
  double needed_number(const char* what);

  TextScanner text_;
  RawMesh raw_;
  Table positions_{"vertex"};
  Table textures_{"texture coordinate"};
  Table normals_{"normal"};
  std::vector<ForwardReference> forward_;
  ColorColumn colors_{ColorNumbers::fractions};
  std::vector<double> weights_;
  std::size_t weighted_ = 0;
  std::vector<double> texture_values_;
  unsigned texture_width_ = 2;
  std::vector<double> normal_values_;
  std::vector<std::uint32_t> corner_textures_;
  std::vector<std::uint32_t> corner_normals_;
  std::vector<LabelState> labels_;
  std::map<std::string, std::size_t, std::less<>> unknown_;
};

void ObjReader::read_statement(std::string_view keyword) {
  if (keyword.empty()) {
    return;
  }
  if (keyword == "v") {
    read_position();
  } else if (keyword == "f") {
    read_face();
  } else if (keyword == "vt") {
    read_texture();
  } else if (keyword == "vn") {
    read_normal();
  } else if (keyword == "mtllib") {
    raw_.attributes.header_lines.push_back("mtllib " + std::string(text_.rest_of_line()));
  } else {
    const auto state = std::find_if(labels_.begin(), labels_.end(),
                                    [&](const LabelState& label) { return label.labels.keyword == keyword; });
    if (state != labels_.end()) {
      read_label(*state);
    } else {
      const auto known = unknown_.find(keyword);
      ++(known != unknown_.end() ? known->second : unknown_[std::string(keyword)]);
    }
  }
}

double ObjReader::needed_number(const char* what) {
  if (text_.peek_word().empty()) {
    text_.fail(std::string(what) + " is missing");
  }
  return text_.number(what);
}

void ObjReader::read_position() {
  Vec3 position;
  static constexpr std::array<const char*, 3> kNames{
      "the x coordinate of a vertex", "the y coordinate of a vertex", "the z coordinate of a vertex"};
  for (unsigned k = 0; k < 3; ++k) {
    if (text_.peek_word().empty()) {
      text_.fail(std::string(kNames[k]) + " is missing");
    }
    position[k] = text_.finite_number(kNames[k]);
  }
  const std::size_t extra = text_.words_left(kManyWords);
  if (extra == 1) {
    weights_.resize(positions_.count, 1.0);
    weights_.push_back(needed_number("the weight of a vertex"));
    ++weighted_;
  } else if (extra == 3 || extra == 4) {
    colors_.take(text_, positions_.count, static_cast<unsigned>(extra));
  } else if (extra != 0) {
    text_.fail("a vertex has " + std::to_string(3 + extra) + " numbers; 3, 4, 6 or 7 are read");
  }
  raw_.positions.push_back(position);
  ++positions_.count;
}

void ObjReader::read_texture() {
  const std::size_t words = text_.words_left(kManyWords);
  if (words < 1 || words > 3) {
    text_.fail("a texture coordinate has " + std::to_string(words) + " numbers; 1 to 3 are read");
  }
  for (std::size_t k = 0; k < 3; ++k) {
    texture_values_.push_back(k < words ? needed_number("a texture coordinate") : 0.0);
  }
  texture_width_ = std::max(texture_width_, static_cast<unsigned>(words));
  ++textures_.count;
}

void ObjReader::read_normal() {
  for (unsigned k = 0; k < 3; ++k) {
    normal_values_.push_back(needed_number("a normal"));
  }
  ++normals_.count;
}

std::uint32_t ObjReader::index_in(const Table& table, std::string_view text, std::string_view word) {
  const std::optional<std::int64_t> number = parse_integer(text);
  if (!number) {
    text_.fail("a corner of a face is not an index: " + in_quotes(word));
  }
  const auto count = static_cast<std::int64_t>(table.count);
  const std::int64_t index = *number < 0 ? count + *number : *number - 1;
  if (*number == 0 || index < 0 || index >= static_cast<std::int64_t>(kNone)) {
    text_.fail("a face names " + std::string(table.noun) + " " + std::to_string(*number) +
               ", but there are " + std::to_string(count) + " so far (numbered from 1)");
  }
  if (index >= count) {
    forward_.push_back({&table, text_.line(), static_cast<std::uint32_t>(index)});
  }
  return static_cast<std::uint32_t>(index);
}

void ObjReader::read_corner(std::string_view word) {
  const std::size_t first_slash = std::min(word.find('/'), word.size());
  const std::string_view position = word.substr(0, first_slash);
  std::string_view rest = word.substr(std::min(first_slash + 1, word.size()));
  const std::size_t second_slash = std::min(rest.find('/'), rest.size());
  const std::string_view texture = rest.substr(0, second_slash);
  const std::string_view normal = rest.substr(std::min(second_slash + 1, rest.size()));
  raw_.faces.vertices.push_back(index_in(positions_, position, word));
  // Tables of indices begin with the first face that has one: many files have none.
  const std::size_t corner = raw_.faces.vertices.size() - 1;
  if (!texture.empty()) {
    corner_textures_.resize(corner, kNone);
    corner_textures_.push_back(index_in(textures_, texture, word));
  }
  if (!normal.empty()) {
    corner_normals_.resize(corner, kNone);
    corner_normals_.push_back(index_in(normals_, normal, word));
  }
}

void ObjReader::read_face() {
  for (std::string_view word = text_.word(); !word.empty(); word = text_.word()) {
    read_corner(word);
  }
  raw_.faces.end_face();
  for (LabelState& state : labels_) {
    if (state.current != kNone) {
      state.labels.face_label.resize(raw_.faces.face_count() - 1, kNone);
      state.labels.face_label.push_back(state.current);
    }
  }
}

void ObjReader::read_label(LabelState& state) {
  const std::string label(text_.rest_of_line());
  const auto [entry, is_new] =
      state.numbers.emplace(label, static_cast<std::uint32_t>(state.labels.labels.size()));
  if (is_new) {
    state.labels.labels.push_back(label);
  }
  state.current = entry->second;
}

void ObjReader::check_forward_references() {
  for (const ForwardReference& reference : forward_) {
    if (reference.index >= reference.table->count) {
      text_.fail_at(reference.line, "a face names " + std::string(reference.table->noun) + " " +
                                        std::to_string(std::uint64_t{reference.index} + 1) +
                                        ", but there are " + std::to_string(reference.table->count) +
                                        " (numbered from 1)");
    }
  }
}

void ObjReader::finish_labels() {
  for (LabelState& state : labels_) {
    if (!state.labels.face_label.empty()) {
      state.labels.face_label.resize(raw_.faces.face_count(), kNone);
      raw_.attributes.face_labels.push_back(std::move(state.labels));
    }
  }
}

void ObjReader::report_unknown() {
  static constexpr std::size_t kNamed = 8;
  std::size_t statements = 0;
  std::string names;
  std::size_t named = 0;
  for (const auto& [keyword, count] : unknown_) {
    statements += count;
    if (named++ < kNamed) {
      names += (names.empty() ? "" : ", ") + in_quotes(keyword) + " x " + std::to_string(count);
    }
  }
  if (statements > 0) {
    raw_.messages.push_back(counted(statements, "statement", "statements") + " left out: " + names +
                            (named > kNamed ? ", ..." : ""));
  }
}

void ObjReader::finish() {
  check_forward_references();
  finish_labels();
  MeshAttributes& attributes = raw_.attributes;
  colors_.finish(positions_.count, "vertices", attributes.vertex, raw_.messages);
  if (weighted_ > 0) {
    weights_.resize(positions_.count, 1.0);
    attributes.vertex.push_back({"weight", ScalarType::float64, 1, std::move(weights_)});
  }
  const std::size_t corners = raw_.faces.vertices.size();
  if (textures_.count > 0) {
    if (texture_width_ == 2) {
      for (std::size_t i = 0; i < textures_.count; ++i) {
        texture_values_[2 * i] = texture_values_[3 * i];
        texture_values_[2 * i + 1] = texture_values_[3 * i + 1];
      }
      texture_values_.resize(2 * textures_.count);
    }
    corner_textures_.resize(corners, kNone);
    attributes.corner.push_back(
        {"texcoord", texture_width_, std::move(texture_values_), std::move(corner_textures_)});
  }
  if (normals_.count > 0) {
    corner_normals_.resize(corners, kNone);
    attributes.corner.push_back({"normal", 3, std::move(normal_values_), std::move(corner_normals_)});
  }
  report_unknown();
  attributes.comments = std::move(text_.comments());
}

}  // namespace

MeshFile read_obj(std::string_view bytes, const std::string& name) {
  return finish_mesh(ObjReader(bytes, name).read(), FileFormat::obj, FileEncoding::text, name);
}

}  // namespace isorelax
