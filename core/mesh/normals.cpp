#include "mesh/normals.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace isorelax {
namespace {

constexpr const char* kNormal = "normal";

class Refresher {
 public:
  Refresher(TriangleMesh& mesh, std::span<const Vec3> before) : mesh_(mesh), before_(before) {
    changed_.assign(mesh.positions.size(), 0);
    for (const Triangle& t : mesh.triangles) {
      const bool moved =
          std::any_of(t.begin(), t.end(), [&](Index v) { return mesh_.positions[v] != before_[v]; });
      if (!moved) continue;
      for (const Index v : t) changed_[v] = 1;
    }
  }

  std::size_t vertices(Attribute& attribute) const {
    std::vector<Vec3> was(mesh_.positions.size(), Vec3::Zero()), is = was;
    for (Corner c = 0; c < 3 * mesh_.triangles.size(); ++c) {
      const Index v = vertex(c);
      if (changed_[v] == 0) continue;
      was[v] += share(before_, c);
      is[v] += share(mesh_.positions, c);
    }
    std::size_t count = 0;
    for (Index v = 0; v < mesh_.positions.size(); ++v)
      if (changed_[v] != 0) count += store(was[v], is[v], &attribute.values[3 * std::size_t{v}]) ? 1 : 0;
    return count;
  }

  /// A normal may be shared by vertices that part now: every vertex gets its own.
  std::size_t corners(CornerAttribute& attribute) const {
    struct Shared {
      Vec3 was = Vec3::Zero(), is = Vec3::Zero();
      std::vector<Corner> corners;
    };
    std::map<std::pair<Index, Index>, Shared> groups;  // by vertex and old normal
    for (Corner c = 0; c < 3 * mesh_.triangles.size(); ++c) {
      if (changed_[vertex(c)] == 0 || attribute.indices[c] == kNone) continue;
      Shared& group = groups[{vertex(c), attribute.indices[c]}];
      group.was += share(before_, c);
      group.is += share(mesh_.positions, c);
      group.corners.push_back(c);
    }
    std::size_t count = 0;
    for (const auto& [key, group] : groups) {
      std::array<double, 3> normal{};
      std::copy_n(attribute.values.begin() + 3 * std::ptrdiff_t{key.second}, 3, normal.begin());
      if (!store(group.was, group.is, normal.data())) continue;
      ++count;
      const auto index = static_cast<Index>(attribute.values.size() / 3);
      attribute.values.insert(attribute.values.end(), normal.begin(), normal.end());
      for (const Corner c : group.corners) attribute.indices[c] = index;
    }
    if (count > 0) drop_unused(attribute);
    return count;
  }

 private:
  [[nodiscard]] Index vertex(Corner c) const { return mesh_.triangles[c / 3][c % 3]; }

  /// Unit normal of a corner's triangle times the angle there.
  [[nodiscard]] Vec3 share(std::span<const Vec3> x, Corner c) const {
    const Triangle& t = mesh_.triangles[c / 3];
    const Vec3 a = x[t[next(c % 3)]] - x[t[c % 3]];
    const Vec3 b = x[t[previous(c % 3)]] - x[t[c % 3]];
    const Vec3 normal = a.cross(b);
    const double length = normal.stableNorm();
    return length > 0 ? Vec3(normal * (std::atan2(length, a.dot(b)) / length)) : Vec3(Vec3::Zero());
  }

  static bool store(const Vec3& was, const Vec3& is, double* normal) {
    const Eigen::Map<const Vec3> stored(normal);
    const double length = is.norm();
    if (!(length > 0)) return false;
    const Vec3 fresh = is * ((stored.dot(was) < 0 ? -1 : 1) / length);
    std::copy_n(fresh.data(), 3, normal);
    return true;
  }

  /// Normals that no corner names any more go; the order of the others stays.
  static void drop_unused(CornerAttribute& attribute) {
    std::vector<Index> number(attribute.values.size() / 3, kNone);
    for (const Index i : attribute.indices)
      if (i != kNone) number[i] = 0;
    std::vector<double> kept;
    for (Index i = 0; i < number.size(); ++i) {
      if (number[i] == kNone) continue;
      number[i] = static_cast<Index>(kept.size() / 3);
      kept.insert(kept.end(), attribute.values.begin() + 3 * std::ptrdiff_t{i},
                  attribute.values.begin() + 3 * std::ptrdiff_t{i} + 3);
    }
    for (Index& i : attribute.indices)
      if (i != kNone) i = number[i];
    attribute.values = std::move(kept);
  }

  TriangleMesh& mesh_;
  std::span<const Vec3> before_;
  std::vector<std::uint8_t> changed_;
};

}  // namespace

std::size_t refresh_normals(TriangleMesh& mesh, std::span<const Vec3> before) {
  const Refresher refresher(mesh, before);
  std::size_t count = 0;
  for (Attribute& attribute : mesh.attributes.vertex)
    if (attribute.name == kNormal && attribute.width == 3) count += refresher.vertices(attribute);
  for (CornerAttribute& attribute : mesh.attributes.corner)
    if (attribute.name == kNormal && attribute.width == 3) count += refresher.corners(attribute);
  return count;
}

}  // namespace isorelax
