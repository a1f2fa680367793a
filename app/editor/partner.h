#pragma once

#include <filesystem>
#include <future>
#include <optional>
#include <string>
#include <vector>

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
  /// Begins to read a mesh; take_over has it when it is there. What was still being read is no longer wanted.
  void read(const std::filesystem::path& path);
  /// Takes over a mesh that has been read. Returns what is to be told of it, once.
  std::optional<model::Message> take_over(ui::Comparison& comparison);
  [[nodiscard]] bool is_reading() const { return reading_.valid(); }
  /// Forgets states of another document, and goes back to the original from what is not there.
  void follow(const model::Session& session, ui::Comparison& comparison);
  /// Where a change is asked for from what has other triangles, goes back to the original. Returns what is to
  /// be told of that.
  std::optional<model::Message> require_change(const model::Session& session,
                                               ui::Comparison& comparison) const;

  /// What the comparison asks for; a null state where there is none.
  [[nodiscard]] Shown shown(const model::Session& session, const ui::Comparison& comparison) const;
  /// Whether that has the vertices and triangles of the session's mesh.
  [[nodiscard]] bool is_comparable(const model::Session& session, const ui::Comparison& comparison) const;

 private:
  struct FromFile {
    model::DocumentPtr document;
    model::MeshStatePtr state;
  };

  model::DocumentPtr document_;
  model::MeshStatePtr remembered_;
  FromFile file_;
  bool file_fits_ = false;  ///< it has the document's triangles
  std::future<FromFile> reading_;
  std::vector<std::future<FromFile>> unwanted_;  ///< until they end: nobody waits for them
};

}  // namespace isorelax::editor
