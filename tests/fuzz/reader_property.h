#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "core/io/same_mesh.h"
#include "io/mesh_file.h"
#include "mesh/error.h"

namespace isorelax::fuzz {

/// Ends the run: libFuzzer then keeps the input.
inline void require(bool holds, const std::string& what) {
  if (!holds) {
    std::fprintf(stderr, "property does not hold: %s\n", what.c_str());
    std::abort();
  }
}

inline void require_one_line(std::string_view text) {
  require(text.find_first_of("\n\r") == std::string_view::npos, "a message is one line");
  require(text.size() < 1000, "a message is short");
}

inline void require_usable(const TriangleMesh& mesh) {
  require(!mesh.triangles.empty(), "a mesh has triangles");
  for (const Vec3& position : mesh.positions) {
    require(position.allFinite(), "positions are finite");
  }
  for (const Triangle& triangle : mesh.triangles) {
    for (const Index vertex : triangle) {
      require(vertex < mesh.positions.size(), "indices are in range");
    }
  }
  const MeshAttributes& attributes = mesh.attributes;
  for (const Attribute& attribute : attributes.vertex) {
    require(attribute.values.size() == attribute.width * mesh.positions.size(), "one row per vertex");
  }
  for (const Attribute& attribute : attributes.face) {
    require(attribute.values.size() == attribute.width * mesh.triangles.size(), "one row per triangle");
  }
  for (const CornerAttribute& corner : attributes.corner) {
    require(corner.indices.size() == 3 * mesh.triangles.size(), "one index per corner");
    for (const std::uint32_t index : corner.indices) {
      require(index == kNone || (index + std::uint64_t{1}) * corner.width <= corner.values.size(),
              "corner indices are in range");
    }
  }
  for (const FaceLabels& labels : attributes.face_labels) {
    require(labels.face_label.size() == mesh.triangles.size(), "one label per triangle");
    for (const std::uint32_t label : labels.face_label) {
      require(label == kNone || label < labels.labels.size(), "labels are in range");
    }
  }
}

using Reader = MeshFile (*)(std::string_view, const std::string&);

/// What a round trip has to keep. Another format may have other words for an attribute: bytes for fractions,
/// corners for vertices.
enum class Kept : std::uint8_t { geometry, geometry_and_attributes };

/// Reads `file` back and compares; attributes only where the writer reported no loss.
inline void require_same_after(const TriangleMesh& mesh, const EncodedMesh& file, Reader reader, Kept kept) {
  for (const std::string& message : file.messages) {
    require_one_line(message);
  }
  try {
    const MeshFile back = reader(file.bytes, "written");
    require_usable(back.mesh);
    require(same_geometry(mesh, back.mesh), "geometry survives a round trip");
    require(kept == Kept::geometry || !file.messages.empty() ||
                same_attributes(mesh.attributes, back.mesh.attributes),
            "attributes survive a round trip, or a message says which do not");
  } catch (const Error& error) {
    require(false, std::string("what was written can be read: ") + error.what());
  }
}

/// Any bytes give a usable mesh or a one-line error.
template <class Check>
void check_reader(const std::uint8_t* data, std::size_t size, Reader reader, Check check) {
  MeshFile file;
  try {
    file = reader({reinterpret_cast<const char*>(data), size}, "input");
  } catch (const Error& error) {
    require_one_line(error.what());
    return;
  }
  for (const std::string& message : file.messages) {
    require_one_line(message);
  }
  require_usable(file.mesh);
  check(file.mesh);
}

}  // namespace isorelax::fuzz
