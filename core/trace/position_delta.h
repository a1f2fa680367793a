#pragma once

#include <span>
#include <string>
#include <string_view>

#include "mesh/triangle_mesh.h"

namespace isorelax {

/// What turns one set of positions into another, and back again, to the bit: the exclusive or of all
/// coordinates, sorted by byte of the number so that what hardly changes stands together, compressed with
/// zstd and its checksum. Both sets have the same size.
[[nodiscard]] std::string encode_delta(std::span<const Vec3> from, std::span<const Vec3> to);

/// Applies a delta in place, in either direction. Returns false, and leaves the positions as they are, when
/// `delta` is damaged or made for another number of vertices.
[[nodiscard]] bool apply_delta(std::string_view delta, std::span<Vec3> positions);

/// Any bytes, compressed with a checksum.
[[nodiscard]] std::string compress(std::string_view bytes);

/// Undoes compress(). Returns false when the bytes are damaged or would grow to another size than `size`.
[[nodiscard]] bool decompress(std::string_view packed, std::size_t size, std::string& bytes);

}  // namespace isorelax
