#include "model/recording.h"

#include <algorithm>
#include <atomic>

#include "mesh/error.h"
#include "trace/position_delta.h"
#include "trace/trace_parts.h"

namespace isorelax::model {
namespace {

/// Whole positions that a recording keeps, in bytes.
constexpr std::size_t kWholeBudget = std::size_t{256} << 20U;

std::uint64_t next_number() {
  static std::atomic<std::uint64_t> count{0};
  return ++count;
}

}  // namespace

Recording::Recording() : number_(next_number()) {}

void Recording::begin(Trace about, const TriangleMesh& mesh, std::span<const Vec3> start, BasePtr base) {
  const std::vector<Vec3>& made_from = base ? *base : mesh.positions;
  const TriangleMesh from{{start.begin(), start.end()}, mesh.triangles, {}};
  recorder_ = std::make_unique<TraceRecorder>(std::move(about), from);
  if (!same_bits(start, made_from)) to_base_ = encode_delta(start, made_from);
  from_base_ = base && same_bits(start, mesh.positions) && !same_bits(start, *base);
  base_ = std::move(base);
}

std::span<const Vec3> Recording::next_start(std::span<const Vec3> at) const {
  return from_base_ && size() == 0 ? *base_ : at;
}

void Recording::take(Trace trace, ReadAs as) {
  taken_ = std::make_unique<Trace>(std::move(trace));
  read_as_ = std::move(as);
}

void Recording::note_fresh_start(PartKind kind, const SmoothingProblem& problem) {
  std::vector<TracePart>& parts = trace().parts;
  if (!parts.empty() && parts.back().done == size()) parts.pop_back();  // it made no step
  TracePart part;
  part.done = size();
  part.kind = kind;
  part.exponent = problem.exponent;
  if (problem.near) {
    part.holds.distance = problem.near->distance;
    part.holds.on_fits = problem.near->on_fits;
  }
  part.holds.apart = problem.apart;
  part.base = to_base_;
  part.from_base = from_base_ && size() == 0;
  parts.push_back(std::move(part));
}

void Recording::add(const StepRecord& record, std::span<const Vec3> positions) {
  recorder_->add(size() + 1, record, positions);
  if (size() % stride_ == 0) keep(size(), positions);
}

void Recording::keep(unsigned iteration, std::span<const Vec3> positions) {
  whole_[iteration].assign(positions.begin(), positions.end());
  while (whole_.size() > 2 && whole_.size() * positions.size_bytes() > kWholeBudget) {
    stride_ *= 2;
    std::erase_if(whole_, [&](const auto& entry) { return entry.first % stride_ != 0; });
  }
}

std::vector<Vec3> Recording::positions_at(unsigned iteration) {
  if (iteration > size()) throw Error("iteration " + std::to_string(iteration) + " is not recorded");
  // From the nearest whole positions, forwards or backwards.
  unsigned at = 0;
  const std::vector<Vec3>* from = &trace().positions;
  const auto nearer = [&](auto entry) {
    const auto distance = [&](unsigned k) { return k > iteration ? k - iteration : iteration - k; };
    if (entry == whole_.end() || distance(entry->first) >= distance(at)) return;
    at = entry->first;
    from = &entry->second;
  };
  const auto after = whole_.lower_bound(iteration);
  nearer(after);
  if (after != whole_.begin()) nearer(std::prev(after));
  std::vector<Vec3> positions = *from;
  while (at != iteration) {
    const bool forward = at < iteration;
    const unsigned crossed = forward ? at : at - 1;
    if (!apply_delta(trace().iterations[crossed].delta, positions))
      throw Error("iteration " + std::to_string(crossed + 1) + " of the recording is damaged");
    at = forward ? at + 1 : at - 1;
    if (at % stride_ == 0 && !whole_.contains(at)) keep(at, positions);
  }
  return positions;
}

void StepStore::set_budget(std::size_t bytes) {
  budget_ = bytes;
  drop_oldest();
}

void StepStore::add(std::uint64_t recording, unsigned iteration, std::shared_ptr<const StepRecord> record) {
  const std::size_t bytes = bytes_of(*record);
  if (bytes > budget_ || find(recording, iteration)) return;
  kept_.push_back({{recording, iteration}, std::move(record), bytes});
  bytes_ += bytes;
  drop_oldest();
}

std::shared_ptr<const StepRecord> StepStore::find(std::uint64_t recording, unsigned iteration) const {
  const auto found = std::ranges::find_if(kept_, [&](const Kept& kept) {
    return kept.key == Key{recording, iteration};
  });
  return found == kept_.end() ? nullptr : found->record;
}

void StepStore::drop_oldest() {
  while (bytes_ > budget_ && !kept_.empty()) {
    bytes_ -= kept_.front().bytes;
    kept_.pop_front();
  }
}

void StepStore::clear() {
  kept_.clear();
  bytes_ = 0;
}

}  // namespace isorelax::model
