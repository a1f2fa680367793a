#pragma once

#include "mesh/topology.h"
#include "smoothing/bounded_run.h"
#include "trace/trace.h"

namespace isorelax {

/// Records a run as it goes: call it from the run's observer.
class TraceRecorder {
 public:
  /// Begins at the mesh as it is now. `trace` keeps what the caller has written into it; its mesh and
  /// iterations are set here.
  TraceRecorder(Trace trace, const TriangleMesh& mesh, unsigned threads = 0);

  /// Iterations count from 1; one that is not the next begins the run anew from there: a run that is done
  /// again with more vertices held leaves only its last attempt.
  void add(unsigned iteration, const StepRecord& record, std::span<const Vec3> positions);

  /// The next iterations are made with this, from these positions; as a PartObserver. One that is not the
  /// next begins the run anew from there, too.
  void begin_part(const RunPart& part, std::span<const Vec3> positions);

  [[nodiscard]] const Trace& trace() const { return trace_; }
  [[nodiscard]] Trace& trace() { return trace_; }

 private:
  void go_back_to(std::size_t iteration);
  [[nodiscard]] TraceQuality measure(std::span<const Vec3> positions) const;

  Trace trace_;
  Topology topology_;
  unsigned threads_;
  std::vector<Vec3> last_;
  std::vector<VertexClass> classes_;
};

}  // namespace isorelax
