#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/cells.h"

namespace isorelax {

/// Types of VTK's cells (vtkCellType.h) that stand for the lists of a polygonal data set.
enum class VtkCellType : std::uint8_t { poly_vertex = 2, poly_line = 4, triangle_strip = 6, polygon = 7 };

/// Cells one after another: cell i has the vertices from ends[i - 1] (0 for the first) up to, but without,
/// ends[i].
struct VtkCells {
  std::vector<std::size_t> ends;
  std::vector<Index> vertices;
};

/// Adds cells, with one type for each of them, or one for all. Returns why a cell cannot be taken, else an
/// empty text. Precondition: ends never decrease, the last is vertices.size(); vertices exist.
[[nodiscard]] std::string add_vtk_cells(const VtkCells& cells, std::span<const std::uint8_t> types,
                                        CellSorter& sorter);

}  // namespace isorelax
