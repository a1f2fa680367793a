#include <algorithm>
#include <cmath>
#include <queue>

#include "io/polygon_soup.h"

namespace isorelax {
namespace {

using Vec2 = Eigen::Vector2d;
using Cut = std::array<std::uint32_t, 3>;

/// Twice the polygon's area as a vector; corners are taken relative to the first, so that a polygon far from
/// the origin keeps its digits.
Vec3 polygon_area_vector(std::span<const Vec3> corners) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    sum += area_vector(corners[0], corners[i], corners[i + 1]);
  }
  return sum;
}

bool cut_quadrilateral(std::span<const Vec3> q, std::vector<Cut>& out) {
  const Vec3 up = polygon_area_vector(q);
  const auto upright = [&](unsigned a, unsigned b, unsigned c) {
    return area_vector(q[a], q[b], q[c]).dot(up) > 0.0;
  };
  const bool even = upright(0, 1, 2) && upright(0, 2, 3);
  const bool odd = upright(0, 1, 3) && upright(1, 2, 3);
  const bool even_is_shorter = !((q[3] - q[1]).squaredNorm() < (q[2] - q[0]).squaredNorm());
  if (even == odd ? even_is_shorter : even) {
    out.insert(out.end(), {Cut{0, 1, 2}, Cut{0, 2, 3}});
  } else {
    out.insert(out.end(), {Cut{0, 1, 3}, Cut{1, 2, 3}});
  }
  return even || odd;
}

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return cross(b - a, c - a);
}

/// The corners in the plane across their area vector, scaled to a box of about unit size; the polygon runs
/// counter-clockwise there.
std::vector<Vec2> flattened(std::span<const Vec3> corners) {
  double size = 0.0;
  for (const Vec3& corner : corners) {
    size = std::max(size, corner.cwiseAbs().maxCoeff());
  }
  // Halves are taken first, so that coordinates near the largest double do not overflow.
  std::vector<Vec3> scaled;
  scaled.reserve(corners.size());
  double extent = 0.0;
  for (const Vec3& corner : corners) {
    scaled.push_back(size > 0.0 ? Vec3((corner / size) / 2.0 - (corners[0] / size) / 2.0) : Vec3::Zero());
    extent = std::max(extent, scaled.back().cwiseAbs().maxCoeff());
  }
  for (Vec3& corner : scaled) {
    corner /= extent > 0.0 ? extent : 1.0;
  }
  Vec3 up = polygon_area_vector(scaled);
  up = up.squaredNorm() > 0.0 ? Vec3(up.normalized()) : Vec3::UnitZ();
  Vec3::Index smallest = 0;
  up.cwiseAbs().minCoeff(&smallest);
  const Vec3 right = up.cross(Vec3::Unit(smallest)).normalized();
  const Vec3 forward = up.cross(right);
  std::vector<Vec2> flat;
  flat.reserve(scaled.size());
  for (const Vec3& corner : scaled) {
    flat.emplace_back(corner.dot(right), corner.dot(forward));
  }
  return flat;
}

