#include "io/vtk_surface.h"

#include <utility>

#include "io/text_scanner.h"

namespace isorelax {

void VtkData::add(VtkArray&& array) {
  if (array.name.empty() || array.width == 0) {
    ++unusable_;
    return;
  }
  const auto [found, is_new] = places_.try_emplace(array.name, columns_.size());
  if (is_new) {
    columns_.push_back(
        {{array.name, kept_type(array.type), static_cast<unsigned>(array.width), {}}, array.type});
  }
  Column& column = columns_[found->second];
  if (column.pieces > pieces_) {
    column.twice = true;
    return;
  }
  if (column.pieces < pieces_ || column.attribute.width != array.width) {
    return;
  }
  if (column.type != array.type) {
    column.attribute.type = ScalarType::float64;
  }
  ++column.pieces;
  column.rounded += array.rounded;
  std::vector<double>& values = column.attribute.values;
  if (values.empty()) {
    values = std::move(array.values);
  } else {
    values.insert(values.end(), array.values.begin(), array.values.end());
  }
}

std::vector<Attribute> VtkData::finish(std::vector<std::string>& messages) {
  std::vector<Attribute> whole;
  for (Column& column : columns_) {
    const std::string array = std::string(element_) + " array " + in_quotes(column.attribute.name);
    if (column.pieces < pieces_) {
      messages.push_back(array + " left out: not every piece has it in the same width");
      continue;
    }
    if (column.twice) {
      messages.push_back("a second " + array + " left out");
    }
    if (column.rounded > 0) {
      messages.push_back(counted(column.rounded, "whole number", "whole numbers") + " of the " + array +
                         " rounded to double precision");
      column.attribute.type = ScalarType::float64;
    }
    whole.push_back(std::move(column.attribute));
  }
  if (unusable_ > 0) {
    messages.push_back(counted(unusable_, "array", "arrays") + " of the " + element_ +
                       "s without a name or a component left out");
  }
  return whole;
}

void VtkSurface::add_positions(const VtkArray& positions) {
  const ScalarType type = kept_type(positions.type);
  ScalarType& of_all = raw_.attributes.position_type;
  of_all = raw_.positions.empty() || of_all == type ? type : ScalarType::float64;
  if (raw_.positions.empty()) {  // of many pieces, each would move all before it
    raw_.positions.reserve(positions.values.size() / 3);
  }
  for (std::size_t i = 0; i + 2 < positions.values.size(); i += 3) {
    raw_.positions.emplace_back(positions.values[i], positions.values[i + 1], positions.values[i + 2]);
  }
}

std::string VtkSurface::add_cells(const VtkCells& cells, std::span<const std::uint8_t> types) {
  corners_ += cells.vertices.size();
  // A strip of n vertices becomes triangles with fewer than 3 n corners.
  if (corners_ >= kNone / 3) {
    return "the cells have more corners than can be held";
  }
  return add_vtk_cells(cells, types, cells_);
}

RawMesh VtkSurface::finish() {
  raw_.attributes.vertex = point_data_.finish(raw_.messages);
  for (Attribute& values : cell_data_.finish(raw_.messages)) {
    cells_.add_values(std::move(values));
  }
  cells_.finish(raw_);
  return std::move(raw_);
}

}  // namespace isorelax
