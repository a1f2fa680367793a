#include "trace/predicate_names.h"

#include "quality/triangle_metrics.h"

namespace isorelax {
namespace {

double count(std::size_t n) {
  return static_cast<double>(n);
}

template <unsigned kBit>
double limited(const Moment& m) {
  return count(m.numbers.limits[kBit]);
}

TriangleMetrics metrics(const Moment& m, Index t) {
  return measure_triangle(m.positions, m.triangles[t]);
}

constexpr PredicateName kNames[] = {
    {"iteration", "number of the iteration, from 1", [](const Moment& m) { return count(m.iteration); }},
    {"time", "time of a moving surface", [](const Moment& m) { return m.time; }},
    {"min_angle", "smallest angle of the mesh, degrees",
     [](const Moment& m) { return m.numbers.quality.min_angle_deg; }},
    {"max_angle", "largest angle, degrees", [](const Moment& m) { return m.numbers.quality.max_angle_deg; }},
    {"mean_angle", "mean of each triangle's smallest angle, degrees",
     [](const Moment& m) { return m.numbers.quality.mean_min_angle_deg; }},
    {"inverted", "triangles that lie upside down",
     [](const Moment& m) { return count(m.numbers.quality.inverted); }},
    {"folded", "how many more of them than at the start",
     [](const Moment& m) { return count(m.numbers.quality.inverted) - count(m.inverted_at_start); }},
    {"energy", "energy after the step", [](const Moment& m) { return m.numbers.after.energy; }},
    {"energy_before", "energy before the step", [](const Moment& m) { return m.numbers.before.energy; }},
    {"energy_rose", "1 where the energy after is larger than before",
     [](const Moment& m) { return m.numbers.after.energy > m.numbers.before.energy ? 1.0 : 0.0; }},
    {"worst_energy", "largest E of a triangle", [](const Moment& m) { return m.numbers.after.worst_energy; }},
    {"gradient_norm", "2-norm of the tangent gradient before the step",
     [](const Moment& m) { return m.numbers.before.gradient_norm; }},
    {"moved", "vertices that moved", [](const Moment& m) { return count(m.numbers.moved); }},
    {"largest_move", "length of the longest move", [](const Moment& m) { return m.numbers.largest_move; }},
    {"fold_passes", "rounds of the step-size control",
     [](const Moment& m) { return count(m.numbers.fold_passes); }},
    {"energy_passes", "rounds of the energy guard",
     [](const Moment& m) { return count(m.numbers.energy_passes); }},
    {"class_changes", "vertices whose tangent class changed",
     [](const Moment& m) { return count(m.numbers.class_changes); }},
    {"class_changed", "1 where there are any",
     [](const Moment& m) { return m.numbers.class_changes > 0 ? 1.0 : 0.0; }},
    {"limited_pinned", "vertices limited by being pinned", limited<0>},
    {"limited_corner", "... as a corner", limited<1>},
    {"limited_ridge", "... to a ridge", limited<2>},
    {"limited_boundary", "... by the boundary", limited<3>},
    {"limited_fold", "... because a triangle would have folded", limited<4>},
    {"limited_energy", "... because the energy would have risen", limited<5>},
    {"limited_surface", "... by their distance from the input surface", limited<6>},
    {"converged", "vertices that asked for no move worth making", limited<7>},
    {"stop", "1 at the last iteration", [](const Moment& m) { return m.stop ? 1.0 : 0.0; }},
};

constexpr PredicateField kVertexFields[] = {
    {"alpha", "accepted share of the proposed move, 0..1",
     [](const Moment& m, Index v) { return m.record.alpha[v]; }},
    {"move", "length of the accepted move",
     [](const Moment& m, Index v) { return m.record.alpha[v] * m.record.displacement[v].norm(); }},
    {"proposed", "length of the proposed move",
     [](const Moment& m, Index v) { return m.record.displacement[v].norm(); }},
    {"gradient", "2-norm of the energy's gradient",
     [](const Moment& m, Index v) { return m.record.gradient[v].norm(); }},
    {"limits", "bits of what limited it, as in the step record",
     [](const Moment& m, Index v) { return static_cast<double>(m.record.limits[v]); }},
    {"x", "position after the step", [](const Moment& m, Index v) { return m.positions[v].x(); }},
    {"y", "", [](const Moment& m, Index v) { return m.positions[v].y(); }},
    {"z", "", [](const Moment& m, Index v) { return m.positions[v].z(); }},
};

constexpr PredicateField kTriangleFields[] = {
    {"min_angle", "smallest angle after the step, degrees",
     [](const Moment& m, Index t) { return metrics(m, t).min_angle_deg; }},
    {"max_angle", "largest angle, degrees",
     [](const Moment& m, Index t) { return metrics(m, t).max_angle_deg; }},
    {"area", "area", [](const Moment& m, Index t) { return metrics(m, t).area; }},
};

}  // namespace

std::span<const PredicateName> predicate_names() {
  return kNames;
}
std::span<const PredicateField> vertex_fields() {
  return kVertexFields;
}
std::span<const PredicateField> triangle_fields() {
  return kTriangleFields;
}

}  // namespace isorelax
