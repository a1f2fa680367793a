#include "generate/shake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace isorelax {
namespace {

const double kSmallestTangent = std::tan(8 * std::numbers::pi / 180);
constexpr double kLargestTurnCosine = 0.5;
constexpr int kHalvings = 24;

/// Tangent of the smallest angle: twice the area over the product of the two longest edges' cosine part.
double smallest_tangent(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double twice_area = area_vector(a, b, c).norm();
  const double dot = std::max({(b - a).dot(c - a), (c - b).dot(a - b), (a - c).dot(b - c)});
  return dot > 0 ? twice_area / dot : 1;
}

class Shaker {
 public:
  Shaker(TriangleMesh& mesh, const PlaceVertex& place)
      : mesh_(mesh), place_(place), original_(mesh.positions), moves_(mesh.positions.size()) {}

  void run(double amount, Random& random) {
    for (auto& [s, t] : moves_) {
      const double radius = amount * std::sqrt(random.uniform());
      const double angle = random.uniform(0, 2 * std::numbers::pi);
      s = radius * std::cos(angle);
      t = radius * std::sin(angle);
    }
    for (Index v = 0; v < mesh_.vertex_count(); ++v) apply(v);
    for (int pass = 0; pass <= kHalvings; ++pass) {
      if (!cut_back(pass == kHalvings ? 0 : 0.5)) return;
    }
  }

 private:
  void apply(Index v) { mesh_.positions[v] = place_(v, moves_[v][0], moves_[v][1]); }

  bool cut_back(double factor) {
    std::vector<bool> cut(moves_.size(), false);
    bool any = false;
    for (const Triangle& t : mesh_.triangles) {
      if (is_sound(t)) continue;
      any = true;
      for (const Index v : t) cut[v] = true;
    }
    for (Index v = 0; v < moves_.size(); ++v) {
      if (!cut[v]) continue;
      moves_[v][0] *= factor;
      moves_[v][1] *= factor;
      apply(v);
    }
    return any;
  }

  [[nodiscard]] bool is_sound(const Triangle& t) const {
    const auto normal = [&](const std::vector<Vec3>& p) { return area_vector(p[t[0]], p[t[1]], p[t[2]]); };
    const auto tangent = [&](const std::vector<Vec3>& p) {
      return smallest_tangent(p[t[0]], p[t[1]], p[t[2]]);
    };
    const Vec3 before = normal(original_);
    const Vec3 after = normal(mesh_.positions);
    if (before.dot(after) < kLargestTurnCosine * before.norm() * after.norm()) return false;
    return tangent(mesh_.positions) >= std::min(kSmallestTangent, 0.5 * tangent(original_));
  }

  TriangleMesh& mesh_;
  const PlaceVertex& place_;
  const std::vector<Vec3> original_;
  std::vector<std::array<double, 2>> moves_;
};

}  // namespace

void shake(TriangleMesh& mesh, double amount, const PlaceVertex& place, Random& random) {
  if (amount > 0) Shaker(mesh, place).run(amount, random);
}

void shake(TriangleMesh& mesh, double amount, const std::vector<Freedom>& freedoms, Random& random) {
  const std::vector<Vec3> original = mesh.positions;
  shake(
      mesh, amount,
      [&](Index v, double s, double t) -> Vec3 {
        const Freedom& freedom = freedoms[v];
        Vec3 moved = original[v] + s * freedom.first + t * freedom.second;
        if (freedom.turn == 0) return moved;
        const double c = std::cos(s * freedom.turn);
        const double n = std::sin(s * freedom.turn);
        const Vec3 arm = moved - freedom.centre;
        return freedom.centre + Vec3(c * arm.x() - n * arm.y(), n * arm.x() + c * arm.y(), arm.z());
      },
      random);
}

}  // namespace isorelax
