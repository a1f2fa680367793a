#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace isorelax {

enum class FileFormat : std::uint8_t { off, obj, ply, stl, msh, vtk, vtp, vtu };
inline constexpr std::array kFileFormats{FileFormat::off, FileFormat::obj, FileFormat::ply, FileFormat::stl,
                                         FileFormat::msh, FileFormat::vtk, FileFormat::vtp, FileFormat::vtu};

/// How numbers stand in a file. OFF and OBJ are always text; binary STL is always little endian, binary VTK
/// always big endian; other binary files are written little endian.
enum class FileEncoding : std::uint8_t { text, binary_little_endian, binary_big_endian };

/// "OFF", "OBJ", "PLY", ...: also the extension, in capitals.
[[nodiscard]] const char* format_name(FileFormat format);
/// "OFF, OBJ, PLY, ... or VTU": what is read and written.
[[nodiscard]] std::string format_names();

/// The format that the extension of `path` names, in any case of letters; none for any other extension.
[[nodiscard]] std::optional<FileFormat> format_of_extension(const std::filesystem::path& path);

/// The format that the first bytes of a file show; none when they fit no format that is read here.
[[nodiscard]] std::optional<FileFormat> format_of_content(std::string_view bytes);

/// A mesh as read, and what its reader had to change or leave out: one line of text for each kind of change,
/// with counts.
struct MeshFile {
  TriangleMesh mesh;
  FileFormat format = FileFormat::off;
  FileEncoding encoding = FileEncoding::text;
  std::vector<std::string> messages;
};

/// Reads a mesh file of any FileFormat. The content decides which; the extension only where the content is
/// undecided.
///
/// Vertex order is the file's (STL: order of first appearance of each position). Polygons are cut into
/// triangles. Time and memory are bounded by the size of the file, whatever its header says.
/// Throws InputError: unreadable or irregular file, unknown format, malformed content (with line or byte), an
/// index out of range, a coordinate that is not finite, no triangle at all.
[[nodiscard]] MeshFile read_mesh(const std::filesystem::path& path);

/// All bytes of a regular file. Throws InputError.
[[nodiscard]] std::string read_bytes(const std::filesystem::path& path);

/// Throws the InputError that opening `path` would meet; looks at nothing in it.
void check_readable(const std::filesystem::path& path);

/// Readers of one format from memory; `name` stands in messages. Same promises as read_mesh.
[[nodiscard]] MeshFile read_off(std::string_view bytes, const std::string& name);
[[nodiscard]] MeshFile read_obj(std::string_view bytes, const std::string& name);
[[nodiscard]] MeshFile read_ply(std::string_view bytes, const std::string& name);
[[nodiscard]] MeshFile read_stl(std::string_view bytes, const std::string& name);
/// Gmsh's own format, versions 2 and 4.1, text and binary.
[[nodiscard]] MeshFile read_msh(std::string_view bytes, const std::string& name);
/// Legacy VTK files: POLYDATA and UNSTRUCTURED_GRID, ASCII and BINARY.
[[nodiscard]] MeshFile read_vtk(std::string_view bytes, const std::string& name);
/// VTK's XML files: PolyData (VTP) and UnstructuredGrid (VTU), serial, uncompressed or with zlib.
[[nodiscard]] MeshFile read_vtk_xml(std::string_view bytes, const std::string& name);

/// Whether files of a format are written in this encoding.
[[nodiscard]] bool is_written_as(FileFormat format, FileEncoding encoding);

struct WriteOptions {
  /// None: by the extension of the path.
  std::optional<FileFormat> format;
  /// None: text for OFF, OBJ and MSH, big-endian binary for VTK, little-endian binary for all others.
  std::optional<FileEncoding> encoding;
};

/// How to write to `path` what was read from `input`: text stays text, and binary binary, where the format
/// stays the same.
[[nodiscard]] WriteOptions write_like(const MeshFile& input, const std::filesystem::path& path);

/// A file's bytes, and one line for each kind of thing that the format could not hold.
struct EncodedMesh {
  std::string bytes;
  std::vector<std::string> messages;
};

/// Writers of one format into memory. All but STL hold every position bit for bit; so does text STL, but STL
/// forgets which triangles share a vertex. Throw UsageError for an encoding that the format does not
/// have. Precondition: the mesh's invariants (indices in range, attribute arrays of matching size).
[[nodiscard]] EncodedMesh encode_off(const TriangleMesh& mesh);
[[nodiscard]] EncodedMesh encode_obj(const TriangleMesh& mesh);
[[nodiscard]] EncodedMesh encode_ply(const TriangleMesh& mesh, FileEncoding encoding);
[[nodiscard]] EncodedMesh encode_stl(const TriangleMesh& mesh, FileEncoding encoding);
/// Version 2.2, which all programs read.
[[nodiscard]] EncodedMesh encode_msh(const TriangleMesh& mesh, FileEncoding encoding);
[[nodiscard]] EncodedMesh encode_vtk(const TriangleMesh& mesh, FileEncoding encoding);
[[nodiscard]] EncodedMesh encode_vtp(const TriangleMesh& mesh, FileEncoding encoding);
[[nodiscard]] EncodedMesh encode_vtu(const TriangleMesh& mesh, FileEncoding encoding);

/// Writes the mesh whole or not at all and returns what the format could not hold.
///
/// Throws UsageError when neither options nor extension name a format, or the format has no such encoding;
/// OutputError when the file cannot be written.
[[nodiscard]] std::vector<std::string> write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh,
                                                  const WriteOptions& options = {});

}  // namespace isorelax
