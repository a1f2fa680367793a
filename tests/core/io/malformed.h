#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <ostream>
#include <string>

#include "io/mesh_file.h"
#include "mesh/error.h"

namespace isorelax {

/// A file that no reader may take.
struct Malformed {
  const char* name;
  MeshFile (*read)(std::string_view, const std::string&);
  std::string bytes;
  /// What the one line after "FILE: " begins with, and a part of its reason.
  const char* place;
  const char* reason;
};

// The name by which GoogleTest finds it.
inline void PrintTo(const Malformed& file, std::ostream* out) {  // NOLINT(readability-identifier-naming)
  *out << file.name;
}

inline void expect_refused(const Malformed& file) {
  try {
    static_cast<void>(file.read(file.bytes, "dir/mesh.xyz"));
    ADD_FAILURE() << file.name << " was read";
  } catch (const InputError& error) {
    const std::string text = error.what();
    const std::string start = "dir/mesh.xyz: " + std::string(file.place);
    EXPECT_TRUE(text.starts_with(start)) << text;
    if (const char last = start.back(); std::isdigit(static_cast<unsigned char>(last)) != 0) {
      EXPECT_EQ(text[start.size()], ':') << text;
    }
    EXPECT_NE(text.find(file.reason), std::string::npos) << text;
    EXPECT_EQ(text.find_first_of("\n\r"), std::string::npos) << text;
    EXPECT_LT(text.size(), 1000U);
  }
}

}  // namespace isorelax
