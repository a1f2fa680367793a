#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "core/io/mesh_samples.h"
#include "core/io/vtk_files.h"
#include "io/mesh_file.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

constexpr FileEncoding kVtkBig = FileEncoding::binary_big_endian;

bool has_message(const std::vector<std::string>& messages, const std::string& part) {
  return std::any_of(messages.begin(), messages.end(),
                     [&](const std::string& message) { return message.find(part) != std::string::npos; });
}

const Attribute* vtk_named(const std::vector<Attribute>& attributes, const std::string& name) {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const Attribute& attribute) { return attribute.name == name; });
  return found == attributes.end() ? nullptr : &*found;
}

/// Two triangles with everything that VTK can hold beside them.
TriangleMesh rich_mesh() {
  TriangleMesh mesh = hard_numbers();
  mesh.attributes.comments = {"a comment"};
  mesh.attributes.vertex = {
      {"normal", ScalarType::float32, 3, {0, 0, 1, 0, 1, 0, 1, 0, 0, 0.5, 0.25, 0}},
      {"texcoord", ScalarType::float64, 2, {0, 0, 0.1, 0, 0, 1, 1, 1}},
      {"color", ScalarType::uint8, 4, {255, 0, 0, 9, 1, 2, 3, 4, 5, 6, 7, 8, 1, 1, 1, 1}},
      {"two words %", ScalarType::float64, 1, {0.1, -0.0, 5e-324, 1e300}},
      {"metadata", ScalarType::int8, 1, {-128, 127, 0, 1}}};
  mesh.attributes.points.vertices = {3, 0};
  mesh.attributes.lines.vertices = {0, 1, 1, 2, 2, 3};
  mesh.attributes.points.values = {{"tag", ScalarType::int32, 1, {-1, -2}},
                                   {"id", ScalarType::int64, 1, {1, 2}},
                                   {"hash", ScalarType::uint64, 1, {3, 4}}};
  mesh.attributes.lines.values = {{"tag", ScalarType::int32, 1, {-3, -4, -2147483648.0}},
                                  {"id", ScalarType::int64, 1, {5, 6, 7}},
                                  {"hash", ScalarType::uint64, 1, {8, 9, 10}}};
  mesh.attributes.face = {{"tag", ScalarType::int32, 1, {5, 2147483647}},
                          {"id", ScalarType::int64, 1, {-9223372036854775808.0, 9007199254740992}},
                          {"hash", ScalarType::uint64, 1, {0, 18446744073709549568.0}}};
  return mesh;
}

struct VtkForm {
  EncodedMesh (*encode)(const TriangleMesh&, FileEncoding);
  MeshFile (*read)(std::string_view, const std::string&);
  FileFormat format;
  FileEncoding encoding;
};

const std::vector<VtkForm> kForms{
    {encode_vtk, read_vtk, FileFormat::vtk, FileEncoding::text},
    {encode_vtk, read_vtk, FileFormat::vtk, kVtkBig},
    {encode_vtp, read_vtk_xml, FileFormat::vtp, FileEncoding::text},
    {encode_vtp, read_vtk_xml, FileFormat::vtp, FileEncoding::binary_little_endian},
    {encode_vtu, read_vtk_xml, FileFormat::vtu, FileEncoding::text},
    {encode_vtu, read_vtk_xml, FileFormat::vtu, FileEncoding::binary_little_endian}};

TEST(VtkRoundTrip, EveryFormKeepsEveryBitOfEveryCoordinate) {
  for (const VtkForm& form : kForms) {
    const EncodedMesh written = form.encode(hard_numbers(), form.encoding);
    EXPECT_TRUE(written.messages.empty());
    EXPECT_EQ(format_of_content(written.bytes), form.format);
    const MeshFile back = form.read(written.bytes, "back");
    expect_same_geometry(hard_numbers(), back.mesh);
    EXPECT_EQ(back.format, form.format);
    EXPECT_EQ(back.encoding, form.encoding);
    EXPECT_TRUE(back.messages.empty());
  }
}

TEST(VtkRoundTrip, EveryFormKeepsAttributesPointsLinesAndTheComment) {
  const TriangleMesh mesh = rich_mesh();
  for (const VtkForm& form : kForms) {
    const EncodedMesh written = form.encode(mesh, form.encoding);
    EXPECT_TRUE(written.messages.empty());
    const MeshAttributes back = form.read(written.bytes, "back").mesh.attributes;
    expect_same_attributes(mesh.attributes.vertex, back.vertex);
    expect_same_attributes(mesh.attributes.face, back.face);
    EXPECT_TRUE(same_attributes(mesh.attributes, back));
  }
}

