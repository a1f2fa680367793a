#pragma once

#include <string_view>

namespace isorelax::compare {

/// The bytes of the page's style and script, by file name. Throws std::logic_error for another name.
std::string_view embedded_file(std::string_view name);

}  // namespace isorelax::compare
