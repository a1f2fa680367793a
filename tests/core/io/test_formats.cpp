#include <gtest/gtest.h>

#include "core/io/file_bytes.h"
#include "core/io/mesh_samples.h"
#include "io/mesh_file.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

bool mentions(const std::vector<std::string>& messages, const std::string& part) {
  return std::any_of(messages.begin(), messages.end(),
                     [&](const std::string& message) { return message.find(part) != std::string::npos; });
}

TriangleMesh one_triangle() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

TEST(Off, AllTheseSpellingsAreTheSameTriangle) {
  for (const char* text :
       {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2",
        "OFF 3 1 0 0 0 0 1 0 0 0 1 0 3 0 1 2", "OFF\n3\n1\n0\n0 0 0 1 0 0 0 1 0\n3 0 1 2\n",
        "OFF\n3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        "\xef\xbb\xbfOFF\r\n3 1 0\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n",
        "OFF\r3 1 0\r0 0 0\r1 0 0\r0 1 0\r3 0 1 2",
        "# c\n\n OFF # d\n\n3\t1\t0\t\n+0 -0.0e3 .0#e\n\n1. 0 0\n# f\n0 1e0 0  \n3 0 1 2   \n\n"}) {
    const MeshFile file = read_off(text, "mesh.off");
    EXPECT_TRUE(same_corners(file.mesh, one_triangle())) << text;
    EXPECT_TRUE(file.messages.empty()) << text;
  }
}

TEST(Off, CommentsColoursNormalsAndTextureSurvive) {
  const MeshFile file = read_off(
      "STCNOFF\n# first\n3 2 0\n0 0 0 0 0 1 10 20 30 255 0 0.5 # second\n1 0 0 0 0 1 1 2 3 4 1 0\n"
      "0 1 0 1 0 0 0 0 0 0 0 1\n3 0 1 2 0.5 0.25 1.0\n3 0 2 1 1 1 1\n",
      "mesh.off");
  const MeshAttributes& attributes = file.mesh.attributes;
  EXPECT_EQ(attributes.comments, (std::vector<std::string>{"first", "second"}));
  ASSERT_EQ(attributes.vertex.size(), 3U);
  EXPECT_EQ(attributes.vertex[0].name, "normal");
  EXPECT_EQ(attributes.vertex[1].type, ScalarType::uint8);
  EXPECT_EQ(attributes.vertex[1].values[3], 255.0);
  EXPECT_EQ(attributes.vertex[2].values[1], 0.5);
  EXPECT_EQ(attributes.face[0].type, ScalarType::float64);
  const EncodedMesh written = encode_off(file.mesh);
  EXPECT_TRUE(written.messages.empty());
  const MeshFile back = read_off(written.bytes, "back.off");
  EXPECT_TRUE(same_attributes(attributes, back.mesh.attributes));
  EXPECT_EQ(back.mesh.attributes.vertex[1].type, ScalarType::uint8);
}

TEST(Off, ColoursAfterThePlainHeaderAreKeptAndMissingOnesReported) {
  const MeshFile file =
      read_off("OFF\n3 2 0\n0 0 0 255 0 0\n1 0 0\n0 1 0 0 0 255\n3 0 1 2 4\n3 0 2 1\n", "mesh.off");
  EXPECT_EQ(file.mesh.attributes.vertex[0].values,
            (std::vector<double>{255, 0, 0, 255, 255, 255, 0, 0, 255}));
  EXPECT_TRUE(mentions(file.messages, "1 of 3 vertices without a colour"));
  EXPECT_EQ(file.mesh.attributes.face[0].name, "color_index");
  EXPECT_TRUE(mentions(file.messages, "1 faces without an index"));
}

TEST(Off, ColoursInBytesAmongFractionsBecomeFractions) {
  const MeshFile file =
      read_off("OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 0.5 0.25 1\n3 0 1 2 255 0 51\n3 0 1 2 1 0 0\n", "t");
  ASSERT_EQ(file.mesh.attributes.face.size(), 1U);
  EXPECT_EQ(file.mesh.attributes.face[0].values, (std::vector<double>{0.5, 0.25, 1, 1, 0, 0.2, 1, 0, 0}));
  EXPECT_TRUE(
      mentions(file.messages, "colours of 1 of 3 faces given in bytes among fractions made fractions"));
}

