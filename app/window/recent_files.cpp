#include "window/recent_files.h"

#include <cstdlib>
#include <fstream>
#include <string>

namespace isorelax::window {
namespace {

namespace fs = std::filesystem;

fs::path list_path() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state != '\0')
    return fs::path(state) / "isorelax" / "recent";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return fs::path(home) / ".local" / "state" / "isorelax" / "recent";
  return {};
}

}  // namespace

std::vector<fs::path> load_recent_files() {
  std::vector<fs::path> files;
  std::ifstream list(list_path());
  std::error_code error;
  for (std::string line; std::getline(list, line);)
    if (!line.empty() && fs::is_regular_file(line, error)) files.emplace_back(line);
  return files;
}

void save_recent_files(const std::vector<fs::path>& files) {
  const fs::path path = list_path();
  if (path.empty() || files.empty()) return;
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  const fs::path temporary = path.string() + ".new";
  {
    std::ofstream list(temporary);
    for (const fs::path& file : files) list << file.string() << '\n';
    list.flush();
    if (!list) return;
  }
  fs::rename(temporary, path, error);
}

}  // namespace isorelax::window
