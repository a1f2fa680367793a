#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/polygon_soup.h"

namespace isorelax {

/// What a cell of a file with many kinds of cells is to a surface.
enum class CellKind : std::uint8_t {
  points,   ///< one point for each vertex
  line,     ///< through its vertices
  polygon,  ///< three corners or more
  strip,    ///< of triangles
  pixel,    ///< four corners, row by row
  volume,   ///< none of a surface: left out
};

/// Sorts cells of all kinds, and what the file says about each of them, into the parts of a RawMesh: faces,
/// points and lines beside them. Cells are numbered as they come.
class CellSorter {
 public:
  /// Precondition: vertices exist, four of them for a pixel; fewer than 2^32 corners in all.
  void add(CellKind kind, std::span<const Index> vertices);
  [[nodiscard]] std::size_t count() const { return cells_.size(); }
  /// Values of the cells added so far, one row for each. Precondition: so many there are.
  void add_values(Attribute values) { values_.push_back(std::move(values)); }

  /// Moves everything into `raw`, and says there what was cut or left out.
  void finish(RawMesh& raw);

 private:
  enum class Part : std::uint8_t { points, lines, faces, none };
  static constexpr std::size_t kParts = 3;
  /// Where a cell went, and as how many pieces.
  struct Cell {
    Part part;
    std::uint32_t pieces;
  };
  void add_line(std::span<const Index> vertices);
  void add_strip(std::span<const Index> vertices);
  [[nodiscard]] std::size_t element_count() const;
  [[nodiscard]] std::vector<double> rows_of(Part part, const Attribute& values) const;

  std::vector<Cell> cells_;
  std::vector<Attribute> values_;
  PolygonSoup faces_;
  LowerElements points_{1, {}, {}}, lines_{2, {}, {}};
  std::size_t volumes_ = 0, polylines_ = 0, polyline_pieces_ = 0, strips_ = 0, strip_pieces_ = 0,
              short_lines_ = 0, empty_points_ = 0;
};

/// The values of all cells for a format that knows only one kind of cell: of the points, then the lines, then
/// the triangles. A name that one of these lacks has zeros there, said in `messages`.
[[nodiscard]] std::vector<Attribute> cell_values(const TriangleMesh& mesh,
                                                 std::vector<std::string>& messages);

}  // namespace isorelax
