#include "surface/feature_curves.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "mesh/angle.h"

namespace isorelax {
namespace {

constexpr std::size_t kSamplesAhead = 3;
constexpr std::size_t kSamplesAheadOfAnEnd = 5;
/// Radians; what turns by less than this in a vertex is straight there.
constexpr double kStraight = 5e-5;
/// The mean turn of creases that are drawn finely.
constexpr double kFine = 5 / kDegrees;
/// The lift of an arc over its chord is a quarter of the turn at its ends times half the chord; noise may not
/// make more of it than this.
constexpr double kLargestCurveLift = 0.4;
constexpr int kCurveCorrections = 2;

}  // namespace

CurveFit::CurveFit(const Vec3& origin, const Vec3& unit_tangent, std::span<const Vec3> samples)
    : origin_(origin), tangent_(unit_tangent) {
  constexpr int kRows = 2 * kSamplesAhead;
  const auto rows = static_cast<Eigen::Index>(std::min<std::size_t>(samples.size(), kRows));
  if (rows < 2) return;
  const int degree = std::clamp(static_cast<int>(rows) - 1, 2, kMaxDegree);
  double radius = 0;
  for (const Vec3& s : samples) radius = std::max(radius, std::abs((s - origin).dot(tangent_)));
  if (!(radius > 0)) return;
  scale_ = 1 / radius;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kRows, kMaxDegree> a(rows, degree);
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kRows, 3> across(rows, 3);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Vec3 d = samples[i] - origin;
    const double along = d.dot(tangent_), s = along * scale_;
    const double weight = 1 / (s * s + 0.01);
    double power = weight;
    for (int k = 0; k < degree; ++k) a(i, k) = (power *= s);
    across.row(i) = weight * (d - along * tangent_).transpose();
  }
  const Eigen::ColPivHouseholderQR<decltype(a)> qr(a);
  if (qr.rank() < degree) return;
  const Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kMaxDegree, 3> solution = qr.solve(across);
  for (int k = 0; k < degree; ++k) coefficients_[k] = solution.row(k).transpose();
  degree_ = degree;
}

Vec3 CurveFit::lift(const Vec3& point) const {
  if (degree_ == 0) return point;
  const double along = (point - origin_).dot(tangent_), s = along * scale_;
  Vec3 across = Vec3::Zero();
  for (int k = degree_ - 1; k >= 0; --k) across = (across + coefficients_[k]) * s;
  return origin_ + along * tangent_ + across;
}

Vec3 CurveFit::direction(const Vec3& point) const {
  const double s = (point - origin_).dot(tangent_) * scale_;
  Vec3 slope = Vec3::Zero();
  for (int k = degree_ - 1; k >= 0; --k) slope = slope * s + (k + 1) * coefficients_[k];
  return tangent_ + scale_ * slope;
}

FeatureCurves::FeatureCurves(std::span<const Vec3> positions, std::span<const Edge> edges,
                             std::span<const std::uint8_t> is_corner, std::size_t creases)
    : x_(positions.begin(), positions.end()), edge_of_(positions.size(), kNone) {
  link(edges, is_corner);
  for (Index p = are_fine(creases) ? static_cast<Index>(creases) : 0; p < pieces_.size(); ++p) {
    double turns = 0, straightest = kStraight;
    for (const unsigned end : {0U, 1U}) {
      if (pieces_[p].neighbour[end] == kNone) continue;
      turns = std::max(turns, turn(p, end));
      straightest = std::min(straightest, turn(p, end));
    }
    const double length = (x_[pieces_[p].vertices[1]] - x_[pieces_[p].vertices[0]]).norm();
    if (straightest == kStraight) pieces_[p].largest_lift = kLargestCurveLift * std::min(turns, 1.0) * length;
  }
  for (Index p = 0; p < pieces_.size(); ++p)
    if (pieces_[p].largest_lift > 0)
      for (const unsigned end : {0U, 1U}) fit(p, end);
}