TEST(VtkRoundTrip, WholeNumbersOf64BitsAreDoublesInPly) {
  TriangleMesh mesh = hard_numbers();
  mesh.attributes.vertex = {{"id", ScalarType::int64, 1, {-9007199254740992.0, 1, 2, 3}}};
  const EncodedMesh written = encode_ply(mesh, FileEncoding::binary_little_endian);
  EXPECT_TRUE(written.messages.empty());
  const MeshFile back = read_ply(written.bytes, "back");
  EXPECT_EQ(back.mesh.attributes.vertex[0].type, ScalarType::float64);
  EXPECT_EQ(back.mesh.attributes.vertex[0].values, mesh.attributes.vertex[0].values);
}

TEST(VtkRoundTrip, SinglePrecisionStaysWhereItLosesNothing) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0.5, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.attributes.position_type = ScalarType::float32;
  for (const VtkForm& form : kForms) {
    EXPECT_EQ(form.read(form.encode(mesh, form.encoding).bytes, "back").mesh.attributes.position_type,
              ScalarType::float32);
  }
  mesh.positions[1].x() = 0.1;
  for (const VtkForm& form : kForms) {
    const EncodedMesh written = form.encode(mesh, form.encoding);
    EXPECT_TRUE(has_message(written.messages, "positions written as double"));
    expect_same_geometry(mesh, form.read(written.bytes, "back").mesh);
  }
}

TEST(VtkRoundTrip, ValuesThatAreNotFiniteSurviveButInLegacyText) {
  TriangleMesh mesh = hard_numbers();
  mesh.attributes.vertex = {{"q", ScalarType::float64, 1, {std::nan(""), HUGE_VAL, -HUGE_VAL, 1.0}}};
  for (const VtkForm& form : kForms) {
    const EncodedMesh written = form.encode(mesh, form.encoding);
    const MeshFile back = form.read(written.bytes, "back");
    if (form.format == FileFormat::vtk && form.encoding == FileEncoding::text) {
      EXPECT_TRUE(has_message(written.messages, "3 values of the array 'q' not finite, written as 0"));
      EXPECT_EQ(back.mesh.attributes.vertex[0].values, (std::vector<double>{0, 0, 0, 1}));
    } else {
      EXPECT_TRUE(written.messages.empty());
      expect_same_attributes(mesh.attributes.vertex, back.mesh.attributes.vertex);
    }
  }
}

TEST(VtkRoundTrip, WhatAFormCannotHoldIsReported) {
  TriangleMesh mesh = hard_numbers();
  mesh.attributes.comments = {"first", "a -- b", "third"};
  mesh.attributes.header_lines = {"mtllib x.mtl"};
  mesh.attributes.vertex = {{"a", ScalarType::uint8, 1, {0, 256, 0, 0}}, {"a", ScalarType::uint8, 2, {}}};
  mesh.attributes.vertex[1].values.resize(8);
  mesh.attributes.face = {{"f\x01", ScalarType::uint8, 1, {0, 1}}};
  for (const VtkForm& form : kForms) {
    const std::vector<std::string> messages = form.encode(mesh, form.encoding).messages;
    const bool xml = form.format != FileFormat::vtk;
    EXPECT_TRUE(has_message(messages, "header line 'mtllib x.mtl' not written"));
    EXPECT_TRUE(has_message(messages, "point array 'a' written as double: unsigned_char does not hold"));
    EXPECT_TRUE(has_message(messages, "vertex attribute 'a' not written"));
    EXPECT_TRUE(has_message(messages, xml ? "1 comment not written" : "2 comments not written"));
    EXPECT_EQ(has_message(messages, "cell array 'f\\x01' not written"), xml);
  }
}

TEST(VtkRoundTrip, AnEncodingThatTheFormatDoesNotHaveIsRefused) {
  EXPECT_THROW(static_cast<void>(encode_vtk(hard_numbers(), FileEncoding::binary_little_endian)), UsageError);
  EXPECT_THROW(static_cast<void>(encode_vtp(hard_numbers(), kVtkBig)), UsageError);
  EXPECT_THROW(static_cast<void>(encode_vtu(hard_numbers(), kVtkBig)), UsageError);
}

