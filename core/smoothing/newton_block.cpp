#include "smoothing/newton_block.h"

#include <algorithm>
#include <cmath>

namespace isorelax {
namespace {

/// Up to eight corners: where the triangle's next and previous vertex are from the corner's own, the tangent
/// space of that, and what is known of the triangle.
struct CornerBatch {
  Lanes ax, ay, az, bx, by, bz;
  Lanes t1x, t1y, t1z, t2x, t2y, t2z;
  Lanes cot_next, cot_previous, d1;
  Lanes shape, powered;
  std::array<unsigned, kLanes> owner;  // which vertex of the batch
  unsigned count = 0;
};

struct BlockTerms {
  Lanes h11, h12, h22;
};

/// What each corner adds to its vertex' block. With u = dD2/dx and q the derivative of K D2:
/// p E^(p-1) (w_s [2 (cot + cot) / D2 I - (q u^T + u q^T) / D2^2 + 2 K u u^T / D2^2] + w_a S'' u u^T) + E'' g
/// g^T.
ISORELAX_VECTOR_CLONES
void block_terms(const CornerBatch& __restrict c, EnergyWeights w, double exponent,
                 BlockTerms& __restrict out) {
  const double sliver = 1 / (kSliverEnergy * (w.shape + w.area));
  for (unsigned i = 0; i < kLanes; ++i) {
    const double ax = c.ax.at[i], ay = c.ay.at[i], az = c.az.at[i];
    const double bx = c.bx.at[i], by = c.by.at[i], bz = c.bz.at[i];
    const double mx = ay * bz - az * by, my = az * bx - ax * bz, mz = ax * by - ay * bx;
    const double d2 = std::sqrt(mx * mx + my * my + mz * mz);
    const double inverse = 1 / d2;
    const double nx = mx * inverse, ny = my * inverse, nz = mz * inverse;
    const double ex = bx - ax, ey = by - ay, ez = bz - az;
    const double ux = ny * ez - nz * ey, uy = nz * ex - nx * ez, uz = nx * ey - ny * ex;
    const double f = -2 * c.cot_next.at[i], h = -2 * c.cot_previous.at[i];
    const double qx = f * bx + h * ax, qy = f * by + h * ay, qz = f * bz + h * az;

    const double shape = c.shape.at[i];
    const double root = std::sqrt(d2 / c.d1.at[i]);
    const double inverse_root = 1 / root;
    const double convex = 0.75 * inverse_root;  // of S'' D2^2 = (3/4) / root - root / 4
    const double curved = convex - 0.25 * root;
    const double least = kLeastAreaCurvature * convex;
    const double area_curvature = curved > least ? curved : least;

    const double energy = w.shape * shape + w.area * (root + inverse_root);
    const double inverse_energy = 1 / energy;
    const double first = exponent * c.powered.at[i] * inverse_energy;
    // E^p grows like height^-p towards a sliver, and Newton's step on that is short. Without the g g^T part
    // it opens slivers half as fast again; near the minimum, where the part damps, it is kept.
    const double excess = energy * sliver;
    const double second = (exponent - 1) * first * inverse_energy / (1 + excess * excess);

    const double plane = -(f + h) * first * w.shape * inverse;
    const double mixed = -first * w.shape * inverse * inverse;
    const double along = first * inverse * inverse * (2 * w.shape * shape + w.area * area_curvature);
    const double tangent = inverse * (0.5 * w.area * (root - inverse_root) - w.shape * shape);
    const double gq = w.shape * inverse;

    const double px = c.t1x.at[i], py = c.t1y.at[i], pz = c.t1z.at[i];
    const double rx = c.t2x.at[i], ry = c.t2y.at[i], rz = c.t2z.at[i];
    const double u1 = ux * px + uy * py + uz * pz, u2 = ux * rx + uy * ry + uz * rz;
    const double q1 = qx * px + qy * py + qz * pz, q2 = qx * rx + qy * ry + qz * rz;
    const double n1 = nx * px + ny * py + nz * pz, n2 = nx * rx + ny * ry + nz * rz;
    const double g1 = gq * q1 + tangent * u1, g2 = gq * q2 + tangent * u2;
    out.h11.at[i] = plane * (1 - n1 * n1) + 2 * mixed * q1 * u1 + along * u1 * u1 + second * g1 * g1;
    out.h12.at[i] = -plane * n1 * n2 + mixed * (q1 * u2 + q2 * u1) + along * u1 * u2 + second * g1 * g2;
    out.h22.at[i] = plane * (1 - n2 * n2) + 2 * mixed * q2 * u2 + along * u2 * u2 + second * g2 * g2;
  }
}

/// The edges from corner k of a triangle to its next and previous vertex.
void set_edges(CornerBatch& c, unsigned lane, const TriangleState& s, unsigned k) {
  if (k == 0) {
    c.ax.at[lane] = s.e1x, c.ay.at[lane] = s.e1y, c.az.at[lane] = s.e1z;
    c.bx.at[lane] = s.e2x, c.by.at[lane] = s.e2y, c.bz.at[lane] = s.e2z;
  } else if (k == 1) {
    c.ax.at[lane] = s.e2x - s.e1x, c.ay.at[lane] = s.e2y - s.e1y, c.az.at[lane] = s.e2z - s.e1z;
    c.bx.at[lane] = -s.e1x, c.by.at[lane] = -s.e1y, c.bz.at[lane] = -s.e1z;
  } else {
    c.ax.at[lane] = -s.e2x, c.ay.at[lane] = -s.e2y, c.az.at[lane] = -s.e2z;
    c.bx.at[lane] = s.e1x - s.e2x, c.by.at[lane] = s.e1y - s.e2y, c.bz.at[lane] = s.e1z - s.e2z;
  }
}

void set_corner(CornerBatch& corners, unsigned lane, const SmoothingProblem& problem, const Objective& here,
                Corner corner, const NewtonBlock& block) {
  const Index t = corner / 3;
  const unsigned k = corner - 3 * t;
  const TriangleState& state = here.state(t);
  set_edges(corners, lane, state, k);
  corners.t1x.at[lane] = block.t1[0], corners.t1y.at[lane] = block.t1[1], corners.t1z.at[lane] = block.t1[2];
  corners.t2x.at[lane] = block.t2[0], corners.t2y.at[lane] = block.t2[1], corners.t2z.at[lane] = block.t2[2];
  if (problem.reference.is_equilateral()) {
    corners.cot_next.at[lane] = corners.cot_previous.at[lane] = kEquilateralCot;
  } else {
    const ReferenceTriangle reference = problem.reference[t];
    corners.cot_next.at[lane] = reference.cot[next(k)];
    corners.cot_previous.at[lane] = reference.cot[previous(k)];
  }
  corners.d1.at[lane] = problem.reference.d1(t);
  corners.shape.at[lane] = state.shape;
  corners.powered.at[lane] = state.powered;
}

}  // namespace

NewtonBlock::NewtonBlock(Mobility mobility, const Vec3& axis) {
  if (mobility == Mobility::none) return;
  if (mobility == Mobility::line) {
    t1 = axis;
  } else {
    t1 = axis.unitOrthogonal();
    t2 = axis.cross(t1);
  }
}

Vec3 NewtonBlock::solve(const Vec3& g) const {
  const double g1 = g.dot(t1);
  if (t2.isZero(0)) return h11 > 0 ? Vec3(g1 / h11 * t1) : Vec3::Zero();
  // A small multiple of the identity keeps nearly singular blocks (areas only) from sending a vertex far
  // away.
  const double shift = 1e-3 * (h11 + h22);
  const double a = h11 + shift;
  const double c = h22 + shift;
  const double determinant = a * c - h12 * h12;
  const double g2 = g.dot(t2);
  if (!(determinant > 0)) return h11 + h22 > 0 ? Vec3((g1 * t1 + g2 * t2) / (h11 + h22)) : Vec3::Zero();
  return ((c * g1 - h12 * g2) * t1 + (a * g2 - h12 * g1) * t2) / determinant;
}

std::array<NewtonBlock, kLanes> newton_blocks(const SmoothingProblem& problem, const Objective& here,
                                              const TangentBatch& batch) {
  std::array<NewtonBlock, kLanes> blocks;
  CornerBatch corners{};
  BlockTerms terms;
  const auto add_up = [&] {
    block_terms(corners, problem.weights, problem.exponent, terms);
    for (unsigned i = 0; i < corners.count; ++i) {
      NewtonBlock& block = blocks[corners.owner[i]];
      block.h11 += terms.h11.at[i];
      block.h12 += terms.h12.at[i];
      block.h22 += terms.h22.at[i];
    }
    corners.count = 0;
  };
  for (unsigned i = 0; i < batch.count; ++i) {
    const Index v = batch.vertices[i];
    if (problem.mobility[v] == Mobility::none) continue;
    blocks[i] = NewtonBlock(problem.mobility[v], batch.axes[i]);
    for (const Corner c : problem.topology.corners_of(v)) {
      if (problem.treated[c / 3] == 0) continue;
      set_corner(corners, corners.count, problem, here, c, blocks[i]);
      corners.owner[corners.count] = i;
      if (++corners.count == kLanes) add_up();
    }
  }
  if (corners.count > 0) add_up();
  return blocks;
}

}  // namespace isorelax
