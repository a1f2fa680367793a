#include "io/text_scanner.h"
#include "io/vtk_names.h"
#include "io/vtk_scanner.h"

namespace isorelax {

std::int64_t VtkScanner::integer(VtkType type, const char* what) {
  if (text_) {
    return scanner_.integer(what);
  }
  switch (type) {
    case VtkType::uint32:
      return scanner_.raw<std::uint32_t>(std::endian::big, what);
    case VtkType::int64:
    case VtkType::uint64:
      return scanner_.raw<std::int64_t>(std::endian::big, what);
    default:
      return scanner_.raw<std::int32_t>(std::endian::big, what);
  }
}

Index VtkScanner::vertex(VtkType type, std::size_t point_count) {
  const std::int64_t vertex = integer(type, "a vertex of a cell");
  if (vertex < 0 || static_cast<std::uint64_t>(vertex) >= point_count) {
    scanner_.fail("a cell names point " + std::to_string(vertex) + ", but there are " +
                  std::to_string(point_count) + " (numbered from 0)");
  }
  return static_cast<Index>(vertex);
}

VtkCells VtkScanner::cells(std::size_t point_count, bool since_version_5) {
  const std::uint64_t count = scanner_.count("the number of cells");
  const std::uint64_t size = scanner_.count("the size of a list of cells");
  return since_version_5 ? offset_cells(point_count, count, size) : counted_cells(point_count, count, size);
}

/// Each cell is the number of its vertices, then they; `size` counts all of these numbers.
VtkCells VtkScanner::counted_cells(std::size_t point_count, std::uint64_t count, std::uint64_t size) {
  begin_numbers();
  promise(VtkType::int32, size, "numbers of cells");
  if (count > size) {
    scanner_.fail("promises " + std::to_string(count) + " cells of " + std::to_string(size) +
                  " numbers in all");
  }
  VtkCells cells;
  cells.ends.reserve(count);
  cells.vertices.reserve(size - count);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t left = size - cells.vertices.size() - count;
    const std::int64_t vertices = integer(VtkType::int32, "the number of vertices of a cell");
    if (vertices < 0 || static_cast<std::uint64_t>(vertices) > left) {
      scanner_.fail("cell " + std::to_string(i) + " of a list promises " + std::to_string(vertices) +
                    " vertices, but the list has " + std::to_string(left) + " more");
    }
    for (std::int64_t k = 0; k < vertices; ++k) {
      cells.vertices.push_back(vertex(VtkType::int32, point_count));
    }
    cells.ends.push_back(cells.vertices.size());
  }
  if (cells.vertices.size() + count != size) {
    scanner_.fail("a list promises " + std::to_string(size) + " numbers, but its cells take " +
                  std::to_string(cells.vertices.size() + count));
  }
  return cells;
}

VtkType VtkScanner::index_type(const char* keyword) {
  const std::string_view word = scanner_.word();
  if (vtk_lower_case(word) != keyword) {
    scanner_.fail("expected '" + std::string(keyword) + "', found " + in_quotes(word));
  }
  const VtkType found = type();
  if (!is_whole(found) || binary_size(found, 1) < 4) {
    scanner_.fail("cells are numbered by whole numbers of 32 or 64 bits");
  }
  begin_numbers();
  return found;
}

/// First where each cell begins and the last one ends, then all vertices.
VtkCells VtkScanner::offset_cells(std::size_t point_count, std::uint64_t count, std::uint64_t size) {
  VtkCells cells;
  if (count == 0) {
    return cells;
  }
  const VtkType offset_type = index_type("offsets");
  promise(offset_type, count, "offsets");
  cells.ends.reserve(count - 1);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t least = cells.ends.empty() ? 0 : cells.ends.back();
    const std::int64_t end = integer(offset_type, "an offset");
    if (end < 0 || static_cast<std::uint64_t>(end) < least || static_cast<std::uint64_t>(end) > size ||
        (i == 0 && end != 0)) {
      scanner_.fail("offset " + std::to_string(i) + " of a list is " + std::to_string(end) +
                    ": offsets go up from 0 to " + std::to_string(size));
    }
    if (i > 0) {
      cells.ends.push_back(static_cast<std::size_t>(end));
    }
  }
  if ((cells.ends.empty() ? 0 : cells.ends.back()) != size) {
    scanner_.fail("the last offset of a list is not the number of its vertices, " + std::to_string(size));
  }
  const VtkType vertex_type = index_type("connectivity");
  promise(vertex_type, size, "vertices of cells");
  cells.vertices.reserve(size);
  for (std::uint64_t i = 0; i < size; ++i) {
    cells.vertices.push_back(vertex(vertex_type, point_count));
  }
  return cells;
}

}  // namespace isorelax