bool FeatureCurves::are_fine(std::size_t creases) const {
  double sum = 0;
  std::size_t count = 0;
  for (Index p = 0; p < creases; ++p) {
    for (const unsigned end : {0U, 1U}) {
      if (pieces_[p].neighbour[end] == kNone || !(turn(p, end) > kStraight)) continue;
      sum += turn(p, end);
      ++count;
    }
  }
  return sum < kFine * static_cast<double>(count);
}

void FeatureCurves::link(std::span<const Edge> edges, std::span<const std::uint8_t> is_corner) {
  pieces_.resize(edges.size());
  std::vector<std::uint8_t> met(x_.size(), 0);
  for (const Edge& e : edges)
    for (const Index v : e) met[v] = static_cast<std::uint8_t>(std::min(met[v] + 1, 3));
  for (Index p = 0; p < edges.size(); ++p) {
    pieces_[p].vertices = edges[p];
    for (const unsigned end : {0U, 1U}) {
      const Index v = edges[p][end];
      const Index first = edge_of_[v];
      if (first == kNone) {
        edge_of_[v] = p;
      } else if (met[v] == 2 && is_corner[v] == 0) {
        pieces_[p].neighbour[end] = first;
        pieces_[first].neighbour[pieces_[first].vertices[0] == v ? 0 : 1] = p;
      }
    }
  }
  // Where several pieces meet the longest one speaks for the vertex, whatever their order.
  const auto length2 = [&](Index p) {
    return (x_[pieces_[p].vertices[1]] - x_[pieces_[p].vertices[0]]).squaredNorm();
  };
  for (Index p = 0; p < pieces_.size(); ++p) {
    for (const Index v : pieces_[p].vertices)
      if (length2(p) > length2(edge_of_[v])) edge_of_[v] = p;
  }
}

/// From the first vertex to the second.
Vec3 FeatureCurves::direction(Index piece) const {
  return x_[pieces_[piece].vertices[1]] - x_[pieces_[piece].vertices[0]];
}

/// How much the chain turns at an end of a piece that has a neighbour there, radians.
double FeatureCurves::turn(Index piece, unsigned end) const {
  const Index other = pieces_[piece].neighbour[end];
  const Index v = pieces_[piece].vertices[end];
  const bool runs_on = pieces_[other].vertices[end] != v;  // the neighbour is directed as this piece is
  return angle_between(direction(piece), runs_on ? direction(other) : Vec3(-direction(other)));
}

/// Fits do not mix straight pieces and curved ones: a line runs into an arc where the curvature jumps.
bool FeatureCurves::continues(Index piece, unsigned end) const {
  const Index other = pieces_[piece].neighbour[end];
  return other != kNone && pieces_[other].largest_lift > 0;
}

/// Unit tangent at an end of a piece, into the piece: that of the parabola through the vertex and its
/// neighbours on the chain.
Vec3 FeatureCurves::tangent(Index piece, unsigned end) const {
  const Index v = pieces_[piece].vertices[end];
  const Vec3 ahead = x_[pieces_[piece].vertices[1 - end]] - x_[v];
  if (!continues(piece, end)) return ahead.normalized();
  const Edge& e = pieces_[pieces_[piece].neighbour[end]].vertices;
  const Vec3 behind = x_[v] - x_[e[0] == v ? e[1] : e[0]];
  return (ahead / ahead.squaredNorm() + behind / behind.squaredNorm()).normalized();
}

/// Appends up to `count` vertices of the chain from an end of the piece through the piece, as long as the
/// chain runs along the tangent.
void FeatureCurves::gather(Index piece, unsigned end, std::size_t count, const Vec3& tangent,
                           std::vector<Vec3>& to) const {
  for (std::size_t i = 0; i < count; ++i) {
    const Index from = pieces_[piece].vertices[end], v = pieces_[piece].vertices[1 - end];
    const Vec3 step = x_[v] - x_[from];
    if (!(step.dot(tangent) > 0.5 * step.norm())) return;
    to.push_back(x_[v]);
    if (!continues(piece, 1 - end)) return;
    piece = pieces_[piece].neighbour[1 - end];
    end = pieces_[piece].vertices[0] == v ? 0 : 1;
  }
}