TEST(Off, WhatFollowsTheLastFaceIsReported) {
  const MeshFile file = read_off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n\nrest 0 1 2\n", "mesh.off");
  EXPECT_TRUE(mentions(file.messages, "from line 8 on"));
}

TEST(Off, FaceColoursFollowThePiecesOfAPolygon) {
  const MeshFile file =
      read_off("OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 1 9 9 9\n4 0 1 2 3 1 2 3\n3 0 1 2 4 5 6\n", "m");
  EXPECT_EQ(file.mesh.attributes.face[0].values, (std::vector<double>{1, 2, 3, 1, 2, 3, 4, 5, 6}));
  EXPECT_TRUE(mentions(file.messages, "1 polygon with more than three corners cut into 2 triangles"));
  EXPECT_TRUE(mentions(file.messages, "1 face with fewer than three corners"));
}

TEST(Obj, AGroupOfLeftOutFacesOnlyIsNoGroup) {
  const MeshFile file = read_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ng two\nf 1 2\n", "mesh.obj");
  EXPECT_TRUE(file.mesh.attributes.face_labels.empty());
}

TEST(Obj, ColoursAreFractionsEvenWhenAllAreWhole) {
  const MeshFile file = read_obj("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n", "mesh.obj");
  EXPECT_EQ(file.mesh.attributes.vertex[0].type, ScalarType::float64);
}

constexpr const char* kObj =
    "# made by hand\nmtllib a.mtl\no thing\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 "
    "0 1\n"
    "g one\nusemtl red shiny\ns 1\nf 1/1/1 2/2/1 3/3/1\ng two\ns off\nf 1//1 -2//-1 4//1\nl 1 2\nl 2 3\n";

TEST(Obj, GroupsMaterialsTextureAndNormalsSurvive) {
  const MeshFile file = read_obj(kObj, "mesh.obj");
  EXPECT_TRUE(mentions(file.messages, "2 statements left out: 'l' x 2"));
  const MeshAttributes& attributes = file.mesh.attributes;
  EXPECT_EQ(attributes.header_lines, std::vector<std::string>{"mtllib a.mtl"});
  ASSERT_EQ(attributes.face_labels.size(), 4U);
  EXPECT_EQ(attributes.face_labels[2].labels, std::vector<std::string>{"red shiny"});
  EXPECT_EQ(attributes.corner[0].indices, (std::vector<std::uint32_t>{0, 1, 2, kNone, kNone, kNone}));
  EXPECT_EQ(file.mesh.triangles[1], (Triangle{0, 2, 3}));
  const EncodedMesh written = encode_obj(file.mesh);
  EXPECT_TRUE(written.messages.empty());
  EXPECT_TRUE(same_attributes(attributes, read_obj(written.bytes, "back.obj").mesh.attributes));
}

TEST(Obj, CornerTextureAndLabelsFollowThePiecesOfAPolygon) {
  const MeshFile file =
      read_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\ng a\nf 1/4 2/3 3/2 4/1\n",
               "mesh.obj");
  ASSERT_EQ(file.mesh.triangles.size(), 2U);
  const CornerAttribute& texture = file.mesh.attributes.corner[0];
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_EQ(texture.indices[c], 3 - file.mesh.triangles[c / 3][c % 3]);
  }
  EXPECT_EQ(file.mesh.attributes.face_labels[0].face_label, (std::vector<std::uint32_t>{0, 0}));
}

TEST(Obj, AFaceMayNameAVertexThatFollowsItAndACommentMayEndInABackslash) {
  const MeshFile file = read_obj("# c:\\\nv 0 0 0\nf 1 2 3\nv 1 0 \\\n0\nv 0 1 0\n", "mesh.obj");
  EXPECT_TRUE(same_geometry(file.mesh, one_triangle()));
}

TEST(Obj, LabelsThatWouldBreakALineAreChangedAndCounted) {
  TriangleMesh mesh = one_triangle();
  mesh.attributes.face_labels.push_back({"g", {"#1\\"}, {0}});
  const EncodedMesh written = encode_obj(mesh);
  EXPECT_TRUE(mentions(written.messages, "1 label written with _"));
  EXPECT_EQ(read_obj(written.bytes, "back").mesh.attributes.face_labels[0].labels[0], "_1_");
}

