#include "io/vtk_cells.h"

#include <algorithm>
#include <array>
#include <optional>

namespace isorelax {
namespace {

struct VtkCellShape {
  std::uint8_t first_type, last_type;
  const char* name;
  CellKind kind;
  /// 0: any number.
  unsigned corners;
};

/// Straight cells, by type. An empty cell is a polygon without corners.
constexpr std::array<VtkCellShape, 11> kStraightCells{{{0, 0, "empty cell", CellKind::polygon, 0},
                                                       {1, 1, "vertex", CellKind::points, 1},
                                                       {2, 2, "polyvertex", CellKind::points, 0},
                                                       {3, 3, "line", CellKind::line, 2},
                                                       {4, 4, "polyline", CellKind::line, 0},
                                                       {5, 5, "triangle", CellKind::polygon, 3},
                                                       {6, 6, "triangle strip", CellKind::strip, 0},
                                                       {7, 7, "polygon", CellKind::polygon, 0},
                                                       {8, 8, "pixel", CellKind::pixel, 4},
                                                       {9, 9, "quadrilateral", CellKind::polygon, 4},
                                                       {10, 16, "volume", CellKind::volume, 0}}};

/// Curved cells of surfaces and lines: quadratic and cubic, parametric, of higher order, Lagrange, Bezier.
constexpr std::array<std::uint8_t, 22> kCurvedCells{21, 22, 23, 28, 30, 34, 35, 36, 51, 52, 53,
                                                    54, 60, 61, 62, 63, 68, 69, 70, 75, 76, 77};
/// Curved volumes of the same kinds, convex sets of points and polyhedra.
constexpr std::array<std::uint8_t, 25> kCurvedVolumes{24, 25, 26, 27, 29, 31, 32, 33, 37, 41, 42, 55, 56,
                                                      64, 65, 66, 67, 71, 72, 73, 74, 78, 79, 80, 81};

template <std::size_t size>
bool is_one_of(const std::array<std::uint8_t, size>& types, std::uint8_t type) {
  return std::find(types.begin(), types.end(), type) != types.end();
}

std::string add_vtk_cell(std::uint8_t type, std::span<const Index> vertices, CellSorter& sorter) {
  const std::string cell = "cell " + std::to_string(sorter.count());
  if (is_one_of(kCurvedVolumes, type)) {
    sorter.add(CellKind::volume, vertices);
    return "";
  }
  if (is_one_of(kCurvedCells, type)) {
    return cell + " is curved (type " + std::to_string(type) +
           "): only corners are moved here; save the mesh with straight cells first";
  }
  const auto* const shape =
      std::find_if(kStraightCells.begin(), kStraightCells.end(), [&](const VtkCellShape& candidate) {
        return candidate.first_type <= type && type <= candidate.last_type;
      });
  if (shape == kStraightCells.end()) {
    return cell + " is of the unknown type " + std::to_string(type);
  }
  if (shape->corners != 0 && vertices.size() != shape->corners) {
    return cell + " is a " + shape->name + " of " + std::to_string(vertices.size()) + " vertices";
  }
  sorter.add(shape->kind, vertices);
  return "";
}

}  // namespace

std::string add_vtk_cells(const VtkCells& cells, std::span<const std::uint8_t> types, CellSorter& sorter) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < cells.ends.size(); ++i) {
    const std::span<const Index> vertices(cells.vertices.data() + begin, cells.ends[i] - begin);
    begin = cells.ends[i];
    std::string refusal = add_vtk_cell(types.size() == 1 ? types[0] : types[i], vertices, sorter);
    if (!refusal.empty()) {
      return refusal;
    }
  }
  return "";
}

}  // namespace isorelax
