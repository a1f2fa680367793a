#include "model/undo.h"

#include <set>
#include <utility>

namespace isorelax::model {
namespace {

/// Makes two changes of a kind one; false where they are not of this kind.
template <typename Change>
bool merge(UndoEntry& into, UndoEntry& from) {
  auto* last = std::get_if<Change>(&into.change);
  auto* next = std::get_if<Change>(&from.change);
  if (last == nullptr || next == nullptr) return false;
  last->after = std::move(next->after);
  return true;
}

}  // namespace

void UndoList::push(UndoEntry entry) {
  entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(position_), entries_.end());
  const bool may_merge = merging_ && !entries_.empty() && entries_.back().label == entry.label;
  if (may_merge &&
      (merge<SettingsChange>(entries_.back(), entry) || merge<MotionChange>(entries_.back(), entry)))
    return;
  merging_ = std::holds_alternative<SettingsChange>(entry.change) ||
             std::holds_alternative<MotionChange>(entry.change);
  entries_.push_back(std::move(entry));
  position_ = entries_.size();
  forget_oldest();
}

void UndoList::undone() {
  --position_;
  merging_ = false;
}

void UndoList::redone() {
  ++position_;
  merging_ = false;
}

void UndoList::clear() {
  entries_.clear();
  position_ = 0;
  merging_ = false;
}

// Neighbouring entries share states, so each state counts once.
void UndoList::forget_oldest() {
  std::set<const Geometry*> seen;
  std::size_t bytes = 0;
  std::size_t keep = 0;
  for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry, ++keep) {
    if (const auto* change = std::get_if<PositionsChange>(&entry->change)) {
      for (const MeshStatePtr& state : {change->before, change->after})
        if (seen.insert(state->geometry.get()).second) bytes += state->bytes();
      bytes += sizeof(IterationRow) * (change->rows_before.size() + change->rows_after.size());
    }
    if (bytes > budget_ && keep > 0) break;
  }
  const std::size_t drop = entries_.size() - keep;
  entries_.erase(entries_.begin(), entries_.begin() + static_cast<std::ptrdiff_t>(drop));
  position_ -= drop;
}

}  // namespace isorelax::model
