#pragma once

#include <functional>
#include <string>
#include <vector>

#include "render/offscreen.h"
#include "view/view.h"

namespace CLI {
class App;
}

namespace isorelax::cli {

/// The options of commands that draw. They change a view: the default one, or one that a file gives.
class ViewOptions {
 public:
  /// Declares --size, --color, --range, ..., --camera, --like, --context.
  void declare(CLI::App& app);

  /// The view that was asked for. Throws UsageError, InputError.
  [[nodiscard]] view::View read() const;
  /// The folder of the file that the view came from: its meshes may be named from there. Empty: no file.
  [[nodiscard]] const std::string& source() const { return source_; }
  [[nodiscard]] render::ContextKind context() const { return context_; }

 private:
  using Change = std::function<void(view::View&)>;
  void declare_colors(CLI::App& app);
  void declare_drawing(CLI::App& app);
  void declare_camera(CLI::App& app);
  void text(CLI::App& app, const std::string& name, const char* kind, const std::string& help,
            std::function<Change(const std::string&)> change);
  void flag(CLI::App& app, const std::string& name, const std::string& help, bool view::View::*member);

  std::vector<Change> changes_;
  std::string source_;
  render::ContextKind context_ = render::ContextKind::osmesa;
};

}  // namespace isorelax::cli
