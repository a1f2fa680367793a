#include <algorithm>
#include <unordered_set>

#include "io/attribute_access.h"
#include "io/byte_order.h"
#include "io/mesh_file.h"
#include "io/msh_layout.h"
#include "io/text_out.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

/// Numbers in MSH 2 are 32-bit and positive.
constexpr double kLargestNumber = 2147483647.0;

/// Writes version 2.2. Elements are numbered from 1 on: points, lines, triangles.
class MshWriter {
 public:
  MshWriter(const TriangleMesh& mesh, FileEncoding encoding)
      : mesh_(mesh), binary_(encoding == FileEncoding::binary_little_endian) {
    const MeshAttributes& attributes = mesh.attributes;
    written_ = {&attributes.points, &attributes.lines};
    physical_ = take_numbers(kPhysicalGroup, kMshNoGroup);
    entity_ = take_numbers(kGeometricEntity, kMshOnlyEntity);
  }

  EncodedMesh write() {
    write_format();
    write_comments();
    write_names();
    write_nodes();
    write_elements();
    return {std::move(out_), report_not_written(mesh_.attributes, written_, FileFormat::msh)};
  }

 private:
  [[nodiscard]] std::vector<double> take_numbers(const char* name, double otherwise);
  void take_node_numbers();
  void write_format();
  void write_comments();
  void write_names();
  void write_nodes();
  void write_elements();
  void write_group(int type, unsigned corners, std::size_t count, const Index* vertices);

  void put(std::int64_t value) {
    if (binary_) return append_bytes(out_, static_cast<std::int32_t>(value), std::endian::little);
    out_ += std::to_string(value);
    out_ += ' ';
  }
  void end_row() {
    if (!binary_) out_.back() = '\n';
  }
  void end_section(const char* name) { out_ += std::string(binary_ ? "\n" : "") + name + "\n"; }

  const TriangleMesh& mesh_;
  bool binary_;
  WrittenParts written_;
  std::vector<double> physical_, entity_;  // of the points, the lines, the triangles
  std::vector<double> nodes_;              // numbers; empty: 1, 2, 3, ...
  std::size_t element_ = 0;
  std::string out_;
};

/// Of the points, the lines, the triangles; the same one for all of those that have none.
std::vector<double> MshWriter::take_numbers(const char* name, double otherwise) {
  const MeshAttributes& attributes = mesh_.attributes;
  std::vector<double> numbers;
  const auto take = [&](const std::vector<Attribute>& values, std::size_t count) {
    const auto found = std::ranges::find_if(values, [&](const Attribute& attribute) {
      return attribute.name == name && attribute.width == 1 &&
             fitting_type(attribute.values, ScalarType::int32) == ScalarType::int32;
    });
    if (found == values.end()) {
      numbers.insert(numbers.end(), count, otherwise);
    } else {
      numbers.insert(numbers.end(), found->values.begin(), found->values.end());
      written_.insert(&*found);
    }
  };
  take(attributes.points.values, attributes.points.count());
  take(attributes.lines.values, attributes.lines.count());
  take(attributes.face, mesh_.triangles.size());
  return numbers;
}

void MshWriter::take_node_numbers() {
  const Attribute* numbers = nullptr;
  for (const Attribute& attribute : mesh_.attributes.vertex)
    if (attribute.name == kMshNode && attribute.width == 1) numbers = &attribute;
  if (numbers == nullptr) return;
  std::unordered_set<double> seen;
  for (const double number : numbers->values) {
    const bool usable =
        number >= 1 && number <= kLargestNumber && number == static_cast<std::int32_t>(number);
    if (!usable || !seen.insert(number).second) return;
  }
  nodes_ = numbers->values;
  written_.insert(numbers);
}

void MshWriter::write_format() {
  out_ = "$MeshFormat\n2.2 " + std::string(binary_ ? "1" : "0") + " 8\n";
  if (binary_) append_bytes(out_, std::int32_t{1}, std::endian::little);
  end_section("$EndMeshFormat");
}

void MshWriter::write_comments() {
  const std::vector<std::string>& comments = mesh_.attributes.comments;
  const auto ends = [](const std::string& text) { return text.find("$End") != std::string::npos; };
  if (comments.empty() || std::ranges::any_of(comments, ends)) return;
  written_.insert(&comments);
  out_ += "$Comments\n";
  append_lines(out_, "", comments);
  out_ += "$EndComments\n";
}

void MshWriter::write_names() {
  std::vector<std::string> names;
  for (const std::string& line : mesh_.attributes.header_lines) {
    if (!line.starts_with(kMshNames)) continue;
    names.push_back(line.substr(std::string_view(kMshNames).size()));
    written_.insert(&line);
  }
  if (names.empty()) return;
  out_ += "$PhysicalNames\n" + std::to_string(names.size()) + "\n";
  append_lines(out_, "", names);
  out_ += "$EndPhysicalNames\n";
}

void MshWriter::write_nodes() {
  take_node_numbers();
  out_ += "$Nodes\n" + std::to_string(mesh_.positions.size()) + "\n";
  for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
    put(nodes_.empty() ? static_cast<std::int64_t>(v + 1) : static_cast<std::int64_t>(nodes_[v]));
    for (const double x : mesh_.positions[v]) {
      if (binary_) {
        append_bytes(out_, x, std::endian::little);
      } else {
        append_number(out_, x);
        out_ += ' ';
      }
    }
    end_row();
  }
  end_section("$EndNodes");
}

void MshWriter::write_elements() {
  const MeshAttributes& attributes = mesh_.attributes;
  out_ += "$Elements\n" + std::to_string(physical_.size()) + "\n";
  write_group(kMshPoint, 1, attributes.points.count(), attributes.points.vertices.data());
  write_group(kMshLine, 2, attributes.lines.count(), attributes.lines.vertices.data());
  write_group(kMshTriangle, 3, mesh_.triangles.size(), mesh_.triangles.data()->data());
  end_section("$EndElements");
}

void MshWriter::write_group(int type, unsigned corners, std::size_t count, const Index* vertices) {
  constexpr int kTags = 2;
  if (binary_ && count > 0) {
    put(type);
    put(static_cast<std::int64_t>(count));
    put(kTags);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t e = element_++;
    put(static_cast<std::int64_t>(e + 1));
    if (!binary_) {
      put(type);
      put(kTags);
    }
    put(static_cast<std::int64_t>(physical_[e]));
    put(static_cast<std::int64_t>(entity_[e]));
    for (unsigned k = 0; k < corners; ++k) {
      const Index v = vertices[corners * i + k];
      put(nodes_.empty() ? std::int64_t{v} + 1 : static_cast<std::int64_t>(nodes_[v]));
    }
    end_row();
  }
}

}  // namespace

EncodedMesh encode_msh(const TriangleMesh& mesh, FileEncoding encoding) {
  if (encoding == FileEncoding::binary_big_endian)
    throw UsageError("MSH is written as text or little-endian binary");
  constexpr std::size_t kMost = 2147483647;
  if (mesh.positions.size() > kMost || mesh.triangles.size() > kMost)
    throw MeshError("MSH 2.2 has no place for more than 2147483647 nodes or elements");
  return MshWriter(mesh, encoding).write();
}

}  // namespace isorelax
