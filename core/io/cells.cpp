#include "io/cells.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "io/attribute_access.h"
#include "io/text_scanner.h"

namespace isorelax {

void CellSorter::add(CellKind kind, std::span<const Index> vertices) {
  const auto size = static_cast<std::uint32_t>(vertices.size());
  switch (kind) {
    case CellKind::points:
      empty_points_ += vertices.empty() ? 1 : 0;
      points_.vertices.insert(points_.vertices.end(), vertices.begin(), vertices.end());
      cells_.push_back({Part::points, size});
      return;
    case CellKind::line:
      return add_line(vertices);
    case CellKind::polygon:
      faces_.vertices.insert(faces_.vertices.end(), vertices.begin(), vertices.end());
      faces_.end_face();
      cells_.push_back({Part::faces, 1});
      return;
    case CellKind::strip:
      return add_strip(vertices);
    case CellKind::pixel:
      faces_.vertices.insert(faces_.vertices.end(), {vertices[0], vertices[1], vertices[3], vertices[2]});
      faces_.end_face();
      cells_.push_back({Part::faces, 1});
      return;
    case CellKind::volume:
      ++volumes_;
      cells_.push_back({Part::none, 0});
      return;
  }
}

void CellSorter::add_line(std::span<const Index> vertices) {
  if (vertices.size() < 2) {
    ++short_lines_;
    cells_.push_back({Part::none, 0});
    return;
  }
  const auto pieces = static_cast<std::uint32_t>(vertices.size() - 1);
  for (std::uint32_t k = 0; k < pieces; ++k)
    lines_.vertices.insert(lines_.vertices.end(), {vertices[k], vertices[k + 1]});
  if (pieces > 1) {
    ++polylines_;
    polyline_pieces_ += pieces;
  }
  cells_.push_back({Part::lines, pieces});
}

void CellSorter::add_strip(std::span<const Index> vertices) {
  const std::uint32_t pieces = vertices.size() < 3 ? 0 : static_cast<std::uint32_t>(vertices.size() - 2);
  for (std::uint32_t k = 0; k < pieces; ++k) {
    // Every other triangle of a strip goes round the other way.
    const std::uint32_t swap = k % 2;
    faces_.vertices.insert(faces_.vertices.end(),
                           {vertices[k + swap], vertices[k + 1 - swap], vertices[k + 2]});
    faces_.end_face();
  }
  ++strips_;
  strip_pieces_ += pieces;
  cells_.push_back({Part::faces, pieces});
}

/// The rows of the cells that went there, once for each piece.
std::vector<double> CellSorter::rows_of(Part part, const Attribute& values) const {
  std::vector<double> rows;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (cells_[c].part != part) continue;
    const auto row = values.values.begin() + static_cast<std::ptrdiff_t>(c * values.width);
    for (std::uint32_t piece = 0; piece < cells_[c].pieces; ++piece)
      rows.insert(rows.end(), row, row + values.width);
  }
  return rows;
}

/// Elements that come of all cells once faces are cut into triangles, too.
std::size_t CellSorter::element_count() const {
  std::size_t count = points_.count() + lines_.count();
  for (std::size_t f = 0; f < faces_.face_count(); ++f) {
    const std::uint32_t corners = faces_.first_corner[f + 1] - faces_.first_corner[f];
    count += corners < 3 ? 0 : corners - 2;
  }
  return count;
}

void CellSorter::finish(RawMesh& raw) {
  // Every piece of a cell repeats its values: one cell of very many corners that has very many values would
  // take the square of what its file does.
  constexpr std::size_t kFew = std::size_t{1} << 24U;
  constexpr std::size_t kPiecesPerCell = 64;
  const std::size_t elements = element_count();
  std::size_t allowed = kFew;
  for (const Attribute& values : values_) {
    if (elements > cells_.size() * kPiecesPerCell && elements * values.width > allowed) {
      raw.messages.push_back("cell values " + in_quotes(values.name) +
                             " left out: " + counted(cells_.size(), "cell", "cells") + " cut into " +
                             std::to_string(elements) + " would repeat them too often");
      continue;
    }
    allowed -= std::min(allowed, elements * values.width);
    const auto attribute_of = [&](Part part) {
      return Attribute{values.name, values.type, values.width, rows_of(part, values)};
    };
    raw.attributes.face.push_back(attribute_of(Part::faces));
    if (points_.count() > 0) points_.values.push_back(attribute_of(Part::points));
    if (lines_.count() > 0) lines_.values.push_back(attribute_of(Part::lines));
  }
  raw.faces = std::move(faces_);
  raw.attributes.points = std::move(points_);
  raw.attributes.lines = std::move(lines_);
  if (volumes_ > 0) {
    raw.messages.push_back(counted(volumes_, "volume cell", "volume cells") +
                           " left out: what is read is the surface");
  }
  if (polylines_ > 0) {
    raw.messages.push_back(counted(polylines_, "polyline", "polylines") + " cut into " +
                           std::to_string(polyline_pieces_) + " lines");
  }
  if (strips_ > 0) {
    raw.messages.push_back(counted(strips_, "triangle strip", "triangle strips") + " cut into " +
                           std::to_string(strip_pieces_) + " triangles");
  }
  if (short_lines_ > 0)
    raw.messages.push_back(counted(short_lines_, "line", "lines") + " of fewer than two vertices left out");
  if (empty_points_ > 0)
    raw.messages.push_back(counted(empty_points_, "set", "sets") + " of points without a point left out");
}

namespace {

/// Values of the same name and width belong together.
using ValuesKey = std::pair<std::string_view, unsigned>;

std::map<ValuesKey, const Attribute*> by_key(const std::vector<Attribute>& attributes) {
  std::map<ValuesKey, const Attribute*> values;
  for (const Attribute& attribute : attributes)
    values.try_emplace({attribute.name, attribute.width}, &attribute);
  return values;
}

}  // namespace

std::vector<Attribute> cell_values(const TriangleMesh& mesh, std::vector<std::string>& messages) {
  struct Group {
    const char* noun;
    std::size_t count;
    const std::vector<Attribute>* values;
    std::map<ValuesKey, const Attribute*> found;
  };
  const MeshAttributes& attributes = mesh.attributes;
  const auto group = [](const char* noun, std::size_t count, const std::vector<Attribute>& values) {
    return Group{noun, count, &values, by_key(values)};
  };
  const std::array<Group, 3> groups{group("points", attributes.points.count(), attributes.points.values),
                                    group("lines", attributes.lines.count(), attributes.lines.values),
                                    group("triangles", mesh.triangles.size(), attributes.face)};
  std::vector<Attribute> merged;
  std::set<ValuesKey> done;
  for (const Group& named : groups) {
    for (const Attribute& wanted : *named.values) {
      const ValuesKey key{wanted.name, wanted.width};
      if (!done.insert(key).second) continue;
      Attribute all{wanted.name, wanted.type, wanted.width, {}};
      for (const Group& other : groups) {
        if (const auto found = other.found.find(key); found != other.found.end()) {
          const Attribute& values = *found->second;
          if (values.type != all.type) all.type = ScalarType::float64;
          all.values.insert(all.values.end(), values.values.begin(), values.values.end());
          continue;
        }
        all.values.insert(all.values.end(), other.count * wanted.width, 0.0);
        if (other.count > 0)
          messages.push_back(std::string(other.noun) + " have no value of " + in_quotes(wanted.name) +
                             ": written as 0");
      }
      all.type = fitting_type(all.values, all.type);
      merged.push_back(std::move(all));
    }
  }
  return merged;
}

}  // namespace isorelax
