#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/cells.h"
#include "io/polygon_soup.h"
#include "io/vtk_cells.h"
#include "io/vtk_numbers.h"

namespace isorelax {

/// The arrays that hang on the points of a file, or on its cells. A file may come in pieces; an array goes
/// through all of them or is left out.
class VtkData {
 public:
  /// `element`: "point" or "cell".
  explicit VtkData(const char* element) : element_(element) {}

  /// One array of the current piece, with one row for each of its elements.
  void add(VtkArray&& array);
  void end_piece() { ++pieces_; }

  /// The arrays that are whole; the rest is said in `messages`.
  [[nodiscard]] std::vector<Attribute> finish(std::vector<std::string>& messages);

 private:
  struct Column {
    Attribute attribute;
    VtkType type;
    /// Pieces that had it, one after another from the first.
    std::size_t pieces = 0;
    std::size_t rounded = 0;
    bool twice = false;
  };

  const char* element_;
  std::vector<Column> columns_;
  std::map<std::string, std::size_t> places_;
  std::size_t pieces_ = 0;
  std::size_t unusable_ = 0;
};

/// What both kinds of VTK file come down to.
class VtkSurface {
 public:
  /// Takes three numbers for each point. Precondition: they are finite, and fewer than 2^32 points in all.
  void add_positions(const VtkArray& positions);
  /// Same as add_vtk_cells.
  [[nodiscard]] std::string add_cells(const VtkCells& cells, std::span<const std::uint8_t> types);

  [[nodiscard]] std::size_t point_count() const { return raw_.positions.size(); }
  [[nodiscard]] std::size_t cell_count() const { return cells_.count(); }
  [[nodiscard]] VtkData& point_data() { return point_data_; }
  [[nodiscard]] VtkData& cell_data() { return cell_data_; }
  [[nodiscard]] std::vector<std::string>& messages() { return raw_.messages; }
  [[nodiscard]] std::vector<std::string>& comments() { return raw_.attributes.comments; }

  RawMesh finish();

 private:
  RawMesh raw_;
  CellSorter cells_;
  std::size_t corners_ = 0;
  VtkData point_data_{"point"}, cell_data_{"cell"};
};

}  // namespace isorelax