/// Reflex corners in a square grid: a triangle asks only the cells that its box covers.
class ReflexGrid {
 public:
  ReflexGrid(const std::vector<Vec2>& points, const std::vector<std::uint32_t>& reflex) {
    low_ = high_ = points.front();
    for (const Vec2& point : points) {
      low_ = low_.cwiseMin(point);
      high_ = high_.cwiseMax(point);
    }
    side_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(reflex.size()))));
    cells_.resize(static_cast<std::size_t>(side_) * side_);
    for (const std::uint32_t corner : reflex) {
      cells_[cell(points[corner].x(), 0) + static_cast<std::size_t>(side_) * cell(points[corner].y(), 1)]
          .push_back(corner);
    }
  }

  /// Whether `hit` holds for any corner in the cells of the box; corners for which `gone` holds are dropped.
  template <class Hit, class Gone>
  bool any_in_box(const Vec2& low, const Vec2& high, Hit hit, Gone gone) {
    for (std::size_t y = cell(low.y(), 1); y <= cell(high.y(), 1); ++y) {
      for (std::size_t x = cell(low.x(), 0); x <= cell(high.x(), 0); ++x) {
        std::vector<std::uint32_t>& corners = cells_[x + static_cast<std::size_t>(side_) * y];
        std::erase_if(corners, gone);
        if (std::any_of(corners.begin(), corners.end(), hit)) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  [[nodiscard]] std::size_t cell(double value, int axis) const {
    const double width = high_[axis] - low_[axis];
    const double place = width > 0.0 ? (value - low_[axis]) / width * side_ : 0.0;
    return static_cast<std::size_t>(std::clamp(static_cast<int>(place), 0, side_ - 1));
  }

  Vec2 low_;
  Vec2 high_;
  int side_ = 1;
  std::vector<std::vector<std::uint32_t>> cells_;
};

/// Ear clipping with the best-shaped ear first.
class EarClipper {
 public:
  EarClipper(std::span<const Vec3> corners, std::vector<Cut>& out)
      : points_(flattened(corners)), out_(out), left_(corners.size()), grid_(points_, reflex_corners()) {
    const auto count = static_cast<std::uint32_t>(points_.size());
    before_.resize(count);
    after_.resize(count);
    version_.assign(count, 0);
    for (std::uint32_t i = 0; i < count; ++i) {
      before_[i] = i == 0 ? count - 1 : i - 1;
      after_[i] = i + 1 == count ? 0 : i + 1;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      offer(i);
    }
  }

  bool run() {
    std::vector<Candidate> blocked;
    bool clipped_since_retry = false;
    while (left_ > 3 && careful_) {
      if (queue_.empty()) {
        // Clipping opens ears that were blocked; when a whole round clipped nothing, nothing will.
        careful_ = clipped_since_retry;
        clipped_since_retry = false;
        std::for_each(blocked.begin(), blocked.end(), [&](const Candidate& c) { queue_.push(c); });
        blocked.clear();
        continue;
      }
      const Candidate candidate = queue_.top();
      queue_.pop();
      if (candidate.version != version_[candidate.corner]) {
        continue;
      }
      if (!is_free(candidate.corner)) {
        blocked.push_back(candidate);
        continue;
      }
      clip(candidate.corner);
      clipped_since_retry = true;
    }
    const bool clean = left_ == 3;
    clip_the_rest();
    return clean;
  }

 private:
  struct Candidate {
    double shape;
    std::uint32_t corner;
    std::uint32_t version;
    bool operator<(const Candidate& other) const {
      return shape != other.shape ? shape < other.shape : corner > other.corner;
    }
  };
  static constexpr std::uint32_t kClipped = 0xffffffffU;

  std::vector<std::uint32_t> reflex_corners() const {
    std::vector<std::uint32_t> reflex;
    const std::size_t count = points_.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (turn(points_[(i + count - 1) % count], points_[i], points_[(i + 1) % count]) <= 0.0) {
        reflex.push_back(static_cast<std::uint32_t>(i));
      }
    }
    return reflex;
  }

  [[nodiscard]] double turn_at(std::uint32_t i) const {
    return turn(points_[before_[i]], points_[i], points_[after_[i]]);
  }

  /// Area over the sum of squared sides: largest for an equilateral triangle, negative at a reflex corner.
  [[nodiscard]] double shape(std::uint32_t i) const {
    const Vec2& a = points_[before_[i]];
    const Vec2& b = points_[i];
    const Vec2& c = points_[after_[i]];
    const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    return sides > 0.0 ? turn(a, b, c) / sides : 0.0;
  }

  void offer(std::uint32_t i) {
    if (turn_at(i) > 0.0) {
      queue_.push({shape(i), i, version_[i]});
    }
  }

  bool is_free(std::uint32_t ear) {
    const Vec2& a = points_[before_[ear]];
    const Vec2& b = points_[ear];
    const Vec2& c = points_[after_[ear]];
    const auto inside = [&](std::uint32_t other) {
      const Vec2& p = points_[other];
      return other != ear && other != before_[ear] && other != after_[ear] && p != a && p != b && p != c &&
             turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
    };
    // A corner that became convex cannot stand inside an ear alone: a reflex one stands there with it.
    const auto gone = [&](std::uint32_t other) {
      return version_[other] == kClipped || turn_at(other) > 0.0;
    };
    return !grid_.any_in_box(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), inside, gone);
  }

  void clip(std::uint32_t ear) {
    const std::uint32_t left = before_[ear];
    const std::uint32_t right = after_[ear];
    out_.push_back({left, ear, right});
    after_[left] = right;
    before_[right] = left;
    version_[ear] = kClipped;
    --left_;
    last_ = left;
    for (const std::uint32_t neighbour : {left, right}) {
      ++version_[neighbour];
      offer(neighbour);
    }
  }

  /// Cuts what is left as a fan around its best corner: three corners always, more when no ear was free.
  void clip_the_rest() {
    std::uint32_t apex = last_;
    while (left_ > 3) {
      clip(after_[apex]);
    }
    out_.push_back({apex, after_[apex], after_[after_[apex]]});
  }

  std::vector<Vec2> points_;
  std::vector<Cut>& out_;
  std::size_t left_;
  ReflexGrid grid_;
  std::vector<std::uint32_t> before_;
  std::vector<std::uint32_t> after_;
  std::vector<std::uint32_t> version_;
  std::priority_queue<Candidate> queue_;
  std::uint32_t last_ = 0;
  bool careful_ = true;
};

}  // namespace

bool triangulate_polygon(std::span<const Vec3> corners, std::vector<Cut>& out) {
  if (corners.size() == 3) {
    out.push_back({0, 1, 2});
    return true;
  }
  if (corners.size() == 4) {
    return cut_quadrilateral(corners, out);
  }
  return EarClipper(corners, out).run();
}

}  // namespace isorelax