TEST(Ply, SinglePrecisionStaysWhereItLosesNothingAndElseBecomesDoubleWithAMessage) {
  TriangleMesh mesh = one_triangle();
  mesh.attributes.position_type = ScalarType::float32;
  const EncodedMesh single = encode_ply(mesh, FileEncoding::binary_big_endian);
  EXPECT_NE(single.bytes.find("property float x"), std::string::npos);
  EXPECT_TRUE(single.messages.empty());
  mesh.positions[1].x() = 0.1;
  const EncodedMesh wide = encode_ply(mesh, FileEncoding::binary_big_endian);
  EXPECT_NE(wide.bytes.find("property double x"), std::string::npos);
  EXPECT_TRUE(mentions(wide.messages, "positions written as double"));
  expect_same_geometry(mesh, read_ply(wide.bytes, "wide.ply").mesh);
}

TEST(Ply, AttributesOfEveryTypeSurviveInEveryEncoding) {
  TriangleMesh mesh = one_triangle();
  mesh.attributes.comments = {"a comment", "another"};
  mesh.attributes.header_lines = {"obj_info scanned"};
  mesh.attributes.vertex = {{"normal", ScalarType::float32, 3, {0, 0, 1, 0, 1, 0, 1, 0, 0}},
                            {"color", ScalarType::uint8, 4, {255, 0, 0, 9, 1, 2, 3, 4, 5, 6, 7, 8}},
                            {"texcoord", ScalarType::float64, 2, {0, 0, 0.1, 0, 0, 1}},
                            {"quality", ScalarType::float64, 1, {0.1, -0.0, std::nan("")}},
                            {"a", ScalarType::int8, 1, {-128, 127, 0}},
                            {"b", ScalarType::int16, 1, {-32768, 32767, 0}},
                            {"c", ScalarType::uint16, 1, {0, 65535, 1}},
                            {"d", ScalarType::int32, 1, {-2147483648.0, 2147483647, 1000000}},
                            {"e", ScalarType::uint32, 1, {0, 4294967295.0, 1}}};
  mesh.attributes.face = {{"color", ScalarType::float32, 3, {0.5, 0.25, 1}},
                          {"tag", ScalarType::int16, 1, {-7}}};
  mesh.attributes.corner = {{"texcoord", 2, {0, 0, 1, 0, 0.1, 1}, {0, 1, 2}}};
  for (const FileEncoding encoding :
       {FileEncoding::text, FileEncoding::binary_little_endian, FileEncoding::binary_big_endian}) {
    const EncodedMesh written = encode_ply(mesh, encoding);
    EXPECT_TRUE(written.messages.empty());
    const MeshFile back = read_ply(written.bytes, "back.ply");
    EXPECT_TRUE(mentions(back.messages, "1 value of the vertex attribute 'quality' not finite"));
    expect_same_attributes(mesh.attributes.vertex, back.mesh.attributes.vertex);
    expect_same_attributes(mesh.attributes.face, back.mesh.attributes.face);
    EXPECT_TRUE(same_attributes(mesh.attributes, back.mesh.attributes));
  }
}

TEST(Ply, FacesMayComeFirstAndOtherElementsAndListsAreReported) {
  const MeshFile file = read_ply(
      "ply\nformat ascii 1.0\nelement face 1\nproperty list uint8 uint32 vertex_index\nproperty list char "
      "int more\n"
      "element edge 1\nproperty int v1\nelement vertex 3\nproperty double z\nproperty double x\nproperty "
      "double "
      "y\nend_header\n3 0 1 2 2 7 8\n5\n0 0 0\n0 1 0\n0 0 1\nrest\n",
      "mesh.ply");
  EXPECT_TRUE(same_geometry(file.mesh, one_triangle()));
  EXPECT_TRUE(mentions(file.messages, "1 of the element 'edge' left out"));
  EXPECT_TRUE(mentions(file.messages, "list 'more' of 'face' left out"));
  EXPECT_TRUE(mentions(file.messages, "everything after the last element"));
}

TEST(Ply, TriangleStripsAlternateAndMinusOneBeginsANewOne) {
  const MeshFile file = read_ply(
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
      "z\nelement "
      "tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 "
      "-1 3 1 0\n",
      "mesh.ply");
  EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {3, 1, 0}}));
}

