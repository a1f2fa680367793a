#include <gtest/gtest.h>

#include "core/io/mesh_samples.h"

namespace isorelax {
namespace {

constexpr FileEncoding kLittle = FileEncoding::binary_little_endian;
constexpr FileEncoding kBig = FileEncoding::binary_big_endian;

TEST(RoundTrip, OffKeepsEveryBitOfEveryCoordinate) {
  const TriangleMesh mesh = hard_numbers();
  expect_same_geometry(mesh, read_off(encode_off(mesh).bytes, "mesh.off").mesh);
}

TEST(RoundTrip, ObjKeepsEveryBitOfEveryCoordinate) {
  const TriangleMesh mesh = hard_numbers();
  expect_same_geometry(mesh, read_obj(encode_obj(mesh).bytes, "mesh.obj").mesh);
}

TEST(RoundTrip, PlyKeepsEveryBitOfEveryCoordinateInAllThreeEncodings) {
  const TriangleMesh mesh = hard_numbers();
  for (const FileEncoding encoding : {FileEncoding::text, kLittle, kBig}) {
    const MeshFile back = read_ply(encode_ply(mesh, encoding).bytes, "mesh.ply");
    expect_same_geometry(mesh, back.mesh);
    EXPECT_EQ(back.encoding, encoding);
  }
}

}  // namespace
}  // namespace isorelax
