#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <variant>
#include <vector>

#include "model/event.h"
#include "model/timeline.h"

namespace isorelax::model {

/// A change of smoothing settings.
struct SettingsChange {
  SmoothingSettings before, after;
};
/// A change of positions by a step, a run or a reset, with the rows of the plots.
struct PositionsChange {
  MeshStatePtr before, after;
  std::vector<IterationRow> rows_before, rows_after;
  Cursor cursor_before{}, cursor_after{};
};

/// A change of what moves a surface.
struct MotionChange {
  MotionChoices before, after;
};

/// Runs that came to the timeline together, or one that was removed from it.
struct RunsChange {
  struct Run {
    unsigned at = 0;               ///< its place on the timeline
    Branch branch{};               ///< empty while it is there
    std::vector<unsigned> left{};  ///< those that left it where it began, by their places without it
  };
  /// What is shown of them.
  struct View {
    Cursor cursor;
    std::vector<unsigned> beside;
    SmoothingSettings settings;
    Task task = Task::smooth;
  };
  std::vector<Run> runs;  ///< ascending
  bool came = true;       ///< else they went
  View before, after;
};

struct UndoEntry {
  std::string label;  ///< "20 iterations", "Reset", "mu_A": what Undo takes back
  std::variant<SettingsChange, PositionsChange, MotionChange, RunsChange> change;
};

/// What can be undone and redone, in the order in which it was done. Settings and positions are entries of
/// their own: undoing one never touches the other. Keeps as much as fits in its memory budget and forgets the
/// oldest first.
class UndoList {
 public:
  static constexpr std::size_t kDefaultBudget = std::size_t{1} << 30U;  // bytes

  explicit UndoList(std::size_t budget = kDefaultBudget) : budget_(budget) {}

  /// Adds an entry and drops what could be redone. A settings change with the label of the newest entry is
  /// merged into it until `stop_merging()`, so that dragging a slider is one entry.
  void push(UndoEntry entry);
  /// The next settings change begins an entry of its own.
  void stop_merging() { merging_ = false; }

  /// The entry that Undo takes back; null when there is none.
  [[nodiscard]] const UndoEntry* next_undo() const {
    return position_ > 0 ? &entries_[position_ - 1] : nullptr;
  }
  [[nodiscard]] const UndoEntry* next_redo() const {
    return position_ < entries_.size() ? &entries_[position_] : nullptr;
  }
  /// The same to be changed: runs change places with their entry.
  [[nodiscard]] UndoEntry* next_undo() { return position_ > 0 ? &entries_[position_ - 1] : nullptr; }
  [[nodiscard]] UndoEntry* next_redo() {
    return position_ < entries_.size() ? &entries_[position_] : nullptr;
  }
  /// Moves over next_undo() or next_redo(). Precondition: there is one.
  void undone();
  void redone();
  void clear();
  [[nodiscard]] std::size_t size() const { return entries_.size(); }

 private:
  void forget_oldest();

  std::deque<UndoEntry> entries_;
  std::size_t position_ = 0;
  std::size_t budget_;
  bool merging_ = false;
};

}  // namespace isorelax::model
