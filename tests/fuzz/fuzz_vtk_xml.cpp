#include "fuzz/reader_property.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace isorelax;
  fuzz::check_reader(data, size, read_vtk_xml, [](const TriangleMesh& mesh) {
    for (const FileEncoding encoding : {FileEncoding::text, FileEncoding::binary_little_endian}) {
      fuzz::require_same_after(mesh, encode_vtp(mesh, encoding), read_vtk_xml,
                               fuzz::Kept::geometry_and_attributes);
      fuzz::require_same_after(mesh, encode_vtu(mesh, encoding), read_vtk_xml,
                               fuzz::Kept::geometry_and_attributes);
    }
    fuzz::require_same_after(mesh, encode_vtk(mesh, FileEncoding::text), read_vtk,
                             fuzz::Kept::geometry_and_attributes);
    fuzz::require_same_after(mesh, encode_obj(mesh), read_obj, fuzz::Kept::geometry);
  });
  return 0;
}
