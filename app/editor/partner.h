#pragma once

#include <filesystem>
#include <future>
#include <string>

#include "editor/view_scene.h"
#include "model/session.h"
#include "ui/ui_state.h"

namespace isorelax::editor {

/// What the current state is compared with: the original, a state that was remembered, or a mesh from another
/// file.
class Partner {
 public:
  /// Keeps the session's present state. Precondition: session.current.
  void remember(const model::Session& session, ui::Comparison& comparison);
  /// Begins to read a mesh; take_over has it when it is there.
  void read(const std::filesystem::path& path);
  /// Takes over a mesh that has been read. Returns what is to be told: an error, or nothing.
  std::string take_over(ui::Comparison& comparison);
  [[nodiscard]] bool is_reading() const { return reading_.valid(); }
  /// Forgets states of another document.
  void follow(const model::Session& session, ui::Comparison& comparison);

  /// What the comparison asks for; a null state where there is none.
  [[nodiscard]] Shown shown(const model::Session& session, const ui::Comparison& comparison) const;

 private:
  struct FromFile {
    model::DocumentPtr document;
    model::MeshStatePtr state;
  };

  model::DocumentPtr document_;
  model::MeshStatePtr remembered_;
  FromFile file_;
  std::future<FromFile> reading_;
};

}  // namespace isorelax::editor
