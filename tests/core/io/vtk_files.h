#pragma once

#include <bit>
#include <string>
#include <vector>

#include "io/byte_order.h"

namespace isorelax {

/// What stands before the geometry of a legacy file.
inline std::string vtk_head(const std::string& version, const std::string& encoding,
                            const std::string& data_set) {
  return "# vtk DataFile Version " + version + "\nvtk output\n" + encoding + "\nDATASET " + data_set + "\n";
}

/// A square of four points as text.
inline constexpr char kVtkSquare[] = "POINTS 4 double\n0 0 0 1 0 0 0 1 0 1 1 0\n";

/// A text file with that square as two triangles and whatever follows.
inline std::string vtk_square(const std::string& rest = "") {
  return vtk_head("3.0", "ASCII", "POLYDATA") + kVtkSquare + "POLYGONS 2 8\n3 0 1 2\n3 2 1 3\n" + rest;
}

template <class T>
std::string numbers_in(std::endian order, const std::vector<T>& numbers) {
  std::string bytes;
  for (const T number : numbers) {
    append_bytes(bytes, number, order);
  }
  return bytes;
}

/// A DataArray of text.
inline std::string xml_array(const std::string& type, const std::string& name, unsigned width,
                             const std::string& numbers) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
         std::to_string(width) + "\" format=\"ascii\">" + numbers + "</DataArray>\n";
}

inline std::string xml_file(const std::string& type, const std::string& pieces,
                            const std::string& more = "") {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type + "\" " + more + ">\n<" + type + ">\n" + pieces +
         "</" + type + ">\n</VTKFile>\n";
}

inline std::string xml_points_of_square() {
  return "<Points>" + xml_array("Float64", "p", 3, "0 0 0 1 0 0 0 1 0 1 1 0") + "</Points>\n";
}

/// An unstructured grid of one piece: the square as two triangles, with this data.
inline std::string xml_square(const std::string& point_data = "", const std::string& cell_data = "") {
  return xml_file("UnstructuredGrid", "<Piece NumberOfPoints=\"4\" NumberOfCells=\"2\">\n<PointData>" +
                                          point_data + "</PointData>\n<CellData>" + cell_data +
                                          "</CellData>\n" + xml_points_of_square() + "<Cells>" +
                                          xml_array("Int64", "connectivity", 1, "0 1 2 2 1 3") +
                                          xml_array("Int64", "offsets", 1, "3 6") +
                                          xml_array("UInt8", "types", 1, "5 5") + "</Cells>\n</Piece>\n");
}

}  // namespace isorelax
