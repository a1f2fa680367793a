#include "fuzz/reader_property.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace isorelax;
  fuzz::check_reader(data, size, read_stl, [](const TriangleMesh& mesh) {
    const MeshFile text = read_stl(encode_stl(mesh, FileEncoding::text).bytes, "text");
    fuzz::require(same_corners(mesh, text.mesh), "corners survive text STL");
    fuzz::require_same_after(mesh, encode_obj(mesh), read_obj, fuzz::Kept::geometry);
    try {
      const EncodedMesh binary = encode_stl(mesh, FileEncoding::binary_little_endian);
      const MeshFile back = read_stl(binary.bytes, "binary");
      const bool rounded = binary.messages.front().find("rounded") != std::string::npos;
      fuzz::require(rounded || same_corners(mesh, back.mesh),
                    "corners survive binary STL unless rounding is reported");
    } catch (const MeshError& error) {
      fuzz::require_one_line(error.what());
    }
  });
  return 0;
}
