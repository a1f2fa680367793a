#pragma once

#include <string_view>

namespace isorelax::window {

/// The bytes of a shader, font or icon that was built in, by its file name.
/// Throws std::logic_error for a name that was not.
std::string_view embedded_file(std::string_view name);

}  // namespace isorelax::window
