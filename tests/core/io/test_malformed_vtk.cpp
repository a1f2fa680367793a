#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/io/malformed.h"
#include "core/io/mesh_samples.h"
#include "core/io/vtk_files.h"
#include "io/mesh_file.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

/// As Malformed; those whose names begin with "xml_" are for the reader of XML.
struct MalformedVtk {
  const char* name;
  std::string bytes;
  const char* place;
  const char* reason;
};

// The name by which GoogleTest finds it.
void PrintTo(const MalformedVtk& file, std::ostream* out) {  // NOLINT(readability-identifier-naming)
  *out << file.name;
}

const std::string kPoly = vtk_head("3.0", "ASCII", "POLYDATA");
const std::string kGrid = vtk_head("3.0", "ASCII", "UNSTRUCTURED_GRID") + kVtkSquare;
const std::string kFive = vtk_head("5.1", "ASCII", "POLYDATA") + kVtkSquare;
const std::string kBinary = vtk_head("3.0", "BINARY", "POLYDATA");

std::vector<MalformedVtk> malformed_headers() {
  return {
      {"empty", "", "line 1", "expected '# vtk DataFile Version'"},
      {"version", "# vtk DataFile Version 6.0\n\nASCII\n", "line 1", "version '6.0' is not read"},
      {"version_word", "# vtk DataFile Version x\n\nASCII\n", "line 1", "version 'x'"},
      {"encoding", "# vtk DataFile Version 3.0\n\nEBCDIC\n", "line 3", "found 'EBCDIC'"},
      {"no_data_set", "# vtk DataFile Version 3.0\n\nASCII\nPOINTS 3 float\n", "line 4", "expected DATASET"},
      {"other_data_set", vtk_head("3.0", "ASCII", "STRUCTURED_GRID"), "line 4",
       "'STRUCTURED_GRID'; POLYDATA and UNSTRUCTURED_GRID are read"},
      {"keyword", kPoly + "CELLS 1 4\n", "line 5", "unknown keyword 'CELLS'"},
      {"data_keyword_before_data", kPoly + "NORMALS n float\n", "line 5", "unknown keyword"},
      {"twice", kPoly + kVtkSquare + kVtkSquare, "line 7", "'points' stands twice"},
      {"geometry_after_data", vtk_square("POINT_DATA 4\nLINES 1 3\n2 0 1\n"), "line 11", "after the data"},
      {"no_points", kPoly, "", "holds no vertices"},
      {"no_triangles", kPoly + kVtkSquare, "", "holds no triangles"},
  };
}

