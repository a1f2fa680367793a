#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "core/io/malformed.h"
#include "core/io/mesh_samples.h"
#include "io/byte_order.h"
#include "io/mesh_file.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

constexpr FileEncoding kMshBinary = FileEncoding::binary_little_endian;

const std::string kFormat2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string kFormat4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string kNodes2 = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n";

bool mentioned(const std::vector<std::string>& messages, const std::string& part) {
  return std::ranges::any_of(
      messages, [&](const std::string& message) { return message.find(part) != std::string::npos; });
}

const Attribute* named(const std::vector<Attribute>& attributes, const std::string& name) {
  const auto found = std::ranges::find(attributes, name, &Attribute::name);
  return found == attributes.end() ? nullptr : &*found;
}

std::vector<double> values_of(const std::vector<Attribute>& attributes, const std::string& name) {
  const Attribute* found = named(attributes, name);
  return found == nullptr ? std::vector<double>{} : found->values;
}

TEST(Msh, Version2HasGroupsLinesPointsAndNames) {
  const MeshFile file = read_msh(
      kFormat2 + "$PhysicalNames\n2\n1 7 \"the wall\"\n2 9 \"inside\"\n$EndPhysicalNames\n" + kNodes2 +
          "$Elements\n5\n1 15 2 3 1 2\n2 1 2 7 5 1 2\n3 1 2 8 6 2 3\n4 2 2 9 1 1 2 3\n5 2 2 10 1 1 3 4\n"
          "$EndElements\n",
      "a.msh");
  EXPECT_EQ(file.format, FileFormat::msh);
  EXPECT_EQ(file.encoding, FileEncoding::text);
  EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  const MeshAttributes& attributes = file.mesh.attributes;
  EXPECT_EQ(attributes.points.vertices, (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(attributes.lines.vertices, (std::vector<std::uint32_t>{0, 1, 1, 2}));
  EXPECT_EQ(values_of(attributes.face, "gmsh:physical"), (std::vector<double>{9, 10}));
  EXPECT_EQ(values_of(attributes.lines.values, "gmsh:physical"), (std::vector<double>{7, 8}));
  EXPECT_EQ(values_of(attributes.lines.values, "gmsh:geometrical"), (std::vector<double>{5, 6}));
  EXPECT_EQ(values_of(attributes.points.values, "gmsh:physical"), (std::vector<double>{3}));
  EXPECT_EQ(attributes.header_lines,
            (std::vector<std::string>{"$PhysicalNames 1 7 \"the wall\"", "$PhysicalNames 2 9 \"inside\""}));
  EXPECT_TRUE(attributes.vertex.empty());
  EXPECT_TRUE(file.messages.empty());
}

TEST(Msh, Version4TakesGroupsFromEntities) {
  const MeshFile file =
      read_msh(kFormat4 +
                   "$Entities\n1 1 2 0\n1 0 0 0 1 4\n1 0 0 0 1 0 0 1 7 2 1 -1\n"
                   "3 0 0 0 1 1 0 2 9 8 1 1\n5 0 0 0 1 1 0 0 0\n$EndEntities\n"
                   "$Nodes\n2 4 1 4\n0 1 0 1\n1\n0 0 0\n2 3 1 3\n2\n3\n4\n1 0 0 .5 .5\n1 1 0 1 1\n0 1 0 0 "
                   "1\n$EndNodes\n"
                   "$Elements\n3 3 1 3\n1 1 1 1\n1 1 2\n2 3 2 1\n2 1 2 3\n2 5 2 1\n3 1 3 4\n$EndElements\n",
               "a.msh");
  EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(file.mesh.positions[1], Vec3(1, 0, 0));
  EXPECT_EQ(values_of(file.mesh.attributes.face, "gmsh:physical"), (std::vector<double>{9, 0}));
  EXPECT_EQ(values_of(file.mesh.attributes.face, "gmsh:geometrical"), (std::vector<double>{3, 5}));
  EXPECT_EQ(values_of(file.mesh.attributes.lines.values, "gmsh:physical"), (std::vector<double>{7}));
  EXPECT_TRUE(mentioned(file.messages, "1 entity in several groups"));
}

TEST(Msh, NodesMayHaveAnyNumbersAndKeepThem) {
  const MeshFile file = read_msh(kFormat2 + "$Nodes\n3\n1 0 0 0\n70 1 0 0\n5 0 1 0\n$EndNodes\n" +
                                     "$Elements\n1\n1 2 0 5 1 70\n$EndElements\n",
                                 "a.msh");
  EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{2, 0, 1}}));
  EXPECT_EQ(values_of(file.mesh.attributes.vertex, "gmsh:node"), (std::vector<double>{1, 70, 5}));
  const EncodedMesh written = encode_msh(file.mesh, FileEncoding::text);
  EXPECT_NE(written.bytes.find("\n70 1 0 0\n"), std::string::npos) << written.bytes;
  EXPECT_NE(written.bytes.find(" 5 1 70\n"), std::string::npos) << written.bytes;
  EXPECT_TRUE(written.messages.empty());
}