void FeatureCurves::fit(Index piece, unsigned end) {
  const Index v = pieces_[piece].vertices[end];
  const Vec3 along = tangent(piece, end);
  const bool through = continues(piece, end);
  std::vector<Vec3> samples;
  gather(piece, end, through ? kSamplesAhead : kSamplesAheadOfAnEnd, along, samples);
  if (through) {
    const Index other = pieces_[piece].neighbour[end];
    gather(other, pieces_[other].vertices[0] == v ? 0 : 1, kSamplesAhead, -along, samples);
  }
  pieces_[piece].fits[end] = CurveFit(x_[v], along, samples);
}

FeatureCurves::Foot FeatureCurves::foot(const Vec3& point, Index piece) const {
  const Vec3& a = x_[pieces_[piece].vertices[0]];
  const Vec3& b = x_[pieces_[piece].vertices[1]];
  const Vec3 along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp(along.dot(point - a) / length2, 0.0, 1.0) : 0.0;
  const Vec3 q = t == 1 ? b : Vec3(a + t * along);
  return {piece, t, q, (point - q).squaredNorm()};
}

FeatureCurves::Foot FeatureCurves::walk(const Vec3& point, Index piece) const {
  Foot best = foot(point, piece);
  while (best.t == 0 || best.t == 1) {
    const Index neighbour = pieces_[best.piece].neighbour[best.t == 0 ? 0 : 1];
    if (neighbour == kNone) break;
    const Foot further = foot(point, neighbour);
    if (!(further.squared < best.squared)) break;
    best = further;
  }
  return best;
}

Vec3 FeatureCurves::lift(const Foot& foot) const {
  const Piece& piece = pieces_[foot.piece];
  if (!(piece.largest_lift > 0) || foot.t == 0 || foot.t == 1) return foot.point;
  const Vec3 lifted = (1 - foot.t) * piece.fits[0].lift(foot.point) + foot.t * piece.fits[1].lift(foot.point);
  const Vec3 offset = lifted - foot.point;
  const double length = offset.norm();
  return length > piece.largest_lift ? Vec3(foot.point + offset * (piece.largest_lift / length)) : lifted;
}

/// The place on the chain whose lift is the curve's point nearest to `point`.
FeatureCurves::Foot FeatureCurves::settle(const Vec3& point, Index edge) const {
  Foot at = walk(point, edge);
  Vec3 lifted = lift(at);
  // The lift moves a little along the chain as well: take that back.
  for (int i = 0; i < kCurveCorrections && lifted != at.point; ++i) {
    const Vec3 along = direction(at.piece);
    const Vec3 back = along * (along.dot(point - lifted) / along.squaredNorm());
    at = walk(at.point + back, at.piece);
    lifted = lift(at);
  }
  return at;
}

CurvePoint FeatureCurves::project(const Vec3& point, Index edge) const {
  const Foot at = settle(point, edge);
  return {at.piece, lift(at)};
}

Vec3 FeatureCurves::direction_at(const Vec3& point, Index edge) const {
  const Foot at = settle(point, edge);
  Vec3 along = direction(at.piece).normalized();
  const Piece& piece = pieces_[at.piece];
  if (!(piece.largest_lift > 0)) return along;
  Vec3 sum = Vec3::Zero();
  for (const unsigned end : {0U, 1U}) {
    const Vec3 part = piece.fits[end].direction(at.point).normalized();
    sum += (end == 0 ? 1 - at.t : at.t) * (part.dot(along) < 0 ? Vec3(-part) : part);
  }
  return sum.normalized();
}

}  // namespace isorelax
