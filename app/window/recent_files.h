#pragma once

#include <filesystem>
#include <vector>

namespace isorelax::window {

/// The files opened most recently, newest first, as kept in $XDG_STATE_HOME/isorelax/recent (or below
/// ~/.local/state). Empty when there is no such list; never throws.
[[nodiscard]] std::vector<std::filesystem::path> load_recent_files();
/// Keeps the list for the next start. A list that cannot be written is no reason to complain.
void save_recent_files(const std::vector<std::filesystem::path>& files);

}  // namespace isorelax::window
