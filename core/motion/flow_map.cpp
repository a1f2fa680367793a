#include "motion/flow_map.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "mesh/parallel.h"

namespace isorelax {
namespace {

constexpr int kCubicTerms = 9;
constexpr int kQuadraticTerms = 5;
constexpr int kLinearTerms = 2;

/// u, v, u^2, uv, v^2, u^3, u^2 v, u v^2, v^3.
std::array<double, kCubicTerms> monomials(double u, double v) {
  return {u, v, u * u, u * v, v * v, u * u * u, u * u * v, u * v * v, v * v * v};
}
std::array<double, kCubicTerms> monomials_by_u(double u, double v) {
  return {1, 0, 2 * u, v, 0, 3 * u * u, 2 * u * v, v * v, 0};
}
std::array<double, kCubicTerms> monomials_by_v(double u, double v) {
  return {0, 1, 0, u, 2 * v, 0, u * u, 2 * u * v, 3 * v * v};
}

int terms_for(std::size_t samples) {
  if (samples >= 12) return kCubicTerms;
  if (samples >= 7) return kQuadraticTerms;
  return samples >= 2 ? kLinearTerms : 0;
}

}  // namespace

FlowMap::FlowMap(const MaterialSurface& surface, const Topology& topology, const EdgeWalls& walls,
                 unsigned threads)
    : surface_(&surface),
      threads_(threads),
      sectors_(surface.triangles(), topology, walls),
      carrier_(surface.positions().begin(), surface.positions().end()) {
  fits_.resize(sectors_.count());
  std::vector<std::vector<Index>> samples(sectors_.count());
  std::vector<Eigen::MatrixXd> matrices(sectors_.count());
  parallel_for_blocks(sectors_.count(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) make_fit(static_cast<Index>(s), samples[s], matrices[s]);
  });
  for (std::size_t s = 0; s < fits_.size(); ++s) {
    fits_[s].first = static_cast<std::uint32_t>(samples_.size());
    fits_[s].count = static_cast<std::uint32_t>(samples[s].size());
    samples_.insert(samples_.end(), samples[s].begin(), samples[s].end());
    for (std::size_t j = 0; j < samples[s].size(); ++j) {
      std::array<double, kTerms> column{};
      for (int i = 0; i < matrices[s].rows(); ++i) column[i] = matrices[s](i, static_cast<Eigen::Index>(j));
      columns_.push_back(column);
    }
  }
  coefficients_.resize(fits_.size());
  set_carrier(carrier_);
}

void FlowMap::make_fit(Index sector, std::vector<Index>& samples, Eigen::MatrixXd& matrix) {
  const std::span<const Vec3> x = surface_->positions();
  const std::span<const Triangle> triangles = surface_->triangles();
  Fit& fit = fits_[sector];
  fit.vertex = sectors_.vertex(sector);
  Vec3 normal = Vec3::Zero();
  std::vector<Index> rings = {sector};  // sectors, ring by ring
  std::size_t begin = 0;
  for (int ring = 0; ring < 2 || (rings.size() <= 12 && ring < 4); ++ring) {
    const std::size_t end = rings.size();
    for (std::size_t i = begin; i < end; ++i) {
      for (const Corner corner : sectors_.corners(rings[i])) {
        const Corner first = corner - corner % 3;
        if (i == 0) {
          const Triangle& v = triangles[corner / 3];
          normal += area_vector(x[v[0]], x[v[1]], x[v[2]]);
        }
        for (Corner c = first; c < first + 3; ++c)
          if (std::ranges::find(rings, sectors_.of(c)) == rings.end()) rings.push_back(sectors_.of(c));
      }
    }
    begin = end;
  }
  if (!(normal.norm() > 0)) normal = Vec3::UnitZ();
  normal.normalize();
  fit.tangents[0] = normal.unitOrthogonal();
  fit.tangents[1] = normal.cross(fit.tangents[0]);
  double radius = 0;
  for (std::size_t i = 1; i < rings.size(); ++i)
    radius = std::max(radius, (x[sectors_.vertex(rings[i])] - x[fit.vertex]).norm());
  fit.scale = radius > 0 ? 1 / radius : 1;
  const int terms = terms_for(rings.size() - 1);
  if (terms == 0) return;

  const auto rows = static_cast<Eigen::Index>(rings.size() - 1);
  Eigen::MatrixXd system(rows, terms);
  Eigen::VectorXd weights(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Index sample = sectors_.vertex(rings[static_cast<std::size_t>(i) + 1]);
    samples.push_back(sample);
    const Vec3 offset = fit.scale * (x[sample] - x[fit.vertex]);
    const auto values = monomials(offset.dot(fit.tangents[0]), offset.dot(fit.tangents[1]));
    weights[i] = 1 / (offset.squaredNorm() + 0.1);
    for (int j = 0; j < terms; ++j) system(i, j) = weights[i] * values[j];
  }
  matrix = system.completeOrthogonalDecomposition().pseudoInverse() * weights.asDiagonal();
}

