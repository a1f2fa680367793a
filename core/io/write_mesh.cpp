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
    case FileFormat::msh:
      return encode_msh(mesh, encoding);
    case FileFormat::vtk:
      return encode_vtk(mesh, encoding);
    case FileFormat::vtp:
      return encode_vtp(mesh, encoding);
    case FileFormat::vtu:
      return encode_vtu(mesh, encoding);
  }
  throw UsageError("unknown format");
}

FileEncoding usual_encoding(FileFormat format) {
  switch (format) {
    case FileFormat::off:
    case FileFormat::obj:
    case FileFormat::msh:
      return FileEncoding::text;
    case FileFormat::vtk:
      return FileEncoding::binary_big_endian;
    default:
      return FileEncoding::binary_little_endian;
  }
}

}  // namespace

bool is_written_as(FileFormat format, FileEncoding encoding) {
  return encoding == FileEncoding::text || encoding == usual_encoding(format) || format == FileFormat::ply ||
         (format == FileFormat::msh && encoding == FileEncoding::binary_little_endian);
}

WriteOptions write_like(const MeshFile& input, const std::filesystem::path& path) {
  WriteOptions options;
  if (format_of_extension(path) != input.format) {
    return options;
  }
  for (const FileEncoding encoding :
       {input.encoding, FileEncoding::binary_little_endian, FileEncoding::binary_big_endian}) {
    if (is_written_as(input.format, encoding)) {
      options.encoding = encoding;
      break;
    }
  }
  return options;
}

std::vector<std::string> write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh,
                                    const WriteOptions& options) {
  const std::optional<FileFormat> format = options.format ? options.format : format_of_extension(path);
  if (!format) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
      throw OutputError(one_line(path.string()), "is a folder");
    throw UsageError(one_line(path.string()) +
                     ": the extension names no format that is written: " + format_names());
  }
  const FileEncoding encoding = options.encoding.value_or(usual_encoding(*format));
  if (!is_written_as(*format, encoding)) {
    throw UsageError(std::string(format_name(*format)) + " is not written in this encoding");
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
