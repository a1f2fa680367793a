#include "fuzz/reader_property.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace isorelax;
  fuzz::check_reader(data, size, read_vtk, [](const TriangleMesh& mesh) {
    for (const FileEncoding encoding : {FileEncoding::text, FileEncoding::binary_big_endian}) {
      fuzz::require_same_after(mesh, encode_vtk(mesh, encoding), read_vtk,
                               fuzz::Kept::geometry_and_attributes);
    }
    fuzz::require_same_after(mesh, encode_vtp(mesh, FileEncoding::text), read_vtk_xml,
                             fuzz::Kept::geometry_and_attributes);
    fuzz::require_same_after(mesh, encode_ply(mesh, FileEncoding::text), read_ply, fuzz::Kept::geometry);
  });
  return 0;
}