TEST(Msh, WhatIsNoSurfaceIsCountedAndLeftOut) {
  const MeshFile file =
      read_msh(kFormat2 + kNodes2 +
                   "$Elements\n3\n1 2 2 0 1 1 2 3\n2 4 2 0 1 1 2 3 4\n3 3 3 0 1 2 1 2 3 4\n$EndElements\n" +
                   "$NodeData\nany thing\n$EndNodeData\n",
               "a.msh");
  EXPECT_EQ(file.mesh.triangle_count(), 3U);
  EXPECT_TRUE(mentioned(file.messages, "1 volume cell left out"));
  EXPECT_TRUE(mentioned(file.messages, "1 polygon with more than three corners cut into 2"));
  EXPECT_TRUE(mentioned(file.messages, "section '$NodeData' left out"));
  EXPECT_TRUE(mentioned(file.messages, "partitions of 1 element left out"));
}

/// Binary sections as Gmsh writes them, in either byte order.
class Binary {
 public:
  Binary(const std::string& version, std::endian order) : order_(order) {
    text("$MeshFormat\n" + version + " 1 8\n").number<std::int32_t>({1}).text("\n$EndMeshFormat\n");
  }
  Binary& text(const std::string& piece) {
    bytes_ += piece;
    return *this;
  }
  template <class T>
  Binary& number(std::initializer_list<T> values) {
    for (const T value : values) append_bytes(bytes_, value, order_);
    return *this;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::endian order_;
  std::string bytes_;
};

std::string binary_2(std::endian order) {
  Binary file("2.2", order);
  file.text("$Nodes\n3\n");
  file.number<std::int32_t>({1}).number<double>({0, 0, 0});
  file.number<std::int32_t>({2}).number<double>({1, 0, 0});
  file.number<std::int32_t>({3}).number<double>({0, 1, 0});
  file.text("\n$EndNodes\n$Elements\n3\n");
  file.number<std::int32_t>({1, 2, 2, 1, 7, 5, 1, 2, 2, 8, 5, 2, 3, 2, 1, 2, 3, 9, 6, 1, 2, 3});
  return file.text("\n$EndElements\n").bytes();
}

std::string binary_4(std::endian order) {
  Binary file("4.1", order);
  file.text("$Entities\n").number<std::uint64_t>({0, 1, 1, 0});
  file.number<std::int32_t>({5}).number<double>({0, 0, 0, 1, 1, 0}).number<std::uint64_t>({1});
  file.number<std::int32_t>({7}).number<std::uint64_t>({1}).number<std::int32_t>({-1});
  file.number<std::int32_t>({6}).number<double>({0, 0, 0, 1, 1, 0}).number<std::uint64_t>({1});
  file.number<std::int32_t>({9}).number<std::uint64_t>({0});
  file.text("\n$EndEntities\n$Nodes\n").number<std::uint64_t>({1, 3, 1, 3});
  file.number<std::int32_t>({2, 6, 0}).number<std::uint64_t>({3, 1, 2, 3});
  file.number<double>({0, 0, 0, 1, 0, 0, 0, 1, 0});
  file.text("\n$EndNodes\n$Elements\n").number<std::uint64_t>({2, 3, 1, 3});
  file.number<std::int32_t>({1, 5, 1}).number<std::uint64_t>({2, 1, 1, 2, 2, 2, 3});
  file.number<std::int32_t>({2, 6, 2}).number<std::uint64_t>({1, 3, 1, 2, 3});
  return file.text("\n$EndElements\n").bytes();
}

TEST(Msh, BinaryFilesOfBothVersionsAndByteOrdersAreTheSameMesh) {
  for (const auto order : {std::endian::little, std::endian::big}) {
    for (const std::string& bytes : {binary_2(order), binary_4(order)}) {
      const MeshFile file = read_msh(bytes, "a.msh");
      EXPECT_EQ(file.encoding, order == std::endian::little ? kMshBinary : FileEncoding::binary_big_endian);
      EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
      EXPECT_EQ(file.mesh.positions[2], Vec3(0, 1, 0));
      EXPECT_EQ(file.mesh.attributes.lines.vertices, (std::vector<std::uint32_t>{0, 1, 1, 2}));
      EXPECT_EQ(values_of(file.mesh.attributes.face, "gmsh:physical"), (std::vector<double>{9}));
      EXPECT_EQ(values_of(file.mesh.attributes.face, "gmsh:geometrical"), (std::vector<double>{6}));
    }
  }
}

TEST(Msh, EveryBitOfEveryCoordinateSurvives) {
  const TriangleMesh mesh = hard_numbers();
  for (const FileEncoding encoding : {FileEncoding::text, kMshBinary}) {
    const MeshFile back = read_msh(encode_msh(mesh, encoding).bytes, "mesh.msh");
    expect_same_geometry(mesh, back.mesh);
    EXPECT_EQ(back.encoding, encoding);
  }
}

TEST(Msh, GroupsLinesPointsNamesAndCommentsSurvive) {
  const MeshFile file = read_msh(
      "$Comments\nmade by hand\n$EndComments\n" + kFormat2 +
          "$PhysicalNames\n1\n1 7 \"the wall\"\n$EndPhysicalNames\n" + kNodes2 +
          "$Elements\n4\n1 15 2 3 1 2\n2 1 2 7 5 1 2\n3 2 2 9 1 1 2 3\n4 2 2 10 1 1 3 4\n$EndElements\n",
      "a.msh");
  for (const FileEncoding encoding : {FileEncoding::text, kMshBinary}) {
    const EncodedMesh written = encode_msh(file.mesh, encoding);
    EXPECT_TRUE(written.messages.empty());
    const MeshFile back = read_msh(written.bytes, "b.msh");
    EXPECT_TRUE(same_geometry(file.mesh, back.mesh));
    EXPECT_TRUE(same_attributes(file.mesh.attributes, back.mesh.attributes));
  }
}

TEST(Msh, OtherFormatsSayThatTheyHaveNoPlaceForLines) {
  const MeshFile file =
      read_msh(kFormat2 + kNodes2 + "$Elements\n2\n1 1 2 7 5 1 2\n2 2 2 9 1 1 2 3\n$EndElements\n", "a.msh");
  EXPECT_TRUE(mentioned(encode_off(file.mesh).messages, "1 line beside the triangles not written"));
  EXPECT_TRUE(mentioned(encode_off(file.mesh).messages, "face attribute 'gmsh:physical' not written"));
}

TEST(Msh, WhatIsMalformedIsRefusedOnOneLineWithItsPlace) {
  struct Case {
    std::string bytes;
    const char* place;
    const char* reason;
  };
  const std::string element = "$Elements\n1\n1 2 0 1 2 3\n$EndElements\n";
  for (const Case& wrong : std::vector<Case>{
           {"", "line 1", "no section $MeshFormat"},
           {"$Nodes\n0\n$EndNodes\n", "line 1", "'$Nodes' stands before $MeshFormat"},
           {"$NOD\n0\n$ENDNOD\n", "line 1", "version 1"},
           {"$MeshFormat\n4 0 8\n$EndMeshFormat\n", "line 2", "version '4' of MSH is not read"},
           {"$MeshFormat\n2.2 2 8\n", "line 2", "neither 0 (text) nor 1 (binary)"},
           {"$MeshFormat\n2.2 0 4\n", "line 2", "numbers of 8 bytes"},
           {kFormat2 + "hello", "line 4", "expected a section"},
           {kFormat2 + "$Nodes\n4000000000\n1 0 0 0\n", "line 5", "promises 4000000000 nodes"},
           {kFormat2 + "$Nodes\n1\n1 0 nan 0\n$EndNodes\n", "line 6",
            "y coordinate of a node is not a number"},
           {kFormat2 + "$Nodes\n1\n1 0 0 1e999\n$EndNodes\n", "line 6", "infinite or too large"},
           {kFormat2 + "$Nodes\n2\n7 0 0 0\n7 1 0 0\n$EndNodes\n", "line 7", "node 7 stands twice"},
           {kFormat2 + "$Nodes\n1\n1 0 0 0\n", "line 7", "expected '$EndNodes', found the end"},
           {kFormat2 + element, "line 6", "names node 1, which does not stand before it"},
           {kFormat2 + kNodes2 + "$Elements\n1\n1 2 0 1 2 5\n$EndElements\n", "line 13", "names node 5"},
           {kFormat2 + kNodes2 + "$Elements\n1\n1 99 0 1 2 3\n$EndElements\n", "line 13",
            "type 99 is not known"},
           {kFormat2 + kNodes2 + "$Elements\n1\n1 9 0 1 2 3 4 1 2\n", "line 13", "Mesh.ElementOrder = 1"},
           {kFormat2 + kNodes2 + "$Elements\n9\n1 2 0 1 2 3\n", "line 12", "promises 9 elements"},
           {kFormat2 + kNodes2 + "$Periodic\n1\n", "line 11", "the file ends within '$Periodic'"},
           {kFormat2 + kNodes2 + "$Periodic\n1\n$EndPeriodic\n$Elements\nx\n", "line 15", "'x'"},
           {kFormat2 + kNodes2 + "$Elements\n0\n$EndElements\n", "", "holds no triangles"},
           {binary_2(std::endian::little).substr(0, 60), "byte", "bytes follow"},
           {binary_4(std::endian::big).substr(0, 300), "byte", "bytes follow"},
       }) {
    expect_refused({"msh", read_msh, wrong.bytes, wrong.place, wrong.reason});
  }
}

TEST(Msh, EveryBeginningOfAFileIsRefused) {
  const std::string text = kFormat2 + kNodes2 + "$Elements\n1\n1 2 2 0 1 1 2 3\n$EndElements";
  for (const std::string& bytes : {text, binary_2(std::endian::little), binary_4(std::endian::little)}) {
    EXPECT_NO_THROW(static_cast<void>(read_msh(bytes, "whole")));
    const std::size_t end = bytes.rfind("$EndElements") + 12;
    for (std::size_t size = 0; size < end; ++size)
      EXPECT_THROW(static_cast<void>(read_msh(bytes.substr(0, size), "cut")), InputError) << size;
  }
}

TEST(Msh, AnotherByteOrderIsNotWritten) {
  EXPECT_THROW(static_cast<void>(encode_msh(hard_numbers(), FileEncoding::binary_big_endian)), UsageError);
}

}  // namespace
}  // namespace isorelax