TEST(Stl, CornersInTheSamePlaceBecomeOneVertexInOrderOfAppearance) {
  const MeshFile file = read_stl(
      binary_stl({{0, 0, 0, 1, 0, 0, 0, 1, 0}, {1, 0, 0, 1, 1, 0, -0.0F, 1, 0}}, 31, "a part"), "mesh.stl");
  EXPECT_EQ(file.mesh.positions.size(), 4U);
  EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
  EXPECT_TRUE(mentions(file.messages, "6 corner positions merged into 4 vertices"));
  EXPECT_EQ(file.mesh.attributes.header_lines, std::vector<std::string>{"solid a part"});
  EXPECT_EQ(file.mesh.attributes.face[0].values, (std::vector<double>{31, 31}));
  const EncodedMesh written = encode_stl(file.mesh, FileEncoding::binary_little_endian);
  EXPECT_FALSE(mentions(written.messages, "rounded"));
  EXPECT_FALSE(mentions(written.messages, "no place"));
  const MeshFile back = read_stl(written.bytes, "back.stl");
  expect_same_geometry(file.mesh, back.mesh);
  EXPECT_TRUE(same_attributes(file.mesh.attributes, back.mesh.attributes));
}

TEST(Stl, BinaryStlReportsRoundingAndRefusesWhatSinglePrecisionCannotHold) {
  TriangleMesh mesh = one_triangle();
  mesh.positions[1].x() = 0.1;
  EXPECT_TRUE(mentions(encode_stl(mesh, FileEncoding::binary_little_endian).messages, "1 vertex rounded"));
  expect_same_geometry(mesh, read_stl(encode_stl(mesh, FileEncoding::text).bytes, "text").mesh);
  mesh.positions[1].x() = 1e39;
  EXPECT_THROW(static_cast<void>(encode_stl(mesh, FileEncoding::binary_little_endian)), MeshError);
  EXPECT_THROW(static_cast<void>(encode_stl(mesh, FileEncoding::binary_big_endian)), UsageError);
}

TEST(Stl, SeveralSolidsBecomeGroupsAndComeBack) {
  const MeshFile file = read_stl(
      "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
      "0\nendloop\nendfacet\n"
      "endsolid one\nSOLID two words\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 1 0 0\nVERTEX 1 1 0\nVERTEX 0 1 "
      "0\n"
      "ENDLOOP\nENDFACET\nENDSOLID\n",
      "mesh.stl");
  EXPECT_EQ(file.mesh.attributes.face_labels[0].labels, (std::vector<std::string>{"one", "two words"}));
  const MeshFile back = read_stl(encode_stl(file.mesh, FileEncoding::text).bytes, "back.stl");
  EXPECT_TRUE(same_attributes(file.mesh.attributes, back.mesh.attributes));
}

TEST(Stl, ATitleThatLooksLikeTextStlOrIsTooLongIsReported) {
  for (const std::string& title : {std::string("solid solid"), "solid " + std::string(81, 'x')}) {
    TriangleMesh mesh = one_triangle();
    mesh.attributes.header_lines = {title};
    const EncodedMesh written = encode_stl(mesh, FileEncoding::binary_little_endian);
    EXPECT_TRUE(mentions(written.messages, "header line 'solid ")) << title;
    EXPECT_EQ(written.bytes.substr(0, 80), std::string(80, '\0'));
  }
}

TEST(Stl, VerticesThatStlCannotHoldAreCounted) {
  TriangleMesh mesh = one_triangle();
  mesh.positions.emplace_back(5, 5, 5);
  mesh.positions.emplace_back(0, 0, -0.0);
  const std::vector<std::string> messages = encode_stl(mesh, FileEncoding::text).messages;
  EXPECT_TRUE(mentions(messages, "2 vertices in no triangle not written"));
  EXPECT_TRUE(mentions(messages, "1 vertices stand where another does"));
}

TEST(Stl, AFewBytesAfterTheLastTriangleAreReported) {
  const MeshFile file = read_stl(binary_stl({{0, 0, 0, 1, 0, 0, 0, 1, 0}}) + "more", "mesh.stl");
  EXPECT_TRUE(mentions(file.messages, "4 bytes after the last triangle left out"));
}

