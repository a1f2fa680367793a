#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "core/io/file_bytes.h"
#include "core/io/malformed.h"
#include "io/mesh_file.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

const std::string kPlyVertices =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kPlyFaces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kPlyText = kPlyVertices + kPlyFaces + "0 0 0\n1 0 0\n0 1 0\n";

std::string ply_header(const char* encoding, const char* vertices, const char* faces) {
  return std::string("ply\nformat ") + encoding + " 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

std::vector<Malformed> malformed_off() {
  return {
      {"off_empty", read_off, "", "line 1", "expected OFF"},
      {"off_wrong_magic", read_off, "FOO\n3 1 0\n", "line 1", "expected OFF, found 'FOO'"},
      {"off_only_header", read_off, "OFF\n", "line 1", "the file ends where the number of vertices"},
      {"off_binary", read_off, "OFF BINARY\n", "line 1", "binary OFF is not read"},
      {"off_four_dimensions", read_off, "4OFF\n1 1 0\n0 0 0 1\n", "line 1", "other than three coordinates"},
      {"off_count_not_whole", read_off, "OFF\n3.5 1 0\n", "line 2", "not a whole number from 0 on: '3.5'"},
      {"off_negative_count", read_off, "OFF\n-3 1 0\n", "line 2", "'-3'"},
      {"off_lying_vertex_count", read_off, "OFF\n4000000000 1 0\n0 0 0\n", "line 2",
       "promises 4000000000 vertices"},
      {"off_lying_face_count", read_off, "OFF\n3 4294967295 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "line 2",
       "promises 4294967295 faces"},
      {"off_too_small_face_count", read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n", "line 7",
       "promises 1 faces, but more follow"},
      {"off_huge_count", read_off, "OFF\n99999999999999999999 1 0\n", "line 2", "'99999999999999999999'"},
      {"off_truncated_vertices", read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n", "line 4",
       "ends after 2 of 3 vertices"},
      {"off_truncated_in_vertex", read_off, "OFF\n3 0 0\n0 0 0\n1 0 0\n1 1", "line 5", "the z coordinate"},
      {"off_truncated_faces", read_off, "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "line 6",
       "ends after 1 of 2 faces"},
      {"off_truncated_in_face", read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1", "line 6",
       "ends within face 0"},
      {"off_index_too_large", read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 6",
       "names vertex 3, but there are 3 (numbered from 0)"},
      {"off_index_negative", read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "line 6",
       "names vertex -1"},
      {"off_index_fraction", read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n", "line 6", "'1.5'"},
      {"off_huge_degree", read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n", "line 6",
       "promises 4000000000 corners"},
      {"off_nan", read_off, "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", "line 4",
       "the y coordinate of a vertex is not a number (NaN)"},
      {"off_infinite", read_off, "OFF\n3 1 0\n0 0 0\n1 0 -inf\n0 1 0\n3 0 1 2\n", "line 4", "infinite"},
      {"off_overflow", read_off, "OFF\n3 1 0\n1e999 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "line 3", "too large"},
      {"off_word", read_off, "OFF\n3 1 0\n0 0 zero\n1 0 0\n0 1 0\n3 0 1 2\n", "line 3",
       "not a number: 'zero'"},
      {"off_zero_bytes", read_off, std::string("OFF\n3 1 0\n0 0 \0\0\n", 17) + "1 0 0\n0 1 0\n3 0 1 2\n",
       "line 3", "'\\x00\\x00'"},
      {"off_cr_lines", read_off, "OFF\r3 1 0\r0 0 0\r1 0 0\r0 1 x\r3 0 1 2\r", "line 5", "'x'"},
      {"off_crlf_lines", read_off, "OFF\r\n3 1 0\r\n0 0 0\r\n1 0 0\r\n0 1 x\r\n3 0 1 2\r\n", "line 5", "'x'"},
      {"off_no_faces", read_off, "OFF\n1 0 0\n0 0 0\n", "", "holds no triangles"},
      {"off_no_vertices", read_off, "OFF\n0 0 0\n", "", "holds no vertices"},
  };
}

std::vector<Malformed> malformed_obj() {
  return {
      {"obj_index_too_large", read_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "line 4",
       "names vertex 4, but there are 3 (numbered from 1)"},
      {"obj_index_zero", read_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "line 4", "names vertex 0"},
      {"obj_index_before_first", read_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -4 1 2\n", "line 4",
       "names vertex -4"},
      {"obj_index_huge", read_obj, "v 0 0 0\nf 1 1 99999999999\n", "line 2", "names vertex 99999999999"},
      {"obj_texture_index", read_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/2 3/1\n", "line 5",
       "names texture coordinate 2, but there are 1"},
      {"obj_normal_index", read_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//1 3//1\n", "line 4",
       "names normal 1, but there are 0"},
      {"obj_index_word", read_obj, "v 0 0 0\nf 1 two 3\n", "line 2", "not an index: 'two'"},
      {"obj_missing_coordinate", read_obj, "v 0 0\nf 1 1 1\n", "line 1",
       "the z coordinate of a vertex is missing"},
      {"obj_nan", read_obj, "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "line 2", "NaN"},
      {"obj_infinite", read_obj, "v 0 0 0\nv 0 inf 0\nv 0 1 0\nf 1 2 3\n", "line 2", "infinite"},
      {"obj_line_after_join", read_obj, "v 0 0 \\\n0\nv x 0 0\n", "line 3", "'x'"},
      {"obj_no_faces", read_obj, "v 0 0 0\n", "", "holds no triangles"},
      {"obj_only_words", read_obj, "hello\nworld\n", "", "holds no vertices"},
  };
}

std::vector<Malformed> malformed_ply() {
  const std::string little = ply_header("binary_little_endian", "3", "1");
  return {
      {"ply_too_small_count", read_ply, kPlyText + "3 0 1 2\n3 0 2 1\n", "line 14", "more numbers follow"},
      {"ply_too_small_count_binary", read_ply,
       little + little_endian_floats({0, 0, 0, 1, 0, 0, 0, 1, 0}) +
           std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0\3\0\0\0\0\1\0\0\0\2\0\0\0", 26),
       "byte", "13 more bytes follow"},
      {"ply_no_end_header", read_ply, kPlyVertices, "line 6", "no end_header"},
      {"ply_unknown_format", read_ply, "ply\nformat ebcdic 1.0\nend_header\n", "line 2", "'ebcdic'"},
      {"ply_unknown_version", read_ply, "ply\nformat ascii 2.0\nend_header\n", "line 2", "'2.0'"},
      {"ply_no_format", read_ply, "ply\nend_header\n", "line 2", "without a format"},
      {"ply_unknown_type", read_ply, "ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n",
       "line 4", "'quad'"},
      {"ply_property_first", read_ply, "ply\nformat ascii 1.0\nproperty float x\nend_header\n", "line 3",
       "before the first element"},
      {"ply_property_twice", read_ply,
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float x\nend_header\n", "line 5",
       "stands twice"},
      {"ply_no_vertices", read_ply, "ply\nformat ascii 1.0\n" + kPlyFaces, "line 5", "no element 'vertex'"},
      {"ply_no_x", read_ply, "ply\nformat ascii 1.0\nelement vertex 1\nproperty float y\nend_header\n1\n",
       "line 3", "no number 'x'"},
      {"ply_no_index_list", read_ply,
       kPlyVertices + "element face 1\nproperty int a\nend_header\n0 0 0\n1 0 0\n0 1 0\n1\n", "line 7",
       "no list 'vertex_indices'"},
      {"ply_lying_count_text", read_ply, ply_header("ascii", "4000000000", "1") + "0 0 0\n", "line 3",
       "promises 4000000000"},
      {"ply_lying_count_binary", read_ply, ply_header("binary_little_endian", "4000000000", "1"), "line 3",
       "promises 4000000000"},
      {"ply_lying_face_count", read_ply, ply_header("binary_big_endian", "0", "4000000000"), "line 7",
       "promises 4000000000"},
      {"ply_lying_list", read_ply,
       "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
       "float "
       "z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n" +
           little_endian_floats({0, 0, 0}) + "\xff\xff\xff\xff",
       "byte ", "promises 4294967295 numbers"},
      {"ply_truncated_text", read_ply, kPlyText, "line 12", "'face' 0 of 1: the file ends here"},
      {"ply_truncated_binary", read_ply, little + little_endian_floats({0, 0, 0, 1, 0, 0, 0, 1}), "byte ",
       "the file ends here"},
      {"ply_truncated_faces", read_ply, little + little_endian_floats({0, 0, 0, 1, 0, 0, 0, 1, 0}) + "\3",
       "byte ", "but only 0 bytes follow"},
      {"ply_index_too_large", read_ply, kPlyText + "3 0 1 3\n", "line 13",
       "names vertex 3, but there are 3 (numbered from 0)"},
      {"ply_index_negative", read_ply, kPlyText + "3 0 1 -1\n", "line 13", "names vertex -1"},
      {"ply_negative_list", read_ply, kPlyText + "-3 0 1 2\n", "line 13", "'-3' is not of type uchar"},
      {"ply_nan_text", read_ply, kPlyVertices + kPlyFaces + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", "line 11",
       "NaN"},
      {"ply_nan_binary", read_ply, little + little_endian_floats({0, 0, 0, 1, std::nanf(""), 0, 0, 1, 0}),
       "byte ", "coordinate y is not a number (NaN)"},
      {"ply_infinite_binary", read_ply, little + little_endian_floats({0, 0, 0, 1, 0, HUGE_VALF, 0, 1, 0}),
       "byte ", "coordinate z is infinite"},
      {"ply_too_many_on_line", read_ply, kPlyVertices + kPlyFaces + "0 0 0 9\n1 0 0\n0 1 0\n3 0 1 2\n",
       "line 10", "more on the line than the element has: '9'"},
      {"ply_strip_without_list", read_ply,
       kPlyVertices + "element tristrips 1\nproperty int a\nend_header\n0 0 0\n1 0 0\n0 1 0\n1\n", "line 12",
       "triangle strips need a list"},
  };
}

std::vector<Malformed> malformed_stl() {
  const std::string facet = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
  return {
      {"stl_short", read_stl, std::string(50, '\1'), "byte 50", "ends within the header"},
      {"stl_lying_count", read_stl, std::string(80, '\1') + "\xff\xff\xff\xff" + std::string(100, '\0'),
       "byte 80", "promises 4294967295 triangles, but the file holds 2"},
      {"stl_too_small_count", read_stl, binary_stl({{0, 0, 0, 1, 0, 0, 0, 1, 0}}) + std::string(50, '\0'),
       "byte 80", "promises 1 triangles, but the file holds 2"},
      {"stl_other_kind_of_file", read_stl, binary_stl({{0, 0, 0, 1, 0, 0, 0, 1, 0}}) + std::string(1000, 'x'),
       "byte 80", "1000 more bytes follow them: this is no STL file"},
      {"stl_nan_binary", read_stl, binary_stl({{0, 0, 0, 1, std::nanf(""), 0, 0, 1, 0}}), "byte 112", "NaN"},
      {"stl_infinite_binary", read_stl, binary_stl({{HUGE_VALF, 0, 0, 1, 0, 0, 0, 1, 0}}), "byte 96",
       "infinite"},
      {"stl_truncated_text", read_stl, facet, "line 5", "the file ends within a facet"},
      {"stl_two_vertices", read_stl, facet + "endloop\nendfacet\nendsolid\n", "line 6",
       "a facet has 2 vertices"},
      {"stl_nan_text", read_stl, facet + "vertex nan 0 0\n", "line 6", "NaN"},
      {"stl_wrong_word", read_stl, "solid a\nface normal\n", "line 2",
       "expected 'facet' or 'endsolid', found 'face'"},
      {"stl_missing_endsolid", read_stl, facet + "vertex 0 1 0\nendloop\nendfacet\n", "line 8",
       "'endsolid' is missing"},
      {"stl_no_triangles", read_stl, binary_stl({}), "", "holds no"},
      {"stl_empty_solid", read_stl, "solid a\nendsolid a\n", "", "holds no"},
  };
}

class MalformedFile : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedFile, IsRefusedOnOneLineWithFilePlaceAndReason) {
  expect_refused(GetParam());
}

std::string name_of(const testing::TestParamInfo<Malformed>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Off, MalformedFile, testing::ValuesIn(malformed_off()), name_of);
INSTANTIATE_TEST_SUITE_P(Obj, MalformedFile, testing::ValuesIn(malformed_obj()), name_of);
INSTANTIATE_TEST_SUITE_P(Ply, MalformedFile, testing::ValuesIn(malformed_ply()), name_of);
INSTANTIATE_TEST_SUITE_P(Stl, MalformedFile, testing::ValuesIn(malformed_stl()), name_of);

TEST(MalformedFile, EveryBeginningOfAFileIsRefusedOrRead) {
  const std::vector<std::pair<decltype(&read_off), std::string>> files = {
      {read_off, "COFF\n3 1 0\n0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n3 0 1 2 0.5 0.5 0.5\n"},
      {read_obj, "v 0 0 0\nv 1 0 0 \\\n\nv 0 1 0\nvt 0 0\nvn 0 0 1\ng a\nf 1/1/1 2/1/1 -1/-1/-1\n"},
      {read_ply, kPlyText + "3 0 1 2\n"},
      {read_ply, ply_header("binary_little_endian", "3", "1") +
                     little_endian_floats({0, 0, 0, 1, 0, 0, 0, 1, 0}) +
                     std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13)},
      {read_stl, binary_stl({{0, 0, 0, 1, 0, 0, 0, 1, 0}})},
  };
  for (const auto& [read, bytes] : files) {
    EXPECT_NO_THROW(static_cast<void>(read(bytes, "whole")));
    std::size_t refused = 0;
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      try {
        static_cast<void>(read(std::string_view(bytes).substr(0, size), "cut"));
      } catch (const InputError&) {
        ++refused;
      }
    }
    // What is lost at the end may be a line end, a colour or a digit of an index, but no more.
    EXPECT_GT(refused, bytes.size() * 4 / 5);
  }
}

TEST(MalformedFile, AWordThatIsNoNumberIsShownShortAndPrintable) {
  try {
    static_cast<void>(read_off("OFF\n3 1 0\n" + std::string(100000, '\x01') + "\n", "mesh.off"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_LT(std::string(error.what()).size(), 300U);
    EXPECT_NE(std::string(error.what()).find("\\x01\\x01"), std::string::npos);
  }
}

}  // namespace
}  // namespace isorelax
