#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "motion/expression_field.h"
#include "motion/motion_spec.h"
#include "motion/sampled_field.h"

namespace isorelax {
namespace {

double divergence(const VelocityField& field, const Vec3& x, double t) {
  constexpr double kStep = 1e-5;
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 d = kStep * Vec3::Unit(i);
    sum += (field.at(x + d, t)[i] - field.at(x - d, t)[i]) / (2 * kStep);
  }
  return sum;
}

TEST(Fields, ThePapersIsItsFormulaAndReversesAtHalfItsPeriod) {
  const Motion motion = parse_motion("paper:3");
  const Vec3 x(0.3, 0.7, 0.2);
  const double pi = std::numbers::pi;
  const auto s2 = [&](double a) { return std::sin(pi * a) * std::sin(pi * a); };
  const auto s = [&](double a) { return std::sin(2 * pi * a); };
  const Vec3 expected =
      std::cos(pi * 0.5 / 3) *
      Vec3(s2(0.3) * (s(0.2) - s(0.7)), s2(0.7) * (s(0.3) - s(0.2)), s2(0.2) * (s(0.7) - s(0.3)));
  EXPECT_LT((motion.field->at(x, 0.5) - expected).norm(), 1e-15);
  EXPECT_LT((motion.field->at(x, 3 - 0.5) + expected).norm(), 1e-15);
  EXPECT_EQ(motion.period, 3);
}

TEST(Fields, ThoseThatKeepVolumesHaveNoDivergence) {
  for (const char* text : {"paper", "enright", "rigid:1,2,3@0.1,0,0+1,1,1", "shear:2"}) {
    const Motion motion = parse_motion(text);
    EXPECT_TRUE(motion.keeps_volume) << text;
    EXPECT_NEAR(divergence(*motion.field, {0.3, 0.6, 0.8}, 0.4), 0, 1e-8) << text;
  }
}

TEST(Fields, RigidMotionReadsItsThreeVectors) {
  const Motion motion = parse_motion("rigid:0,0,2@1,0,0+0,0,1e+1");
  EXPECT_LT((motion.field->at({2, 0, 0}, 0) - Vec3(0, 2, 10)).norm(), 1e-15);
}

TEST(Fields, WhereRigidAndShearMotionLeadIsWhereTheirFieldsDo) {
  for (const char* text : {"rigid:1,2,3@0.1,0,0.4+1,-1,0.5", "rigid:0,0,0+1,2,3", "shear:2"}) {
    const Motion motion = parse_motion(text);
    const Vec3 start(0.3, 0.6, 0.8);
    EXPECT_LT((motion.place(motion.place(start, 0.7), -0.7) - start).norm(), 1e-14) << text;
    constexpr double kStep = 1e-5;
    const Vec3 slope = (motion.place(start, 0.7 + kStep) - motion.place(start, 0.7 - kStep)) / (2 * kStep);
    EXPECT_LT((motion.field->at(motion.place(start, 0.7), 0) - slope).norm(), 1e-8) << text;
  }
}

TEST(Fields, ExpressionsKnowCoordinatesAndTime) {
  const Motion motion = parse_motion("expr:-y*t;sin(pi*x);z^2");
  EXPECT_LT((motion.field->at({0.5, 2, 3}, 4) - Vec3(-8, 1, 9)).norm(), 1e-14);
}

TEST(Fields, AMistakeInAnExpressionIsToldWithItsColumn) {
  for (const auto& [text, column] : {std::pair("x+", 3), std::pair("(z", 3), std::pair("y+1e", 3),
                                     std::pair("sin()", 5), std::pair("z=3", 2), std::pair("x==1+y=2", 7)}) {
    try {
      const Expression expression(text);
      FAIL() << text << " was accepted";
    } catch (const ExpressionError& error) {
      EXPECT_EQ(error.column(), column) << error.what();
      EXPECT_EQ(error.reason().find("position"), std::string::npos) << error.what();
    }
  }
  EXPECT_NO_THROW((void)parse_motion("expr:x==y;x<=y;x!=y"));
  EXPECT_THROW((void)parse_motion("expr:1;2"), UsageError);
  EXPECT_THROW((void)parse_motion("expr:1;2;w"), UsageError);
  EXPECT_THROW((void)parse_motion("swirl"), UsageError);
  EXPECT_THROW((void)parse_motion("paper:-1"), UsageError);
  for (const char* text : {"paper:", "enright:", "shear:", "normal:"})
    EXPECT_THROW((void)parse_motion(text), UsageError) << text;
}

TEST(Fields, ASampledLinearFieldIsFoundAgainExactly) {
  const std::string path = testing::TempDir() + "isorelax_linear.vtk";
  {
    std::ofstream file(path);
    file << "# vtk DataFile Version 3.0\nlinear\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 3 2 2\nORIGIN "
            "0 0 0\n"
            "SPACING 1 2 4\nPOINT_DATA 12\nVECTORS u double\n";
    for (int k = 0; k < 2; ++k)
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 3; ++i) file << i << ' ' << 2 * j - i << ' ' << 4 * k + 1 << '\n';
  }
  const auto field = read_sampled_field(path);
  EXPECT_LT((field->at({1.25, 0.5, 3}, 7) - Vec3(1.25, -0.75, 4)).norm(), 1e-14);
  EXPECT_LT((field->at({2, 2, 4}, 0) - Vec3(2, 0, 5)).norm(), 1e-14);
  EXPECT_THROW((void)field->at({2.1, 0, 0}, 0), Error);
}

TEST(Fields, ASampledFileThatClaimsMoreThanItHoldsIsRefused) {
  const std::string path = testing::TempDir() + "isorelax_lying.vtk";
  std::ofstream(path) << "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\n"
                         "DIMENSIONS 1000000 1000000 1000\nORIGIN 0 0 0\nSPACING 1 1 1\n";
  try {
    (void)read_sampled_field(path);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(": line 5: DIMENSIONS"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace isorelax