TEST(Stl, FacetsWithoutAnAreaAreKept) {
  const MeshFile file =
      read_stl(binary_stl({{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 0, 0, 1, 0, 0, 1, 0, 0}}), "mesh.stl");
  EXPECT_EQ(file.mesh.triangles[1], (Triangle{0, 1, 1}));
}

TEST(AcrossFormats, NormalsColoursAndTextureTravelAndTheRestIsReported) {
  TriangleMesh mesh = one_triangle();
  mesh.attributes.vertex = {{"normal", ScalarType::float32, 3, {0, 0, 1, 0, 1, 0, 1, 0, 0}},
                            {"color", ScalarType::uint8, 3, {255, 0, 51, 1, 2, 3, 4, 5, 6}},
                            {"texcoord", ScalarType::float64, 2, {0, 0, 0.1, 0, 0, 1}},
                            {"quality", ScalarType::float64, 1, {0.1, 0.2, 0.3}}};
  const EncodedMesh off = encode_off(mesh);
  ASSERT_EQ(off.messages.size(), 1U);
  EXPECT_EQ(off.messages[0], "vertex attribute 'quality' not written: OFF has no place for it");
  const EncodedMesh obj = encode_obj(read_off(off.bytes, "a.off").mesh);
  EXPECT_TRUE(obj.messages.empty());
  const MeshFile from_obj = read_obj(obj.bytes, "a.obj");
  EXPECT_EQ(from_obj.mesh.attributes.vertex[0].values[2], 0.2);
  const MeshFile ply = read_ply(encode_ply(from_obj.mesh, FileEncoding::text).bytes, "a.ply");
  ASSERT_EQ(ply.mesh.attributes.vertex.size(), 2U);
  EXPECT_EQ(ply.mesh.attributes.vertex[1].name, "normal");
  EXPECT_EQ(ply.mesh.attributes.vertex[1].values, mesh.attributes.vertex[0].values);
  EXPECT_EQ(ply.mesh.attributes.corner[0].values, mesh.attributes.vertex[2].values);
  EXPECT_TRUE(mentions(encode_stl(mesh, FileEncoding::text).messages, "'color' not written: STL"));
}

TEST(Sniffing, TheContentDecidesNotTheName) {
  EXPECT_EQ(format_of_content("ply\nformat ascii 1.0\n"), FileFormat::ply);
  EXPECT_EQ(format_of_content("ply\r\nformat"), FileFormat::ply);
  EXPECT_EQ(format_of_content("# x\nCOFF\n"), FileFormat::off);
  EXPECT_EQ(format_of_content("# x\n\nv 0 0 0\n"), FileFormat::obj);
  EXPECT_EQ(format_of_content("mtllib a.mtl\n"), FileFormat::obj);
  EXPECT_EQ(format_of_content("solid a\nfacet normal\n"), FileFormat::stl);
  EXPECT_EQ(format_of_content(binary_stl({{0, 0, 0, 1, 0, 0, 0, 1, 0}}, 0, "solid trick")), FileFormat::stl);
  EXPECT_EQ(format_of_content("\x89PNG\r\n\x1a\n"), std::nullopt);
  EXPECT_EQ(format_of_content("# vtk DataFile Version 3.0\nvtk output\n"), FileFormat::vtk);
  EXPECT_EQ(format_of_content("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">"), FileFormat::vtp);
  EXPECT_EQ(format_of_content("<VTKFile type='UnstructuredGrid'>"), FileFormat::vtu);
  EXPECT_EQ(format_of_content("<html><VTKFile"), FileFormat::vtu) << "its reader says what it is";
  EXPECT_EQ(format_of_content("$MeshFormat\n4.1 0 8\n"), FileFormat::msh);
  EXPECT_EQ(format_of_content("hello world\n"), std::nullopt);
}

TEST(Sniffing, ABinaryStlWhoseTitleBeginsWithSolidIsReadAsBinary) {
  const MeshFile file = read_stl(binary_stl({{0, 0, 0, 1, 0, 0, 0, 1, 0}}, 0, "solid trick"), "mesh.stl");
  EXPECT_EQ(file.encoding, FileEncoding::binary_little_endian);
  EXPECT_EQ(file.mesh.triangles.size(), 1U);
}

}  // namespace
}  // namespace isorelax