TEST(Vtk, CellDataGoesThroughVerticesLinesPolygonsAndStripsWhateverTheirOrderInTheFile) {
  const MeshFile file =
      read_vtk(vtk_head("2.0", "ascii", "polydata") +
                   "points 5 float\n0 0 0 1 0 0 0 1 0 1 1 0 2 1 0\ntriangle_strips 1 5\n4 0 1 2 3\npolygons "
                   "2 9\n4 0 1 3 "
                   "2\n3 1 4 3\nlines 2 7\n3 0 1 3 2 3 4\nvertices 1 3\n2 4 0\nCELL_DATA 6\nSCALARS tag int\n"
                   "LOOKUP_TABLE default\n1 2 3 4 5 6\n",
               "mesh.vtk");
  const MeshAttributes& attributes = file.mesh.attributes;
  EXPECT_EQ(attributes.points.vertices, (std::vector<std::uint32_t>{4, 0}));
  EXPECT_EQ(attributes.points.values[0].values, (std::vector<double>{1, 1}));
  EXPECT_EQ(attributes.lines.vertices, (std::vector<std::uint32_t>{0, 1, 1, 3, 3, 4}));
  EXPECT_EQ(attributes.lines.values[0].values, (std::vector<double>{2, 2, 3}));
  EXPECT_EQ(file.mesh.triangles,
            (std::vector<Triangle>{{0, 1, 3}, {0, 3, 2}, {1, 4, 3}, {0, 1, 2}, {2, 1, 3}}));
  EXPECT_EQ(attributes.face[0].values, (std::vector<double>{4, 4, 5, 6, 6}));
  EXPECT_EQ(attributes.position_type, ScalarType::float32);
  EXPECT_TRUE(has_message(file.messages, "1 polyline cut into 2 lines"));
  EXPECT_TRUE(has_message(file.messages, "1 triangle strip cut into 2 triangles"));
  EXPECT_TRUE(has_message(file.messages, "1 polygon with more than three corners cut into 2 triangles"));
}

TEST(Vtk, EveryKindOfAttributeIsReadFromText) {
  const MeshFile file = read_vtk(
      vtk_square(
          "POINT_DATA 4\nSCALARS t float 2\nLOOKUP_TABLE hot\n1 2 3 4 5 6 7 8\nLOOKUP_TABLE hot 1\n0 0 0 "
          "1\nCOLOR_SCALARS color 3\n0 0 1 1 0.2 0 0.00392157 0 0 1 1 1\nNORMALS n float\n0 0 1 0 0 1 0 0 1 "
          "0 0 1\nTEXTURE_COORDINATES uv 2 double\n0 0 1 0 0 1 1 1\nVECTORS v short\n1 2 3 4 5 6 7 8 9 0 0 "
          "0\nCELL_DATA 2\nTENSORS s float\n1 0 0 0 1 0 0 0 1\n1 2 3 4 5 6 7 8 9\nNORMALS cn float\n0 0 1 0 "
          "0 1\nFIELD FieldData 3\na%20b 1 2 vtkIdType\n7 -8\nMETADATA\nCOMPONENT_NAMES\n\nINFORMATION 1\n"
          "NAME x LOCATION y\nDATA 1 2\n\nodd 1 3 int\n1 2 3\ntexts 1 2 string\na b\nc\n"),
      "mesh.vtk");
  const MeshAttributes& attributes = file.mesh.attributes;
  ASSERT_EQ(attributes.vertex.size(), 5U);
  EXPECT_EQ(attributes.vertex[0].name, "t");
  EXPECT_EQ(attributes.vertex[0].width, 2U);
  EXPECT_EQ(attributes.vertex[1].name, "color");
  EXPECT_EQ(attributes.vertex[1].type, ScalarType::uint8);
  EXPECT_EQ(attributes.vertex[1].values,
            (std::vector<double>{0, 0, 255, 255, 51, 0, 1, 0, 0, 255, 255, 255}));
  EXPECT_EQ(attributes.vertex[2].name, "normal");
  EXPECT_EQ(attributes.vertex[3].name, "texcoord");
  EXPECT_EQ(attributes.vertex[4].type, ScalarType::int16);
  ASSERT_EQ(attributes.face.size(), 3U);
  EXPECT_EQ(attributes.face[0].width, 9U);
  EXPECT_EQ(attributes.face[1].name, "cn");
  EXPECT_EQ(attributes.face[2].name, "a b");
  EXPECT_EQ(attributes.face[2].values, (std::vector<double>{7, -8}));
  EXPECT_TRUE(has_message(file.messages, "lookup table 'hot' left out"));
  EXPECT_TRUE(has_message(file.messages, "array 'odd' left out: it has 3 rows for 2 cells"));
  EXPECT_TRUE(has_message(file.messages, "array 'texts' of texts left out"));
  EXPECT_EQ(file.messages.size(), 3U);
}

