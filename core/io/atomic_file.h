#pragma once

#include <filesystem>
#include <string_view>

namespace isorelax {

/// Writes a file whole or not at all: into a new file in the same folder, flushed to the disk, then renamed.
///
/// A file that is there already keeps its permissions, and its owner where the system allows; a symbolic link
/// is followed, and what it points to is replaced. Devices, pipes and whatever stands under /dev and /proc
/// (/dev/stdout) are written to straight. Throws OutputError with the system's reason; the old file is then
/// untouched and nothing new is left behind.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Throws the OutputError that writing `path` would meet for want of its folder or of permission, before long
/// work is spent on what to write. Leaves no trace.
void check_writable(const std::filesystem::path& path);

}  // namespace isorelax
