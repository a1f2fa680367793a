#include <gtest/gtest.h>

#include "model/undo.h"

namespace isorelax::model {
namespace {

MeshStatePtr state_of(std::size_t vertices) {
  auto geometry = std::make_shared<Geometry>();
  geometry->positions.resize(vertices, Vec3::Zero());
  auto state = std::make_shared<MeshState>();
  state->geometry = std::move(geometry);
  return state;
}

TEST(UndoList, ForgetsTheOldestWhenItsMemoryIsFull) {
  UndoList list(10 * 1000 * sizeof(Vec3));
  MeshStatePtr last = state_of(1000);
  for (int k = 0; k < 50; ++k) {
    const MeshStatePtr next = state_of(1000);
    list.push({"step", PositionsChange{last, next, {}, {}}});
    last = next;
  }
  EXPECT_EQ(list.size(), 9U) << "nine changes between ten states";
  ASSERT_NE(list.next_undo(), nullptr);
  EXPECT_EQ(std::get<PositionsChange>(list.next_undo()->change).after, last);
}

TEST(UndoList, KeepsTheNewestEvenWhenItIsTooLarge) {
  UndoList list(1);
  list.push({"run", PositionsChange{state_of(100), state_of(100), {}, {}}});
  EXPECT_EQ(list.size(), 1U);
}

TEST(UndoList, ANewEntryDropsWhatCouldBeRedone) {
  UndoList list;
  list.push({"a", SettingsChange{}});
  list.stop_merging();
  list.push({"b", SettingsChange{}});
  list.undone();
  list.push({"c", SettingsChange{}});
  EXPECT_EQ(list.next_redo(), nullptr);
  EXPECT_EQ(list.size(), 2U);
  EXPECT_EQ(list.next_undo()->label, "c");
}

}  // namespace
}  // namespace isorelax::model
