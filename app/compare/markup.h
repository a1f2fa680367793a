#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace isorelax::compare {

/// Text that HTML and XML show as it stands: markup's own characters become entities, control characters that
/// XML forbids become U+FFFD.
[[nodiscard]] std::string escaped(std::string_view text);

/// RFC 4648.
[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace isorelax::compare