TEST(Vtk, BinaryNumbersBitsColoursAndTextsAreRead) {
  const std::endian big = std::endian::big;
  const std::string square = vtk_head("4.2", "BINARY", "POLYDATA") + "POINTS 4 float\n" +
                             numbers_in<float>(big, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}) +
                             "\nPOLYGONS 1 5\n" + numbers_in<std::int32_t>(big, {4, 0, 1, 3, 2});
  const MeshFile file = read_vtk(
      square + "\nPOINT_DATA 4\nCOLOR_SCALARS color 3\n" + "abcdefghijkl" +
          "\nFIELD FieldData 3\nflag 1 4 bit\n\xa0\ntexts 1 3 string\n\xc1x\xc0\x80\x02yz\nwide 1 4 long\n" +
          numbers_in<std::int64_t>(big, {1, -2, 9007199254740993, 4}) + "\n",
      "mesh.vtk");
  ASSERT_EQ(file.mesh.attributes.vertex.size(), 3U);
  EXPECT_EQ(file.mesh.attributes.vertex[0].values[0], 97.0);
  EXPECT_EQ(file.mesh.attributes.vertex[1].values, (std::vector<double>{1, 0, 1, 0}));
  EXPECT_EQ(file.mesh.attributes.vertex[1].type, ScalarType::uint8);
  EXPECT_EQ(file.mesh.attributes.vertex[2].values[1], -2.0);
  EXPECT_EQ(file.mesh.attributes.vertex[2].type, ScalarType::float64);
  EXPECT_EQ(file.mesh.triangles.size(), 2U);
  EXPECT_TRUE(has_message(file.messages, "1 whole number of the point array 'wide' rounded"));
  EXPECT_TRUE(has_message(file.messages, "array 'texts' of texts left out"));
}

TEST(Vtk, VersionFiveHasOffsetsInTextAndBinary) {
  const std::endian big = std::endian::big;
  const MeshFile text =
      read_vtk(vtk_head("5.1", "ASCII", "POLYDATA") + kVtkSquare +
                   "METADATA\nCOMPONENT_NAMES\nx\n\n\nINFORMATION 1\nNAME a LOCATION b\nDATA 1 2 "
                   "\n\nLINES 0 0\nPOLYGONS 3 6\nOFFSETS vtktypeint64\n0 3 6\nCONNECTIVITY "
                   "vtktypeint64\n0 1 2 2 1 3\n",
               "mesh.vtk");
  EXPECT_EQ(text.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}}));
  const MeshFile binary =
      read_vtk(vtk_head("5.1", "BINARY", "UNSTRUCTURED_GRID") + "POINTS 4 double\n" +
                   numbers_in<double>(big, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}) +
                   "\nCELLS 3 6\nOFFSETS vtktypeint64\n" + numbers_in<std::int64_t>(big, {0, 3, 6}) +
                   "\nCONNECTIVITY vtktypeint64\n" + numbers_in<std::int64_t>(big, {0, 1, 2, 2, 1, 3}) +
                   "\nCELL_TYPES 2\n" + numbers_in<std::int32_t>(big, {5, 5}) + "\n",
               "mesh.vtk");
  EXPECT_TRUE(same_geometry(text.mesh, binary.mesh));
}

