#include "editor/step_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "ui/theme.h"

namespace isorelax::editor {
namespace {

using model::StageKind;

render::Color color_of(ImU32 color) {
  return {static_cast<std::uint8_t>(color >> IM_COL32_R_SHIFT),
          static_cast<std::uint8_t>(color >> IM_COL32_G_SHIFT),
          static_cast<std::uint8_t>(color >> IM_COL32_B_SHIFT)};
}

/// Edge of the equilateral triangle with the mesh' mean area.
double typical_edge(std::span<const Vec3> x, std::span<const Triangle> triangles) {
  double area = 0;
  for (const Triangle& t : triangles) area += area_vector(x[t[0]], x[t[1]], x[t[2]]).norm();
  return std::sqrt(4 / std::sqrt(3.0) * area /
                   (2.0 * static_cast<double>(std::max<std::size_t>(1, triangles.size()))));
}

/// The length under which nineteen of twenty non-zero vectors are; 0 for none.
double usual_length(const std::vector<Vec3>& vectors) {
  std::vector<double> lengths;
  for (const Vec3& v : vectors)
    if (v.squaredNorm() > 0) lengths.push_back(v.norm());
  if (lengths.empty()) return 0;
  const auto at = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() * 19 / 20);
  std::nth_element(lengths.begin(), at, lengths.end());
  return *at;
}

/// 1, 2 or 5 times a power of ten, not above the value and at least 1.
double round_factor(double value) {
  if (!(value > 1)) return 1;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  return (value >= 5 * power ? 5 : value >= 2 * power ? 2 : 1) * power;
}

/// The moves of a stage, or the gradient's parts, one for each vertex.
std::vector<Vec3> vectors_of(const StepRecord& record, const model::Stage& stage) {
  const std::size_t n = record.gradient.size();
  std::vector<Vec3> vectors(n);
  std::vector<double> alpha;
  if (stage.kind == StageKind::control && record.detail) alpha = alpha_after(record, stage.pass + 1);
  for (std::size_t v = 0; v < n; ++v) {
    switch (stage.kind) {
      case StageKind::gradient:
        vectors[v] = -record.gradient[v];
        break;
      case StageKind::tangent:
        vectors[v] = record.detail ? Vec3(-record.detail->tangent[v]) : Vec3(Vec3::Zero());
        break;
      case StageKind::proposed:
        vectors[v] = record.detail ? record.detail->proposed[v] : record.displacement[v];
        break;
      case StageKind::control:
        vectors[v] = (alpha.empty() ? record.alpha[v] : alpha[v]) * record.displacement[v];
        break;
      case StageKind::moved:
        vectors[v] = record.alpha[v] * record.displacement[v];
        break;
    }
  }
  return vectors;
}

void add_arrows(const model::Session& session, std::span<const Vec3> x, const model::Stage& stage,
                render::Scene& scene) {
  const StepRecord& record = *session.inspection.step->record;
  const double edge = typical_edge(x, session.document->mesh().triangles);
  std::vector<Vec3> vectors = vectors_of(record, stage);
  if (stage.kind == StageKind::gradient || stage.kind == StageKind::tangent) {
    // Gradients of slivers are larger than others by orders: longer ones get longer arrows, but not by much.
    const double usual = usual_length(record.gradient);
    for (Vec3& v : vectors) {
      const double length = v.norm();
      if (length > 0) v *= 0.9 * edge * std::sqrt(length / (length + usual)) / length;
    }
    scene.caption = "Arrows: downhill, longer where it is steeper, not to scale";
  } else {
    // All stages of a step share a factor, so that their arrows can be compared.
    const double usual = usual_length(record.detail ? record.detail->proposed : record.displacement);
    const double factor = usual > 0 ? round_factor(0.8 * edge / usual) : 1;
    for (Vec3& v : vectors) v *= factor;
    if (factor > 1) scene.caption = "Arrows: moves \xC3\x97 " + std::to_string(static_cast<long>(factor));
  }
  scene.arrows.items.clear();
  for (std::size_t v = 0; v < vectors.size(); ++v)
    if (vectors[v].squaredNorm() > 0) scene.arrows.items.push_back({x[v], x[v] + vectors[v]});
  scene.arrows.color = color_of(ui::color::kStages[static_cast<std::size_t>(stage.kind)]);
  scene.arrows.width = 1.8;
}

/// The bit that says most about why a vertex did not move as it wished.
unsigned main_limit(std::uint16_t limits) {
  constexpr std::array<unsigned, kLimitBits> kOrder{4, 5, 6, 0, 1, 3, 2, 7};
  for (const unsigned bit : kOrder)
    if ((limits >> bit & 1U) != 0) return bit;
  return kLimitBits;
}

void add_reasons(const model::Session& session, std::span<const Vec3> x, render::Scene& scene) {
  const auto& limits = session.inspection.step->record->limits;
  const double diameter = limits.size() > 20000 ? 4 : 7;
  std::array<bool, kLimitBits> occurs{};
  for (std::size_t v = 0; v < limits.size(); ++v) {
    unsigned bit = main_limit(limits[v]);
    if (session.selected_limit) {
      if ((limits[v] >> *session.selected_limit & 1U) == 0) continue;
      bit = *session.selected_limit;
    }
    if (bit >= kLimitBits) continue;
    scene.markers.push_back({x[v], color_of(ui::color::kLimits[bit]), diameter});
    occurs.at(bit) = true;
  }
  for (unsigned bit = 0; bit < kLimitBits; ++bit)
    if (occurs.at(bit))
      scene.key.push_back({color_of(ui::color::kLimits[bit]), std::string(limit_name(limit_of_bit(bit)))});
}

}  // namespace

void add_step(const model::Session& session, std::span<const Vec3> x, render::Scene& scene) {
  const auto& step = session.inspection.step;
  const bool known = step && step->record->limits.size() == x.size() && !session.is_running();
  if (known && session.view.reasons) add_reasons(session, x, scene);
  if (known && session.timeline.cursor.stage) add_arrows(session, x, *session.timeline.cursor.stage, scene);
  for (const Index v : session.smoothing.pinned)
    if (v < x.size()) scene.markers.push_back({x[v], color_of(ui::color::kLimits[0]), 9});
  if (session.selected_vertex && *session.selected_vertex < x.size()) {
    scene.markers.push_back({x[*session.selected_vertex], {255, 255, 255}, 14});
    scene.markers.push_back({x[*session.selected_vertex], color_of(ui::color::kAccent), 9});
  }
}

bool means_vertex(const Vec3& point, const std::array<Vec3, 3>& corners, unsigned nearest) {
  const Vec3 whole = area_vector(corners[0], corners[1], corners[2]);
  if (!(whole.squaredNorm() > 0)) return true;
  const Vec3 opposite = area_vector(point, corners[next(nearest)], corners[previous(nearest)]);
  return opposite.dot(whole) > 0.6 * whole.squaredNorm();
}

}  // namespace isorelax::editor
