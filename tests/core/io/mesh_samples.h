#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "core/io/same_mesh.h"
#include "io/mesh_file.h"

namespace isorelax {

/// Two triangles whose coordinates are hard to keep: negative zero, the smallest and largest doubles, thirds.
inline TriangleMesh hard_numbers() {
  TriangleMesh mesh;
  mesh.positions = {{-0.0, 0.0, 1.0 / 3.0},
                    {4.9406564584124654e-324, 2.2250738585072011e-308, -1.7976931348623157e308},
                    {0.1, 1e23, 9007199254740993.0},
                    {-1e-300, 123456789.123456789, 3.0}};
  mesh.triangles = {{0, 1, 2}, {2, 1, 3}};
  return mesh;
}

inline void expect_same_geometry(const TriangleMesh& a, const TriangleMesh& b) {
  ASSERT_EQ(a.positions.size(), b.positions.size());
  for (std::size_t v = 0; v < a.positions.size(); ++v) {
    for (unsigned k = 0; k < 3; ++k) {
      EXPECT_TRUE(same_number(a.positions[v][k], b.positions[v][k]))
          << "vertex " << v << ": " << a.positions[v][k] << " became " << b.positions[v][k];
    }
  }
  EXPECT_EQ(a.triangles, b.triangles);
}

inline void expect_same_attributes(const std::vector<Attribute>& a, const std::vector<Attribute>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].type, b[i].type) << a[i].name;
    EXPECT_EQ(a[i].width, b[i].width) << a[i].name;
    EXPECT_TRUE(same_numbers(a[i].values, b[i].values)) << a[i].name;
  }
}

}  // namespace isorelax
