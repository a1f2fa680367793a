#include <algorithm>
#include <array>

#include "io/attribute_access.h"
#include "io/mesh_file.h"
#include "io/polygon_soup.h"
#include "io/text_out.h"

namespace isorelax {
namespace {

/// Values with a table of their own (vt, vn) and the index of each corner into it.
struct IndexedValues {
  const std::vector<double>* values = nullptr;
  unsigned width = 0;
  /// Null: the corner's vertex is the index.
  const std::vector<std::uint32_t>* indices = nullptr;

  [[nodiscard]] std::uint32_t index_of(std::size_t corner, Index vertex) const {
    return values == nullptr ? kNone : indices == nullptr ? vertex : (*indices)[corner];
  }
};

/// Writer of one mesh. Vertex normals and texture coordinates become tables indexed by the vertex.
class ObjWriter {
 public:
  explicit ObjWriter(const TriangleMesh& mesh) : mesh_(mesh), written_{&mesh.attributes.comments} {}

  EncodedMesh write() {
    append_lines(out_, "# ", mesh_.attributes.comments);
    write_libraries();
    write_positions();
    write_table("vt", texture_ = find_values("texcoord", 1, 3));
    write_table("vn", normal_ = find_values("normal", 3, 3));
    find_labels();
    write_faces();
    EncodedMesh file{std::move(out_), report_not_written(mesh_.attributes, written_, FileFormat::obj)};
    if (changed_labels_ > 0) {
      file.messages.push_back(counted(changed_labels_, "label", "labels") +
                              " written with _ for characters that OBJ does not allow there");
    }
    return file;
  }

 private:
  void write_libraries();
  void write_positions();
  void append_color(const Attribute& color, bool bytes, std::size_t vertex);
  IndexedValues find_values(const std::string& name, unsigned least, unsigned most);
  void write_table(const char* keyword, const IndexedValues& table);
  void find_labels();
  std::string spelled(const std::string& label);
  void write_labels(std::size_t triangle);
  void write_faces();

  const TriangleMesh& mesh_;
  WrittenParts written_;
  std::string out_;
  IndexedValues texture_;
  IndexedValues normal_;
  std::vector<const FaceLabels*> labels_;
  std::vector<std::uint32_t> current_;
  std::size_t changed_labels_ = 0;
};

void ObjWriter::write_libraries() {
  for (const std::string& line : mesh_.attributes.header_lines) {
    if (line.starts_with("mtllib ")) {
      append_lines(out_, "", {line});
      written_.insert(&line);
    }
  }
}

void ObjWriter::append_color(const Attribute& color, bool bytes, std::size_t vertex) {
  for (unsigned k = 0; k < color.width; ++k) {
    const double value = color.values[vertex * color.width + k];
    out_ += ' ';
    append_fraction(out_, bytes ? value / 255.0 : value);
  }
}

void ObjWriter::write_positions() {
  const auto color = take_vertex_attribute(mesh_, "color", 3, 4, written_);
  const bool bytes = color && is_byte_color(*color);
  const Attribute* weight =
      color ? nullptr : take_attribute(mesh_.attributes.vertex, "weight", 1, 1, written_);
  for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
    out_ += "v ";
    append_point(out_, mesh_.positions[v]);
    if (weight != nullptr) {
      out_ += ' ';
      append_number(out_, weight->values[v]);
    }
    if (color) {
      append_color(*color, bytes, v);
    }
    out_ += '\n';
  }
}

IndexedValues ObjWriter::find_values(const std::string& name, unsigned least, unsigned most) {
  for (const CornerAttribute& corner : mesh_.attributes.corner) {
    if (corner.name == name && corner.width >= least && corner.width <= most) {
      written_.insert(&corner);
      return {&corner.values, corner.width, &corner.indices};
    }
  }
  if (const Attribute* vertex = take_attribute(mesh_.attributes.vertex, name, least, most, written_)) {
    return {&vertex->values, vertex->width, nullptr};
  }
  return {};
}

void ObjWriter::write_table(const char* keyword, const IndexedValues& table) {
  const std::size_t rows = table.values == nullptr ? 0 : table.values->size() / table.width;
  for (std::size_t i = 0; i < rows; ++i) {
    out_ += keyword;
    for (unsigned k = 0; k < table.width; ++k) {
      out_ += ' ';
      append_number(out_, (*table.values)[i * table.width + k]);
    }
    out_ += '\n';
  }
}

void ObjWriter::find_labels() {
  static constexpr std::array<const char*, 4> kKeywords{"o", "g", "usemtl", "s"};
  for (const char* keyword : kKeywords) {
    for (const FaceLabels& labels : mesh_.attributes.face_labels) {
      if (labels.keyword == keyword && !written_.contains(&labels)) {
        written_.insert(&labels);
        labels_.push_back(&labels);
        break;
      }
    }
  }
  current_.assign(labels_.size(), kNone);
}

/// A label as it can stand in a statement: "#" at the start of a word would begin a comment, a backslash at
/// the end would join the next line.
std::string ObjWriter::spelled(const std::string& label) {
  std::string text = label;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins_word =
        i == 0 || std::string_view(" \t\v\f").find(text[i - 1]) != std::string_view::npos;
    if ((text[i] == '#' && begins_word) || (text[i] == '\\' && i + 1 == text.size())) {
      text[i] = '_';
    }
  }
  changed_labels_ += text != label ? 1 : 0;
  return text;
}

void ObjWriter::write_labels(std::size_t triangle) {
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    const std::uint32_t label = labels_[i]->face_label[triangle];
    if (label != current_[i] && label != kNone) {
      append_lines(out_, labels_[i]->keyword + " ", {spelled(labels_[i]->labels[label])});
      current_[i] = label;
    }
  }
}

void ObjWriter::write_faces() {
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    write_labels(t);
    out_ += 'f';
    for (unsigned k = 0; k < 3; ++k) {
      const Index vertex = mesh_.triangles[t][k];
      const std::uint32_t texture = texture_.index_of(3 * t + k, vertex);
      const std::uint32_t normal = normal_.index_of(3 * t + k, vertex);
      out_ += ' ';
      append_integer(out_, std::size_t{vertex} + 1);
      if (texture != kNone || normal != kNone) {
        out_ += '/';
      }
      if (texture != kNone) {
        append_integer(out_, std::size_t{texture} + 1);
      }
      if (normal != kNone) {
        out_ += '/';
        append_integer(out_, std::size_t{normal} + 1);
      }
    }
    out_ += '\n';
  }
}

}  // namespace

EncodedMesh encode_obj(const TriangleMesh& mesh) {
  return ObjWriter(mesh).write();
}

}  // namespace isorelax
