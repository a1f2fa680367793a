#include <gtest/gtest.h>

#include "ui/plot.h"
#include "ui/shortcuts.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

TEST(RoundTicks, AreOneTwoOrFiveTimesAPowerOfTenInsideTheRange) {
  EXPECT_EQ(round_ticks(0, 100, 4), (std::vector<double>{0, 50, 100}));
  EXPECT_EQ(round_ticks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_TRUE(round_ticks(1, 1, 4).empty());
  for (const double t : round_ticks(-3.7, 12.2, 6)) {
    EXPECT_GE(t, -3.7);
    EXPECT_LE(t, 12.2);
  }
}

TEST(CountText, GroupsDigitsByThree) {
  EXPECT_EQ(count_text(7), "7");
  EXPECT_EQ(count_text(1234567),
            "1\xE2\x80\x89"
            "234\xE2\x80\x89"
            "567");
}

TEST(Shortcuts, NoTwoShareAKey) {
  const auto all = shortcuts();
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = a + 1; b < all.size(); ++b)
      EXPECT_FALSE(all[a].key == all[b].key && all[a].modifiers == all[b].modifiers) << all[a].keys;
}

}  // namespace
}  // namespace isorelax::ui
