#include "surface/height_fit.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "mesh/lanes.h"

namespace isorelax {
namespace {

/// Monomials of degree 1..d in two variables.
constexpr int term_count(int degree) {
  return (degree + 1) * (degree + 2) / 2 - 1;
}

constexpr int kMaxTerms = term_count(HeightFit::kMaxDegree);
/// The rows of a least-squares system: the terms, then the height; as wide as vectors like it.
constexpr int kWidth = kMaxTerms + 2;
constexpr int kHeight = kWidth - 1;
using Row = std::array<double, kWidth>;

/// u, v, u^2, u v, v^2, u^3, ...: a lower degree is a leading part. At last the height; all times a weight.
[[gnu::always_inline]] inline void fill(double u, double v, double height, double weight, Row& row) {
  const double wu = weight * u, wv = weight * v;
  const double uu = u * u, uv = u * v, vv = v * v;
  const double wuu = wu * u, wuv = wu * v, wvv = wv * v;
  row = {wu,      wv,       wuu,      wuv,      wvv,      wuu * u,  wuu * v, wuv * v,
         wvv * v, wuu * uu, wuu * uv, wuu * vv, wuv * vv, wvv * vv, 0,       weight * height};
}

/// Four numbers that the compiler keeps in a register: loops over a row alone it does not vectorise.
using Four = double __attribute__((vector_size(32)));
constexpr int kFours = kWidth / 4;
static_assert(kWidth % 4 == 0);

[[gnu::always_inline]] inline void load(const Row& row, int part, Four& four) {
  std::memcpy(&four, row.data() + static_cast<std::ptrdiff_t>(4) * part, sizeof four);
}
[[gnu::always_inline]] inline void store(const Four& four, int part, Row& row) {
  std::memcpy(row.data() + static_cast<std::ptrdiff_t>(4) * part, &four, sizeof four);
}

/// One round of modified Gram-Schmidt, on the columns from 4 kFrom on.
template <int kFrom>
[[gnu::always_inline]] inline void take_out(std::span<Row> rows, int k, Row& of_r) {
  std::array<Four, kFours> along{};
  for (const Row& row : rows) {
    for (int part = kFrom; part < kFours; ++part) {
      Four four;
      load(row, part, four);
      along[part] += row[k] * four;
    }
  }
  for (int part = kFrom; part < kFours; ++part) store(along[part], part, of_r);
  const double norm2 = of_r[k];
  const double scale = norm2 > 0 ? 1 / std::sqrt(norm2) : 0;
  for (int part = kFrom; part < kFours; ++part) {
    along[part] *= scale;
    store(along[part], part, of_r);
  }
  for (Row& row : rows) {
    const double q = scale * row[k];
    for (int part = kFrom; part < kFours; ++part) {
      Four four;
      load(row, part, four);
      four -= q * along[part];
      store(four, part, row);
    }
  }
}

/// Modified Gram-Schmidt, which is as sound as Householder's QR where the right-hand side takes part. Leaves
/// the rows of R (from their diagonal on) with what belongs to them of Q^T b. A column that is zero gets a
/// row of zeros.
ISORELAX_VECTOR_CLONES
void orthogonalise(std::span<Row> rows, int terms, std::array<Row, kMaxTerms>& r) {
  for (int k = 0; k < terms; ++k) {
    if (k < 4) {
      take_out<0>(rows, k, r[k]);
    } else if (k < 8) {
      take_out<1>(rows, k, r[k]);
    } else if (k < 12) {
      take_out<2>(rows, k, r[k]);
    } else {
      take_out<3>(rows, k, r[k]);
    }
  }
}

/// Least squares of the highest degree that the rows determine; destroys them. Returns that degree, or 0
/// where it is under 2.
int solve(std::span<Row> rows, int degree, double independence, std::span<double> coefficients) {
  Row squares{};
  for (const Row& row : rows)
    for (int k = 0; k < kMaxTerms; ++k) squares[k] += row[k] * row[k];
  std::array<Row, kMaxTerms> r;
  orthogonalise(rows, term_count(degree), r);
  // R_kk is the part of a column that the columns before it do not explain.
  const auto determined = [&](int d) {
    for (int k = 0; k < term_count(d); ++k)
      if (!(r[k][k] > independence * std::sqrt(squares[k]))) return false;
    return true;
  };
  while (degree > 1 && !determined(degree)) --degree;
  if (degree < 2) return 0;
  for (int k = term_count(degree) - 1; k >= 0; --k) {
    double rest = r[k][kHeight];
    for (int j = k + 1; j < term_count(degree); ++j) rest -= r[k][j] * coefficients[j];
    coefficients[k] = rest / r[k][k];
  }
  return degree;
}

/// The power degree / 4 of a number, for degrees 2 to 4.
double quarter_power(double x, int degree) {
  if (degree == 4) return x;
  return degree == 2 ? std::sqrt(x) : std::sqrt(x * std::sqrt(x));
}

/// A sample in the frame of a fit, squared distance from its origin last.
struct LocalSample {
  double u, v, height, squared;
};

/// Cosine and sine of the angle by which the frame turns with the samples, so that the fit does not depend on
/// how the surface lies in space: halfway between where they spread most and least. Of samples near a line u
/// and v are then almost the same, and what they do not determine shows.
std::array<double, 2> turn_of_frame(std::span<const LocalSample> samples) {
  double uu = 0, uv = 0, vv = 0;
  for (const LocalSample& s : samples) uu += s.u * s.u, uv += s.u * s.v, vv += s.v * s.v;
  const double angle = 0.5 * std::atan2(2 * uv, uu - vv) + 0.25 * std::numbers::pi;
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

std::size_t HeightFit::samples_for(const HeightFitOptions& options) {
  const int terms = term_count(std::min(options.degree, kMaxDegree));
  return static_cast<std::size_t>(std::ceil(options.samples_per_unknown * terms));
}

HeightFit::HeightFit(const Vec3& origin, const Vec3& unit_normal, std::span<const FitSample> samples,
                     const HeightFitOptions& options)
    : origin_(origin), normal_(unit_normal) {
  samples = samples.first(std::min<std::size_t>(samples.size(), kMaxSamples));
  t1_ = normal_.unitOrthogonal();
  t2_ = normal_.cross(t1_);
  std::array<LocalSample, kMaxSamples> memory;
  const std::span<LocalSample> local = std::span(memory).first(samples.size());
  double radius2 = 0, sum2 = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vec3 d = samples[i].point - origin;
    local[i] = {d.dot(t1_), d.dot(t2_), d.dot(normal_), d.squaredNorm()};
    radius2 = std::max(radius2, local[i].squared);
    sum2 += local[i].squared;
  }
  if (!(radius2 > 0)) return;
  const double scale = 1 / std::sqrt(radius2);
  const auto [cosine, sine] = turn_of_frame(local);
  const double c = scale * cosine, s = scale * sine;
  const Vec3 t1 = t1_;
  t1_ = c * t1 + s * t2_;
  t2_ = c * t2_ - s * t1;

  int degree = std::min(options.degree, kMaxDegree);
  const auto enough = [&](int d) {
    return static_cast<double>(samples.size()) >= options.samples_per_unknown * term_count(d);
  };
  while (degree > 1 && !enough(degree)) --degree;
  if (degree < 2) return;

  std::array<Row, kMaxSamples> rows;
  const double over_mean2 = static_cast<double>(samples.size()) / sum2;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto& [u, v, height, squared] = local[i];
    const double facing = std::max(0.0, samples[i].normal.dot(normal_));
    const double weight = facing / quarter_power(squared * over_mean2 + 0.01, degree);
    fill(c * u + s * v, c * v - s * u, height, weight, rows[i]);
  }
  degree_ = solve(std::span(rows).first(samples.size()), degree, options.independence, coefficients_);
}

// Coefficients above the degree are zero.
Vec3 HeightFit::lift(const Vec3& point) const {
  if (degree_ == 0) return point;
  const Vec3 d = point - origin_;
  const double u = d.dot(t1_), v = d.dot(t2_);
  const auto& c = coefficients_;
  const double of_u = u * (c[0] + u * (c[2] + u * (c[5] + u * c[9])));
  const double by_v = c[1] + u * (c[3] + u * (c[6] + u * c[10]));
  const double by_v2 = c[4] + u * (c[7] + u * c[11]);
  const double f = of_u + v * (by_v + v * (by_v2 + v * (c[8] + u * c[12] + v * c[13])));
  return point + (f - d.dot(normal_)) * normal_;
}

Vec3 HeightFit::normal(const Vec3& point) const {
  if (degree_ == 0) return normal_;
  const Vec3 d = point - origin_;
  const double u = d.dot(t1_), v = d.dot(t2_);
  const auto& c = coefficients_;
  const double fu = c[0] + u * (2 * c[2] + u * (3 * c[5] + u * 4 * c[9])) +
                    v * (c[3] + u * (2 * c[6] + u * 3 * c[10]) + v * (c[7] + u * 2 * c[11] + v * c[12]));
  const double fv = c[1] + u * (c[3] + u * (c[6] + u * c[10])) +
                    v * (2 * (c[4] + u * (c[7] + u * c[11])) + v * (3 * (c[8] + u * c[12]) + v * 4 * c[13]));
  return normal_ - fu * t1_ - fv * t2_;
}

}  // namespace isorelax
