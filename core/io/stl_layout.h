#pragma once

#include <cstddef>
#include <string_view>

namespace isorelax {

/// Binary STL: 80 bytes of free text, the number of triangles, then for each a normal, three vertices
/// (floats) and two bytes of attributes.
inline constexpr std::size_t kStlTitle = 80;
inline constexpr std::size_t kStlHeader = 84;
inline constexpr std::size_t kStlFacet = 50;

/// Whether the size is exactly what the count in the header asks for.
[[nodiscard]] bool has_binary_stl_size(std::string_view bytes);

/// Whether the bytes are text STL: they begin with "solid" and are not binary STL with such a title, which
/// its exact size or a zero byte near the start gives away.
[[nodiscard]] bool is_text_stl(std::string_view bytes);

}  // namespace isorelax
