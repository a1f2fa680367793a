#pragma once

#include <span>
#include <string>
#include <vector>

namespace isorelax::cli {

/// A file that a command is asked to write. An empty path: it is not.
struct OutputFile {
  std::string option;  ///< as typed: "--report"
  std::string path;
};

/// Checks before any work that the files can be written, and that none takes the place of a file that is read
/// or of one written before it. What a mesh is written to may be the one it came from: leave that out of
/// `inputs`. Throws UsageError, OutputError.
void check_outputs(std::span<const OutputFile> outputs, const std::vector<std::string>& inputs);

}  // namespace isorelax::cli
