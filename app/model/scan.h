#pragma once

#include <functional>

#include "model/engine.h"

namespace isorelax::model {

/// Notes the breakpoints that hold at a moment of a branch. Returns the first of them that stops; null where
/// none does.
const Breakpoint* note_hits(std::span<const Breakpoint> breakpoints, const Moment& moment, unsigned branch,
                            std::vector<BreakHit>& hits);

/// Recorded iterations from + 1 to `to` of the timeline, and the breakpoints to look for in them.
struct ScanRange {
  unsigned branch = 0;
  unsigned from = 0, to = 0;
  std::vector<Breakpoint> breakpoints;
  bool ends = false;  ///< with `to` the run ends

  [[nodiscard]] bool stops_at(unsigned iteration) const { return ends && iteration == to; }
};
using ShowMoment = std::function<void(const Moment&)>;
/// Looks at one after the other, `look(iteration, show)`, which shows its moment once, until a breakpoint
/// stops or the user does: Scanned or RunFailed.
void scan(const JobContext& context, const ScanRange& range,
          const std::function<void(unsigned iteration, const ShowMoment& show)>& look);

}  // namespace isorelax::model
