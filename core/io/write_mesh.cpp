#include "io/atomic_file.h"
#include "io/mesh_file.h"
#include "io/text_scanner.h"
#include "mesh/error.h"

namespace isorelax {
namespace {

EncodedMesh encode(const TriangleMesh& mesh, FileFormat format, FileEncoding encoding) {
  switch (format) {
    case FileFormat::off:
      return encode_off(mesh);
    case FileFormat::obj:
      return encode_obj(mesh);
    case FileFormat::ply:
      return encode_ply(mesh, encoding);
    case FileFormat::stl:
      return encode_stl(mesh, encoding);
  }
  throw UsageError("unknown format");
}

}  // namespace

std::vector<std::string> write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh,
                                    const WriteOptions& options) {
  const std::optional<FileFormat> format = options.format ? options.format : format_of_extension(path);
  if (!format) {
    throw UsageError(one_line(path.string()) +
                     ": the extension names no format that is written: .off, .obj, .ply or .stl");
  }
  const bool text_only = *format == FileFormat::off || *format == FileFormat::obj;
  const FileEncoding encoding =
      options.encoding.value_or(text_only ? FileEncoding::text : FileEncoding::binary_little_endian);
  if (text_only && encoding != FileEncoding::text) {
    throw UsageError(std::string(format_name(*format)) + " has no binary form here");
  }
  try {
    EncodedMesh file = encode(mesh, *format, encoding);
    write_file_atomically(path, file.bytes);
    return std::move(file.messages);
  } catch (const MeshError& error) {  // the mesh is sound; this format cannot hold it
    throw OutputError(one_line(path.string()), error.what());
  }
}

}  // namespace isorelax
