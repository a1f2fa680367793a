#pragma once

#include <string_view>

namespace isorelax::render {

/// The bytes of a shader, font or colour map that was built in, by its file name.
/// Throws std::logic_error for a name that was not.
std::string_view embedded_file(std::string_view name);

}  // namespace isorelax::render
