#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/camera.h"
#include "trace/redo.h"

namespace isorelax::editor {

/// How a session of the editor is done again from its script.
struct ScriptOptions {
  std::filesystem::path file;           ///< the script; names in it are taken from its folder
  std::filesystem::path pictures;       ///< folder for screenshots, made if need be; empty: the script's
  render::PictureSize size{1280, 720};  ///< of the editor, until the script says otherwise
  float scale = 1;                      ///< pixels per point
  PlanReader read_plan{};               ///< for recorded runs; as the Editor's
};

/// What came of it.
struct ScriptResult {
  std::vector<std::filesystem::path> pictures;
  /// Expectations that did not hold: "FILE: line 7: ..." each.
  std::vector<std::string> failures;
};

/// Does what a script says, in an editor without a display: one command in a line, # begins a comment. After
/// each line it waits until all is done. Throws, with the line, UsageError for one that is not understood or
/// asks for what is not there, OutputError for what cannot be written, InputError for what else cannot be
/// done.
[[nodiscard]] ScriptResult run_script(const ScriptOptions& options);

/// All commands of scripts, a line each: for --help.
[[nodiscard]] std::string script_reference();

}  // namespace isorelax::editor
