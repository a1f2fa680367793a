#include "fuzz/reader_property.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace isorelax;
  fuzz::check_reader(data, size, read_msh, [](const TriangleMesh& mesh) {
    for (const FileEncoding encoding : {FileEncoding::text, FileEncoding::binary_little_endian})
      fuzz::require_same_after(mesh, encode_msh(mesh, encoding), read_msh,
                               fuzz::Kept::geometry_and_attributes);
    fuzz::require_same_after(mesh, encode_off(mesh), read_off, fuzz::Kept::geometry);
  });
  return 0;
}
