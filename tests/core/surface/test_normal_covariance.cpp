#include "surface/normal_covariance.h"

#include <gtest/gtest.h>

#include <random>

namespace isorelax {
namespace {

SymmetricMatrix sum_of(std::initializer_list<Vec3> normals) {
  SymmetricMatrix m;
  for (const Vec3& n : normals) m.add_outer(n.x(), n.y(), n.z());
  return m;
}

Vec3 dominant_eigenvector(const SymmetricMatrix& covariance) {
  CovarianceBatch batch{};
  batch.set(0, covariance);
  return dominant_eigenvectors(batch)[0];
}

TEST(DominantEigenvector, OfAPlaneIsExactlyItsNormal) {
  const Vec3 n = dominant_eigenvector(sum_of({{0, 0, 0.3}, {0, 0, 1.7}}));
  EXPECT_EQ(n.cwiseAbs(), Vec3(0, 0, 1));
}

TEST(DominantEigenvector, AgreesWithTheFullDecomposition) {
  std::mt19937_64 engine(static_cast<std::uint64_t>(::testing::UnitTest::GetInstance()->random_seed()));
  std::uniform_real_distribution<double> u(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    SymmetricMatrix m;
    for (int k = 0; k < 6; ++k) m.add_outer(2 + u(engine), u(engine), u(engine));
    const Vec3 fast = dominant_eigenvector(m);
    const Vec3 full = decompose(m).vectors.col(0);
    EXPECT_NEAR(std::abs(fast.dot(full)), 1, 1e-12);
    EXPECT_NEAR(fast.norm(), 1, 1e-14);
  }
}

TEST(DominantEigenvector, WithoutASingleDominantDirectionIsStillAnEigenvector) {
  const SymmetricMatrix m = sum_of({{1, 0, 0}, {0, 1, 0}, {0, 0, 0.5}});
  const Vec3 v = dominant_eigenvector(m);
  EXPECT_NEAR((m.to_matrix() * v - v).norm(), 0, 1e-12);
}

TEST(DominantEigenvector, OfZeroIsZero) {
  EXPECT_EQ(dominant_eigenvector({}), Vec3(0, 0, 0));
}

TEST(NormalCovariance, OfARightAngledCreaseHasTheAreasAsEigenvalues) {
  const std::vector<Vec3> x = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, -2}};
  const std::vector<Triangle> triangles = {{0, 1, 2}, {1, 0, 3}};
  const Topology topology(triangles, 4);
  const CovarianceEigen e = decompose(normal_covariance(x, triangles, topology, 0));
  EXPECT_NEAR(e.values[0], 2, 1e-14);
  EXPECT_NEAR(e.values[1], 1, 1e-14);
  EXPECT_NEAR(e.values[2], 0, 1e-14);
  EXPECT_NEAR(std::abs(e.vectors.col(2).x()), 1, 1e-14);  // along the crease
}

}  // namespace
}  // namespace isorelax
