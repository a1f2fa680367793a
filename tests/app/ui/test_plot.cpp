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

TEST(TickLabels, TellTicksApart) {
  EXPECT_EQ(tick_labels(std::vector<double>{0, 50, 100}), (std::vector<std::string>{"0", "50", "100"}));
  for (const std::vector<double>& ticks :
       {std::vector<double>{131900, 132000, 132100}, {7e6, 7.002e6, 7.004e6}, {1e-5, 1.5e-5, 2e-5}}) {
    const auto labels = tick_labels(ticks);
    for (std::size_t k = 1; k < labels.size(); ++k) EXPECT_NE(labels[k], labels[k - 1]);
  }
}

TEST(FitRange, HasRoomForAllLines) {
  LinePlot plot;
  plot.lines = {{.points = {{0, 100}, {1, 90}}, .new_start = {true, false}},
                {.points = {{0, 100}, {1, 300}}, .new_start = {true, false}}};
  fit_range(plot);
  EXPECT_LT(plot.low, 90);
  EXPECT_GT(plot.high, 300);
  EXPECT_EQ(plot.scale, PlotScale::linear);
  plot.lines.push_back({.points = {{0, 1e5}}, .new_start = {true}});
  fit_range(plot);
  EXPECT_GT(plot.high, 1e5);
  EXPECT_EQ(plot.scale, PlotScale::logarithmic);
}

TEST(CountText, GroupsDigitsByThree) {
  EXPECT_EQ(count_text(7), "7");
  EXPECT_EQ(count_text(1234567),
            "1\xE2\x80\x89"
            "234\xE2\x80\x89"
            "567");
}

TEST(NumberText, AZeroHasNoSign) {
  EXPECT_EQ(number_text("%.4f", -1e-6), "0.0000");
  EXPECT_EQ(number_text("%.4f", -1e-3), "-0.0010");
  EXPECT_EQ(number_text("%.3g", -1e-6), "-1e-06");
  EXPECT_EQ(counted(1, "triangle", "triangles"), "1 triangle");
  EXPECT_EQ(counted(1000, "triangle", "triangles"), count_text(1000) + " triangles");
}

TEST(Shortcuts, NoTwoShareAKey) {
  const auto all = shortcuts();
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = a + 1; b < all.size(); ++b)
      EXPECT_FALSE(all[a].key == all[b].key && all[a].modifiers == all[b].modifiers) << all[a].keys;
}

}  // namespace
}  // namespace isorelax::ui