void FlowMap::set_carrier(std::span<const Vec3> positions) {
  carrier_.assign(positions.begin(), positions.end());
  parallel_for_blocks(fits_.size(), threads_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      const Fit& fit = fits_[s];
      Coefficients sum = Coefficients::Zero();
      for (std::uint32_t j = fit.first; j < fit.first + fit.count; ++j) {
        const Vec3 offset = carrier_[samples_[j]] - carrier_[fit.vertex];
        for (int i = 0; i < kTerms; ++i) sum.col(i) += columns_[j][i] * offset;
      }
      coefficients_[s] = sum;
    }
  });
}

MappedPoint FlowMap::map(const MaterialPoint& m) const {
  const auto& gradient = surface_->gradient(m.triangle);
  const auto& frame = surface_->frame(m.triangle);
  const Vec3 start = surface_->point(m);
  // Blending weights b^2 / sum b^2: they and their derivatives vanish on the opposite edge, so that the blend
  // goes on smoothly beyond it.
  const Vec3 squares = m.weights.cwiseAbs2();
  const double total = squares.sum();
  const Eigen::RowVector2d total_gradient = 2 * m.weights.transpose() * gradient;
  MappedPoint mapped;
  for (unsigned k = 0; k < 3; ++k) {
    if (m.weights[k] == 0) continue;
    const Index sector = sectors_.of(3 * m.triangle + k);
    const Fit& fit = fits_[sector];
    const Vec3 offset = fit.scale * (start - surface_->positions()[fit.vertex]);
    const double u = offset.dot(fit.tangents[0]);
    const double v = offset.dot(fit.tangents[1]);
    using Terms = Eigen::Map<const Eigen::Matrix<double, kTerms, 1>>;
    const auto value = monomials(u, v);
    const auto by_u = monomials_by_u(u, v);
    const auto by_v = monomials_by_v(u, v);
    const Vec3 point = carrier_[fit.vertex] + coefficients_[sector] * Terms(value.data());
    const Vec3 along_u = fit.scale * (coefficients_[sector] * Terms(by_u.data()));
    const Vec3 along_v = fit.scale * (coefficients_[sector] * Terms(by_v.data()));
    const double weight = squares[k] / total;
    const Eigen::RowVector2d weight_gradient =
        (2 * m.weights[k] * gradient.row(k) - weight * total_gradient) / total;
    mapped.position += weight * point;
    for (int i = 0; i < 2; ++i) {
      mapped.jacobian.col(i) +=
          weight_gradient[i] * point +
          weight * (fit.tangents[0].dot(frame[i]) * along_u + fit.tangents[1].dot(frame[i]) * along_v);
    }
  }
  return mapped;
}

Vec3 FlowMap::position(const MaterialPoint& m) const {
  return map(m).position;
}

}  // namespace isorelax
