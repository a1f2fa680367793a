#pragma once

#include <span>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace CLI {
class App;
}

namespace isorelax::cli {

class Console;

/// Pictures of a run: the start, every k-th iteration and the end, under one camera and one range of colours.
class Frames {
 public:
  /// Declares --frames, --every and --view.
  void declare(CLI::App& app);

  [[nodiscard]] bool wanted() const { return !target_.empty(); }
  /// Throws the OutputError that writing would meet, before the run. Keeps the start.
  void start(std::span<const Vec3> positions);
  /// Keeps what is to be shown of an iteration. A run that starts again replaces what was kept of the one
  /// before.
  void take(unsigned iteration, std::span<const Vec3> positions);
  /// Draws and writes all frames: numbered files in a folder, or one animated PNG. `mesh` is the result,
  /// after so many iterations, those of a polish too. Throws OutputError, UsageError (the view).
  void write(Console& console, const TriangleMesh& mesh, unsigned iterations) const;

 private:
  struct Frame {
    unsigned iteration = 0;
    std::vector<Vec3> positions;
  };

  std::string target_, view_ = "fit";
  unsigned every_ = 1;
  std::vector<Frame> frames_;
};

}  // namespace isorelax::cli
