#pragma once

#include <string>
#include <vector>

#include "trace/predicate.h"

namespace CLI {
class App;
}

namespace isorelax::cli {

class Console;

/// Predicates on the iterations of a run, as typed: --break ends the run where one holds, --log tells.
class Watch {
 public:
  void declare(CLI::App& app);
  /// Throws UsageError for a predicate with a mistake, at its column.
  void check();
  /// Throws UsageError for a predicate that names a vertex or triangle that this mesh does not have.
  void check(const TriangleMesh& mesh) const;
  [[nodiscard]] bool wanted() const { return !breaks_.empty() || !logs_.empty(); }

  /// Looks at the iteration that `trace` has just taken up. Returns whether the run goes on.
  [[nodiscard]] bool look(Console& console, const Trace& trace, const StepRecord& record,
                          std::span<const Vec3> positions);
  /// Tells that the iterations that follow are those of another attempt.
  void begin_again(Console& console) const;
  /// The predicate that ended the run; empty: none did.
  [[nodiscard]] const std::string& broken_by() const { return broken_by_; }
  /// Looks once more at the last iteration, as the last one.
  void finish(Console& console, const Trace& trace) const;

 private:
  std::vector<std::string> typed_breaks_, typed_logs_;
  std::vector<Predicate> breaks_, logs_;
  /// The last iteration, kept for what holds only there.
  StepRecord last_;
  std::vector<Vec3> last_positions_;
  std::string broken_by_;
};

}  // namespace isorelax::cli