TEST(Vtk, ACellOfAGridIsTakenForWhatItsTypeSays) {
  const MeshFile file =
      read_vtk(vtk_head("1.0", "ASCII", "UNSTRUCTURED_GRID") + kVtkSquare +
                   "CELLS 8 33\n3 0 1 2\n4 0 1 2 3\n4 0 1 3 2\n4 0 1 2 3\n1 3\n2 0 3\n4 0 1 2 3\n3 "
                   "2 1 3\nCELL_TYPES 8\n5 8 9 10 1 3 6 7\nCELL_DATA 8\nSCALARS c int\n"
                   "LOOKUP_TABLE default\n1 2 3 4 5 6 7 8\n",
               "mesh.vtk");
  EXPECT_EQ(file.mesh.triangles,
            (std::vector<Triangle>{
                {0, 1, 2}, {0, 1, 3}, {0, 3, 2}, {0, 1, 3}, {0, 3, 2}, {0, 1, 2}, {2, 1, 3}, {2, 1, 3}}));
  EXPECT_EQ(file.mesh.attributes.face[0].values, (std::vector<double>{1, 2, 2, 3, 3, 7, 7, 8}));
  EXPECT_EQ(file.mesh.attributes.points.values[0].values, std::vector<double>{5});
  EXPECT_EQ(file.mesh.attributes.lines.values[0].values, std::vector<double>{6});
  EXPECT_TRUE(has_message(file.messages, "1 volume cell left out"));
}

TEST(Vtk, OnlyATitleOfItsOwnBecomesAComment) {
  for (const char* title : {"vtk output", "VTK File", "written by meshio v5.0.0", ""}) {
    const std::string bytes = "# vtk DataFile Version 3.0\n" + std::string(title) +
                              "\nASCII\nDATASET POLYDATA\n" +
                              vtk_square().substr(vtk_head("3.0", "ASCII", "POLYDATA").size());
    EXPECT_TRUE(read_vtk(bytes, "mesh.vtk").mesh.attributes.comments.empty()) << title;
  }
  EXPECT_EQ(read_vtk("# vtk DataFile Version 3.0\r\n a cow \r\nASCII\r\nDATASET POLYDATA\r\n" +
                         std::string(kVtkSquare) + "POLYGONS 1 4\r\n3 0 1 2\r\n",
                     "mesh.vtk")
                .mesh.attributes.comments,
            std::vector<std::string>{"a cow"});
}

TEST(Vtk, ASecondArrayOfANameAndDataOfTheWholeSetAreReported) {
  const MeshFile file = read_vtk(vtk_head("3.0", "ASCII", "POLYDATA") +
                                     "FIELD FieldData 1\nTIME 1 1 double\n0.5\n" + kVtkSquare +
                                     "POLYGONS 1 4\n3 0 1 2\nPOINT_DATA 4\nFIELD f 3\na 1 4 int\n1 2 3 "
                                     "4\na 1 4 int\n5 6 7 8\nempty 0 4 int\n",
                                 "mesh.vtk");
  ASSERT_EQ(file.mesh.attributes.vertex.size(), 1U);
  EXPECT_EQ(file.mesh.attributes.vertex[0].values[0], 1.0);
  EXPECT_TRUE(has_message(file.messages, "array 'TIME' of the whole data set left out"));
  EXPECT_TRUE(has_message(file.messages, "a second point array 'a' left out"));
  EXPECT_TRUE(has_message(file.messages, "1 array of the points without a name or a component left out"));
}

TEST(Vtk, ValuesOfOneHugeCellAreNotRepeatedWithoutBound) {
  const std::size_t corners = 10000;
  const std::size_t width = 10000;
  std::string bytes = vtk_head("3.0", "ASCII", "POLYDATA") + kVtkSquare + "POLYGONS 1 " +
                      std::to_string(corners + 1) + "\n" + std::to_string(corners);
  for (std::size_t i = 0; i < corners; ++i) {
    bytes += i % 4 < 2 ? " 0" : " 1";
  }
  bytes += "\nCELL_DATA 1\nFIELD f 2\nwide " + std::to_string(width) + " 1 float\n";
  for (std::size_t i = 0; i < width; ++i) {
    bytes += "1 ";
  }
  const MeshFile file = read_vtk(bytes + "\nslim 1 1 float\n7\n", "mesh.vtk");
  ASSERT_EQ(file.mesh.attributes.face.size(), 1U);
  EXPECT_EQ(file.mesh.attributes.face[0].values, std::vector<double>(corners - 2, 7.0));
  EXPECT_TRUE(has_message(file.messages, "cell values 'wide' left out: 1 cell cut into 9998"));
}

