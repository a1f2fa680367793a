#include "cli/output_files.h"

#include <filesystem>

#include "io/atomic_file.h"
#include "mesh/error.h"

namespace isorelax::cli {
namespace {

namespace fs = std::filesystem;

/// Whether two names are of one file, there or not. Devices take what they get.
bool same_file(const std::string& a, const std::string& b) {
  std::error_code problem;
  if (fs::exists(a, problem) && !fs::is_regular_file(a, problem)) return false;
  if (fs::equivalent(a, b, problem)) return true;
  const fs::path whole_a = fs::weakly_canonical(fs::absolute(a, problem), problem);
  const fs::path whole_b = fs::weakly_canonical(fs::absolute(b, problem), problem);
  return whole_a == whole_b;
}

}  // namespace

void check_outputs(std::span<const OutputFile> outputs, const std::vector<std::string>& inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto& [option, path] = outputs[i];
    if (path.empty()) continue;
    for (const std::string& input : inputs) {
      if (!input.empty() && same_file(path, input))
        throw UsageError(option + " " + path + ": would replace a file that is read");
    }
    for (const OutputFile& earlier : outputs.first(i)) {
      if (!earlier.path.empty() && same_file(path, earlier.path))
        throw UsageError(option + " " + path + ": is what " + earlier.option + " writes, too");
    }
    check_writable(path);
  }
}

}  // namespace isorelax::cli
