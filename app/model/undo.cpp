#include "model/undo.h"

#include <set>

namespace isorelax::model {

void UndoList::push(UndoEntry entry) {
  entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(position_), entries_.end());
  auto* settings = std::get_if<SettingsChange>(&entry.change);
  if (settings != nullptr && merging_ && !entries_.empty() && entries_.back().label == entry.label) {
    if (auto* last = std::get_if<SettingsChange>(&entries_.back().change)) {
      last->after = settings->after;
      return;
    }
  }
  merging_ = settings != nullptr;
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