std::vector<MalformedVtk> malformed_geometry() {
  return {
      {"lying_points", kPoly + "POINTS 4000000000 float\n0 0 0\n", "line 5", "promises 12000000000 numbers"},
      {"too_many_points", kPoly + "POINTS 9000000000 float\n", "line 5", "more than can be held"},
      {"lying_points_binary", kBinary + "POINTS 1000000000 double\n1234", "line 5", "only 4 bytes follow"},
      {"points_type", kPoly + "POINTS 1 quad\n", "line 5", "unknown type of numbers: 'quad'"},
      {"nan", kPoly + "POINTS 3 float\n0 0 0\n1 nan 0\n0 1 0\n", "line 7", "point 1 is not a number"},
      {"infinite", kPoly + "POINTS 3 double\n0 0 0\n1 0 1e999\n0 1 0\n", "line 7", "infinite or too large"},
      {"nan_binary", kBinary + "POINTS 1 float\n" + "\x7f\xc0" + std::string(10, '\0'), "byte ",
       "point 0 is not a number"},
      {"word", kPoly + "POINTS 1 float\n0 zero 0\n", "line 6", "not a number: 'zero'"},
      {"truncated_points", kPoly + "POINTS 1 float\n0   0", "line 6", "the file ends"},
      {"index_too_large", kPoly + kVtkSquare + "POLYGONS 1 4\n3 0 1 4\n", "line 8",
       "names point 4, but there are 4 (numbered from 0)"},
      {"index_negative", kPoly + kVtkSquare + "LINES 1 3\n2 0 -1\n", "line 8", "names point -1"},
      {"cells_before_points", kPoly + "POLYGONS 1 4\n3 0 1 2\n", "line 6", "but there are 0"},
      {"lying_list", kPoly + kVtkSquare + "POLYGONS 1 4000000000\n3 0 1 2\n", "line 7",
       "promises 4000000000"},
      {"lying_cells", kPoly + kVtkSquare + "POLYGONS 9 4\n3 0 1 2\n", "line 7", "promises 9 cells"},
      {"lying_cell", kPoly + kVtkSquare + "POLYGONS 1 4\n9 0 1 2\n", "line 8", "promises 9 vertices"},
      {"list_too_long", kPoly + kVtkSquare + "POLYGONS 1 5\n3 0 1 2 3\n", "line 8", "promises 5 numbers"},
      {"truncated_list", kPoly + kVtkSquare + "POLYGONS 1 4\n3   0  1", "line 8", "the file ends where"},
      {"truncated_binary_list", kBinary + "POINTS 0 float\n\nLINES 1 2\n1234567", "byte ", "7 bytes follow"},
      {"missing_types", kGrid + "CELLS 1 4\n3 0 1 2\n", "line 9", "1 cells have 0 types"},
      {"unknown_type", kGrid + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n99\n", "line 11", "unknown type 99"},
      {"large_type", kGrid + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n256\n", "line 10", "is unknown: 256"},
      {"curved", kGrid + "CELLS 1 7\n6 0 1 2 0 1 2\nCELL_TYPES 1\n22\n", "line 11",
       "cell 0 is curved (type 22): only corners are moved here"},
      {"corners_of_type", kGrid + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n5\n", "line 11",
       "cell 0 is a triangle of 4 vertices"},
      {"only_volumes", kGrid + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n", "", "holds no triangles"},
      {"offsets_missing", kFive + "POLYGONS 2 3\n3 0 1 2\n", "line 8", "expected 'offsets', found '3'"},
      {"offsets_of_fractions", kFive + "POLYGONS 2 3\nOFFSETS float\n0 3\n", "line 8", "whole numbers of 32"},
      {"offsets_go_down", kFive + "POLYGONS 3 3\nOFFSETS vtktypeint64\n0 3 2\n", "line 9",
       "offset 2 of a list"},
      {"offsets_begin", kFive + "POLYGONS 2 3\nOFFSETS vtktypeint64\n1 3\n", "line 9",
       "offset 0 of a list is 1"},
      {"offsets_end", kFive + "POLYGONS 2 3\nOFFSETS vtktypeint64\n0 2\n", "line 9", "the last offset"},
      {"lying_offsets", kFive + "POLYGONS 4000000000 3\nOFFSETS vtktypeint64\n0 3\n", "line 8",
       "4000000000 offsets"},
      {"lying_connectivity",
       kFive + "POLYGONS 2 4000000000\nOFFSETS vtktypeint64\n0 4000000000\nCONNECTIVITY "
               "vtktypeint64\n0 1\n",
       "line 10", "4000000000 vertices"},
  };
}

std::vector<MalformedVtk> malformed_data() {
  return {
      {"rows", vtk_square("POINT_DATA 5\n"), "line 10", "data for 5 points, but there are 4"},
      {"cell_rows", vtk_square("CELL_DATA 1\n"), "line 10", "data for 1 cells, but there are 2"},
      {"attribute", vtk_square("CELL_DATA 2\nFLAVOURS a int\n"), "line 11", "unknown keyword 'FLAVOURS'"},
      {"scalars_without_table", vtk_square("CELL_DATA 2\nSCALARS a int\n1 2\n"), "line 12", "LOOKUP_TABLE"},
      {"scalars_width", vtk_square("CELL_DATA 2\nSCALARS a int x\n"), "line 11", "'x'"},
      {"data_word", vtk_square("CELL_DATA 2\nVECTORS a int\n1 2 3 4 5 x\n"), "line 12", "none: 'x'"},
      {"data_truncated", vtk_square("CELL_DATA 2\nVECTORS a int\n1 2  3 4 5"), "line 12", "after 5 of 6"},
      {"lying_field", vtk_square("CELL_DATA 2\nFIELD f 9\na 1 2 int\n1 2\n"), "line 14", "the file ends"},
      {"lying_width", vtk_square("CELL_DATA 2\nFIELD f 1\na 4000000000 2 int\n1 2\n"), "line 12",
       "promises 8000000000"},
      {"huge_width", vtk_square("CELL_DATA 2\nFIELD f 1\na 5000000000 0 int\n1 2\n"), "line 12",
       "components"},
      {"lying_rows",
       vtk_square("CELL_DATA 2\nFIELD f 1\na 9223372036854775807 9223372036854775807 bit\n1 2\n"), "line 12",
       "components"},
      {"lying_texts", vtk_square("CELL_DATA 2\nFIELD f 1\na 1 4000000000 string\nb\n"), "line 12",
       "4000000000"},
      {"lying_text", kBinary + "FIELD f 1\na 1 1 string\n\x3f\xff\xff\xff\xff\xff\xff\xff", "byte ",
       "within a text"},
      {"variant", vtk_square("CELL_DATA 2\nFIELD f 1\na 1 2 variant\n"), "line 12", "'variant'"},
  };
}

const std::string kOnePoint = "<Piece NumberOfPoints=\"1\" NumberOfCells=\"0\">";

std::string replaced(std::string text, const std::string& part, const std::string& other) {
  return text.replace(text.find(part), part.size(), other);
}

std::string appended(const std::string& offset, const std::string& data, const std::string& rows = "1",
                     const std::string& more = "header_type=\"UInt32\"") {
  return replaced(xml_file("UnstructuredGrid",
                           "<Piece NumberOfPoints=\"" + rows +
                               "\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
                               "format=\"appended\" offset=\"" +
                               offset + "\"/></Points></Piece>",
                           more),
                  "</VTKFile>", "<AppendedData encoding=\"raw\">_" + data + "</AppendedData></VTKFile>");
}

std::vector<MalformedVtk> malformed_xml() {
  return {
      {"xml_empty", "", "line 1", "is not XML"},
      {"xml_cut", "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">\n<PolyData>\n", "line 3",
       "is not XML"},
      {"xml_other", "<svg/>", "line 1", "expected the element VTKFile, found 'svg'"},
      {"xml_parallel", xml_file("PPolyData", ""), "line 2", "'PPolyData'; PolyData and UnstructuredGrid"},
      {"xml_image", xml_file("ImageData", ""), "line 2", "the data set is a 'ImageData'"},
      {"xml_compressor", xml_file("PolyData", "", "compressor=\"vtkLZ4DataCompressor\""), "line 2",
       "'vtkLZ4DataCompressor'"},
      {"xml_order", xml_file("PolyData", "", "byte_order=\"Middle\""), "line 2", "'Middle'"},
      {"xml_header", xml_file("PolyData", "", "header_type=\"UInt8\""), "line 2", "'UInt8'"},
      {"xml_no_piece", xml_file("PolyData", ""), "", "holds no vertices"},
      {"xml_no_points", xml_file("UnstructuredGrid", kOnePoint + "</Piece>"), "line 4", "no array of them"},
      {"xml_count", xml_file("PolyData", "<Piece NumberOfPoints=\"-1\"/>"), "line 4", "'-1'"},
      {"xml_two_coordinates",
       replaced(replaced(xml_square(), "NumberOfComponents=\"3\"", "NumberOfComponents=\"2\""),
                "0 0 0 1 0 0 0 1 0 1 1 0", "0 0 0 1 0 0 0 1"),
       "line 7", "points have 2 coordinates"},
      {"xml_lying_points", replaced(xml_square(), "Points=\"4\"", "Points=\"4000000000\""), "line 7",
       "12000000000 numbers"},
      {"xml_too_many_points", replaced(xml_square(), "Points=\"4\"", "Points=\"5000000000\""), "line 4",
       "more than can be held"},
      {"xml_few_numbers", replaced(xml_square(), "0 1 1 0<", "0 1 1  <"), "line 7", "after 11 of 12"},
      {"xml_many_numbers", replaced(xml_square(), "0 1 1 0<", "0 1 1 0 0<"), "line 7", "more follow"},
      {"xml_nan", replaced(xml_square(), "0 1 1 0<", "0 1 nan 0<"), "line 7",
       "point 3 is not a number (NaN)"},
      {"xml_word", replaced(xml_square(), "0 1 1 0<", "0 1 x 0<"), "line 7", "'x'"},
      {"xml_type", replaced(xml_square(), "Float64", "Float65"), "line 7", "'Float65'"},
      {"xml_format", replaced(xml_square(), "ascii", "morse"), "line 7", "'morse'"},
      {"xml_index", replaced(xml_square(), "0 1 2 2 1 3", "0 1 2 2 1 4"), "line 9", "names point 4"},
      {"xml_index_negative", replaced(xml_square(), "0 1 2 2 1 3", "0 1 2 2 1 -3"), "line 9",
       "names point -3"},
      {"xml_index_fraction", replaced(xml_square(), "0 1 2 2 1 3", "0 1 2 2 1 .5"), "line 9",
       "whole numbers"},
      {"xml_offsets", replaced(xml_square(), ">3 6<", ">6 3<"), "line 9", "go up from 0"},
      {"xml_lying_offset", replaced(xml_square(), ">3 6<", ">3 9000000000<"), "line 9", "9000000000 numbers"},
      {"xml_no_types", replaced(xml_square(), "\"types\"", "\"other\""), "line 9", "has no array 'types'"},
      {"xml_cell_type", replaced(xml_square(), ">5 5<", ">5 300<"), "line 9", "unknown type"},
      {"xml_curved", replaced(xml_square(), ">5 5<", ">5 69<"), "line 4", "cell 1 is curved (type 69)"},
      {"xml_data_rows", xml_square(xml_array("Float32", "a", 1, "1 2 3")), "line 5", "4 numbers"},
      {"xml_lying_width", xml_square(xml_array("Float32", "a", 4000000000U, "1 2 3 4")), "line 5",
       "16000000000"},
      {"xml_base64", replaced(replaced(xml_square(), "0 0 0 1 0 0 0 1 0 1 1 0", "AQ!="), "ascii", "binary"),
       "line 7", "not encoded as the file says"},
      {"xml_no_underscore", replaced(appended("0", "x"), "_x", "x"), "line ", "does not begin with '_'"},
      {"xml_cut_appended", replaced(appended("0", "x"), "</AppendedData></VTKFile>", ""), "line ",
       "ends within AppendedData"},
      {"xml_offset", appended("9", "12345678"), "line 4", "byte 9 of AppendedData, which has 8"},
      {"xml_size", appended("0", std::string("\x17\0\0\0", 4) + std::string(23, '\0')), "line 4",
       "23 bytes where 24 are needed"},
      {"xml_lying_size", appended("0", std::string("\0\x5e\xd0\xb2", 4), "125000000"), "line 4", "end early"},
      {"xml_shared_bytes",
       replaced(appended("0", std::string("\x18\0\0\0", 4) + std::string(24, '\0')), "</Piece>",
                "<PointData><DataArray type=\"Float64\" Name=\"a\" NumberOfComponents=\"3\" "
                "format=\"appended\" offset=\"0\"/></PointData></Piece>"),
       "line 4", "the arrays take more bytes than AppendedData has"},
      {"xml_bomb",
       appended("0", numbers_in<std::uint32_t>(std::endian::little, {1, 2400000000U, 0, 8}) + "12345678",
                "100000000", "compressor=\"vtkZLibDataCompressor\""),
       "line 4", "cannot inflate"},
      {"xml_blocks",
       appended("0", numbers_in<std::uint32_t>(std::endian::little, {4000000000U, 24, 0, 8}), "1",
                "compressor=\"vtkZLibDataCompressor\""),
       "line 4", "end early"},
      {"xml_not_zlib",
       appended("0", numbers_in<std::uint32_t>(std::endian::little, {1, 24, 0, 8}) + "12345678", "1",
                "compressor=\"vtkZLibDataCompressor\""),
       "line 4", "not what zlib wrote"},
  };
}

class MalformedVtkFile : public testing::TestWithParam<MalformedVtk> {};

TEST_P(MalformedVtkFile, IsRefusedOnOneLineWithFilePlaceAndReason) {
  const MalformedVtk& file = GetParam();
  const bool xml = std::string(file.name).starts_with("xml_");
  expect_refused({file.name, xml ? read_vtk_xml : read_vtk, file.bytes, file.place, file.reason});
}

std::string vtk_case(const testing::TestParamInfo<MalformedVtk>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Headers, MalformedVtkFile, testing::ValuesIn(malformed_headers()), vtk_case);
INSTANTIATE_TEST_SUITE_P(Geometry, MalformedVtkFile, testing::ValuesIn(malformed_geometry()), vtk_case);
INSTANTIATE_TEST_SUITE_P(Data, MalformedVtkFile, testing::ValuesIn(malformed_data()), vtk_case);
INSTANTIATE_TEST_SUITE_P(Xml, MalformedVtkFile, testing::ValuesIn(malformed_xml()), vtk_case);

TEST(MalformedVtkFile, EveryBeginningOfAFileIsRefusedOrRead) {
  const TriangleMesh mesh = hard_numbers();
  const std::vector<std::pair<decltype(&read_vtk), std::string>> files = {
      {read_vtk, encode_vtk(mesh, FileEncoding::text).bytes},
      {read_vtk, encode_vtk(mesh, FileEncoding::binary_big_endian).bytes},
      {read_vtk_xml, encode_vtp(mesh, FileEncoding::text).bytes},
      {read_vtk_xml, encode_vtu(mesh, FileEncoding::binary_little_endian).bytes}};
  for (const auto& [read, bytes] : files) {
    std::size_t refused = 0;
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      try {
        static_cast<void>(read(std::string_view(bytes).substr(0, size), "cut"));
      } catch (const InputError&) {
        ++refused;
      }
    }
    // What is lost at the end may be a line end, but no more.
    EXPECT_GE(refused + 2, bytes.size());
  }
}

TEST(VtkSeeds, TheSameGridIsReadFromEveryFormOfBytes) {
  const std::filesystem::path seeds = std::filesystem::path(ISORELAX_SOURCE_DIR) / "tests/fuzz/seeds/vtk_xml";
  const MeshFile plain = read_mesh(seeds / "raw.vtu");
  EXPECT_EQ(plain.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}}));
  EXPECT_EQ(plain.mesh.positions[3], Vec3(1, 1, 0));
  EXPECT_EQ(plain.mesh.attributes.vertex[0].values, (std::vector<double>{1, 2, 3, 4}));
  for (const char* name : {"raw_zlib.vtu", "base64.vtu", "base64_zlib.vtu"}) {
    const MeshFile file = read_mesh(seeds / name);
    expect_same_geometry(plain.mesh, file.mesh);
    EXPECT_TRUE(same_attributes(plain.mesh.attributes, file.mesh.attributes)) << name;
    EXPECT_TRUE(file.messages.empty()) << name;
  }
  EXPECT_EQ(read_mesh(seeds / "inline.vtu").mesh.triangles.size(), 4U);
}

}  // namespace
}  // namespace isorelax
