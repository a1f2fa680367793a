#include "fuzz/reader_property.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace isorelax;
  fuzz::check_reader(data, size, read_obj, [](const TriangleMesh& mesh) {
    fuzz::require_same_after(mesh, encode_obj(mesh), read_obj, fuzz::Kept::geometry_and_attributes);
    fuzz::require_same_after(mesh, encode_ply(mesh, FileEncoding::binary_little_endian), read_ply,
                             fuzz::Kept::geometry);
  });
  return 0;
}
