#include "model/scan.h"

#include <utility>

#include "mesh/error.h"

namespace isorelax::model {

const Breakpoint* note_hits(std::span<const Breakpoint> breakpoints, const Moment& moment, unsigned branch,
                            std::vector<BreakHit>& hits) {
  const Breakpoint* stops = nullptr;
  for (const Breakpoint& point : breakpoints) {
    if (!point.enabled || !point.predicate || !point.predicate->holds(moment)) continue;
    hits.push_back({branch, static_cast<unsigned>(moment.iteration), point.text, point.action});
    if (point.action == BreakAction::stop && stops == nullptr) stops = &point;
  }
  return stops;
}

void scan(const JobContext& context, const ScanRange& range,
          const std::function<void(unsigned iteration, const ShowMoment& show)>& look) {
  try {
    Scanned scanned;
    for (unsigned k = range.from + 1; k <= range.to && !scanned.stop && !context.cancelled(); ++k) {
      context.progress("Looking at iteration " + std::to_string(k), -1);
      look(k, [&](const Moment& now) {
        const Breakpoint* stops = note_hits(range.breakpoints, now, range.branch, scanned.hits);
        if (stops == nullptr) return;
        scanned.stop = k;
        scanned.broken_by = stops->text;
      });
    }
    if (context.cancelled() && !scanned.stop) scanned.stop = range.from;
    context.publish(std::move(scanned));
  } catch (const Error& error) {
    context.publish(RunFailed{error.what()});
  }
}

}  // namespace isorelax::model
