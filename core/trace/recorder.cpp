#include "trace/recorder.h"

#include <utility>

#include "quality/report.h"
#include "trace/position_delta.h"
#include "trace/trace_parts.h"

namespace isorelax {

TraceRecorder::TraceRecorder(Trace trace, const TriangleMesh& mesh, unsigned threads)
    : trace_(std::move(trace)),
      topology_(mesh.triangles, mesh.vertex_count()),
      threads_(threads),
      last_(mesh.positions) {
  trace_.positions = mesh.positions;
  trace_.triangles = mesh.triangles;
  trace_.quality = measure(mesh.positions);
  trace_.iterations.clear();
  trace_.parts.clear();
}

TraceQuality TraceRecorder::measure(std::span<const Vec3> positions) const {
  const QualityReport report = measure_quality(positions, trace_.triangles, topology_, threads_);
  return {report.min_angle_deg, report.max_angle_deg, report.mean_min_angle_deg, report.inverted};
}

void TraceRecorder::go_back_to(std::size_t iteration) {
  if (iteration == trace_.iterations.size()) return;
  TraceCursor cursor(trace_);
  last_ = cursor.go_to(iteration);
  trace_.iterations.resize(iteration);
  classes_.clear();
}

void TraceRecorder::begin_part(const RunPart& part, std::span<const Vec3> positions) {
  go_back_to(part.done);
  std::erase_if(trace_.parts, [&](const TracePart& one) { return one.done >= part.done; });
  TracePart entry;
  entry.done = part.done;
  entry.exponent = part.exponent;
  entry.kind = part.polish ? PartKind::polish : PartKind::solver;
  entry.holds = part.holds;
  if (part.done > 0) {
    if (!trace_.parts.empty()) entry.base = trace_.parts.front().base;
  } else if (!same_bits(trace_.positions, positions)) {
    entry.base = encode_delta(trace_.positions, positions);
    entry.from_base = true;
  }
  trace_.parts.push_back(std::move(entry));
}

void TraceRecorder::add(unsigned iteration, const StepRecord& record, std::span<const Vec3> positions) {
  go_back_to(iteration - 1);
  TraceIteration entry;
  entry.kind = record.kind;
  entry.before = record.before;
  entry.after = record.after;
  entry.largest_move = record.largest_move;
  entry.fold_passes = record.fold_passes;
  entry.energy_passes = record.energy_passes;
  entry.moved = record.moved;
  entry.limits = count_limits(record.limits);
  if (classes_.size() == record.tangent_class.size()) {
    for (std::size_t v = 0; v < classes_.size(); ++v)
      entry.class_changes += classes_[v] != record.tangent_class[v] ? 1 : 0;
  }
  classes_ = record.tangent_class;
  entry.quality = measure(positions);
  entry.delta = encode_delta(last_, positions);
  last_.assign(positions.begin(), positions.end());
  trace_.iterations.push_back(std::move(entry));
}

}  // namespace isorelax
