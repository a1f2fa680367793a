#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/command.h"
#include "render/camera.h"
#include "ui/ui_state.h"

namespace isorelax::editor {

/// Writes down what is done in the editor as a script that does it again. What only passes through, such as
/// the places between which one scrubs, is left out.
class SessionLog {
 public:
  /// Before a command is carried out. `camera` and `state` are what the user looks at meanwhile.
  void note(const model::Command& command, const model::Session& session, const render::Camera& camera,
            const ui::UiState& state);
  /// A run is written down when it has ended, by the iterations that it made: so a paused one comes back.
  void follow(const model::Session& session);
  /// The script so far, with the line that sizes the editor at its beginning and the view at its end.
  [[nodiscard]] std::string text(const std::string& size, const render::Camera& camera,
                                 const ui::UiState& state) const;

 private:
  struct Looks {
    std::string camera, tab, comparison;
    bool operator==(const Looks&) const = default;
  };
  static Looks looks_of(const render::Camera& camera, const ui::UiState& state);
  void note_looks(const Looks& now);
  void add(std::string line);

  std::vector<std::string> lines_;
  Looks looks_;
  std::optional<unsigned> run_from_;
  std::size_t run_at_ = 0;  ///< line before which it is written down
};

}  // namespace isorelax::editor