TEST(VtkXml, ManyPiecesDoNotTakeQuadraticTime) {
  std::string pieces;
  for (int i = 0; i < 20000; ++i) {
    pieces += "<Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><Points>" +
              xml_array("Int8", "p", 3, "0 0 0 1 0 0 0 1 0") + "</Points><Polys>" +
              xml_array("Int8", "connectivity", 1, "0 1 2") + xml_array("Int8", "offsets", 1, "3") +
              "</Polys></Piece>\n";
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(read_vtk_xml(xml_file("PolyData", pieces), "mesh.vtp").mesh.triangles.size(), 20000U);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
}

TEST(VtkXml, PiecesAreJoinedInOrder) {
  const auto piece = [](const std::string& numbers, const std::string& more) {
    return "<Piece NumberOfPoints=\"3\" NumberOfVerts=\"1\" NumberOfPolys=\"1\"><PointData>" +
           xml_array("Float32", "a", 1, numbers) + more + "</PointData><CellData>" +
           xml_array("Int16", "c", 1, numbers.substr(0, 3)) + "</CellData><Points>" +
           xml_array("Float32", "p", 3, "0 0 0 1 0 0 0 1 0") + "</Points><Polys>" +
           xml_array("Int32", "connectivity", 1, "0 1 2") + xml_array("Int32", "offsets", 1, "3") +
           "</Polys><Verts>" + xml_array("Int32", "connectivity", 1, "2") +
           xml_array("Int32", "offsets", 1, "1") + "</Verts></Piece>\n";
  };
  const MeshFile file = read_vtk_xml(
      xml_file("PolyData", piece("1 2 3", xml_array("Int8", "b", 1, "1 2 3")) +
                               "<Piece NumberOfPoints=\"0\" NumberOfPolys=\"0\"/>\n" + piece("4 5 6", "")),
      "mesh.vtp");
  EXPECT_EQ(file.format, FileFormat::vtp);
  EXPECT_EQ(file.mesh.positions.size(), 6U);
  EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}}));
  ASSERT_EQ(file.mesh.attributes.vertex.size(), 1U);
  EXPECT_EQ(file.mesh.attributes.vertex[0].values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(file.mesh.attributes.points.vertices, (std::vector<std::uint32_t>{2, 5}));
  EXPECT_EQ(file.mesh.attributes.points.values[0].values, (std::vector<double>{1, 4}));
  EXPECT_EQ(file.mesh.attributes.face[0].values, (std::vector<double>{2, 5}));
  EXPECT_TRUE(has_message(file.messages, "point array 'b' left out: not every piece has it"));
}

TEST(VtkXml, NamesTextsCommentsAndTheDataOfTheWholeSet) {
  const std::string numbers = xml_array("Float32", "TCoords", 2, "0 0 1 0 0 1 1 1") +
                              "<Array type=\"String\" Name=\"w\" format=\"ascii\">97 0</Array>";
  std::string bytes = xml_square(numbers + xml_array("Float64", "q &lt; 1", 1, "nan inf -inf 0.1"));
  bytes.insert(bytes.find("<VTKFile"), "<!-- first\n  second -->\n<!---->");
  bytes.insert(bytes.find("<Piece"), "<FieldData>" + xml_array("Float64", "TIME", 1, "1") + "</FieldData>");
  const MeshFile file = read_vtk_xml(bytes, "mesh.vtu");
  EXPECT_EQ(file.mesh.attributes.comments, (std::vector<std::string>{"first", "second"}));
  ASSERT_NE(vtk_named(file.mesh.attributes.vertex, "q < 1"), nullptr);
  EXPECT_EQ(vtk_named(file.mesh.attributes.vertex, "q < 1")->values[3], 0.1);
  EXPECT_NE(vtk_named(file.mesh.attributes.vertex, "texcoord"), nullptr);
  EXPECT_TRUE(has_message(file.messages, "array 'TIME' of the whole data set left out"));
  EXPECT_TRUE(has_message(file.messages, "array 'w' of type 'String' left out"));
}

TEST(VtkXml, TheListSaysWhichArrayIsTheNormals) {
  std::string bytes = xml_square(xml_array("Float32", "N", 3, "0 0 1 0 0 1 0 0 1 0 0 1"));
  bytes.insert(bytes.find("<PointData") + 10, " Normals=\"N\"");
  EXPECT_EQ(read_vtk_xml(bytes, "mesh.vtu").mesh.attributes.vertex[0].name, "normal");
}

}  // namespace
}  // namespace isorelax
