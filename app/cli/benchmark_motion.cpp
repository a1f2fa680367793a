#include "cli/benchmark_motion.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/motion_pictures.h"
#include "cli/motion_series.h"
#include "cli/table.h"

namespace isorelax::cli {
namespace {

constexpr std::array<std::string_view, 6> kTried = {
    "A cap on every vertex' own move, and halving single vertices where a triangle gets worse: neighbours "
    "lose step "
    "with each other and the mesh locks (mean angle 27 at mid-time, triangles starve). One damping for all, "
    "raised "
    "until the longest move is an edge, does not.",
    "Damping of moves over ridges alone: it slows the loss of thin ends and does not stop it.",
    "No weight on the height of the surface over edges: mean angle 42 at mid-time, but the thin end is drawn "
    "in by "
    "more than the sphere's radius (the distance from the exact surface in the table tells).",
    "Heavier area terms (p = 1 or 2 in det^p + det^-p) instead of p = 3 with a small weight: they cost "
    "angles "
    "everywhere (mean 16 to 24), not only where triangles are several times too large.",
    "Volume left free: vertices exactly on the surface lose 0.5 to 5 % of the volume to chords at mid-time.",
    "Pure advection's error of 4e-5 % is that of the time integration alone; positions from cubic fits over "
    "the "
    "start mesh cannot reach it.",
};

void append_line(std::string& text, const char* format, auto... values) {
  std::array<char, 320> line{};
  std::snprintf(line.data(), line.size(), format, values...);
  text += line.data();
}

void append_rows(std::string& text, const std::vector<MotionRow>& rows) {
  text +=
      "preset    vertices |  at T/2: min  mean  <15 %  ratio  dV %    off %   folds |  at T: min  mean  <15 "
      "%  ratio  "
      "folds  error %      | worst dV %  s/step\n";
  for (const MotionRow& row : rows) {
    const MotionMeasure& m = row.middle.measure;
    const MotionMeasure& e = row.end.measure;
    const double off =
        row.middle.exact ? std::max(row.middle.exact->first.max, row.middle.exact->second.max) / kMotionRadius
                         : 0;
    append_line(text, "%-9s %8zu | %11.2f %5.1f %6.1f %6.0f %+7.3f %7.2f %6zu |", row.preset.c_str(),
                row.vertices, m.min_angle_deg, m.mean_angle_deg, 100 * m.below_15_deg, m.area_max_over_min,
                100 * row.middle.volume_change, 100 * off, m.folded_edges);
    if (!row.failure.empty()) {
      text += " ended early: " + row.failure + "\n";
      continue;
    }
    append_line(text, " %9.2f %5.1f %6.1f %6.0f %6zu  %.2g / %.2g | %10.3f %7.3f\n", e.min_angle_deg,
                e.mean_angle_deg, 100 * e.below_15_deg, e.area_max_over_min, e.folded_edges,
                row.end.error ? 100 * row.end.error->max / kMotionRadius : NAN,
                row.end.error ? 100 * row.end.error->mean / kMotionRadius : NAN, 100 * row.worst_volume,
                row.seconds_a_step);
  }
}

struct Order {
  std::string name;
  std::vector<double> values;
};

/// Quantities that fall with the edge length h ~ 1 / sqrt(vertices).
std::vector<Order> orders_of(const std::vector<MotionRow>& rows) {
  std::vector<Order> orders = {{"error at T, mean", {}},
                               {"error at T, max", {}},
                               {"RMS distance from the exact surface at T/2", {}},
                               {"|dV| at T/2 before balancing", {}}};
  for (const MotionRow& row : rows) {
    orders[0].values.push_back(row.end.error ? row.end.error->mean / kMotionRadius : NAN);
    orders[1].values.push_back(row.end.error ? row.end.error->max / kMotionRadius : NAN);
    orders[2].values.push_back(row.middle.exact ? row.middle.exact->second.rms / kMotionRadius : NAN);
    const double volume = row.middle.report.balance.volume_before;
    orders[3].values.push_back(std::abs(volume / row.middle.measure.volume - 1));
  }
  return orders;
}

double observed_order(double coarse, double fine, std::size_t coarse_vertices, std::size_t fine_vertices) {
  return std::log(coarse / fine) /
         (0.5 * std::log(static_cast<double>(fine_vertices) / static_cast<double>(coarse_vertices)));
}

Json row_json(const MotionRow& row) {
  Json object = {{"preset", row.preset}, {"period", row.period}, {"vertices", row.vertices}};
  object["middle"] = entry_json(row.middle);
  object["end"] = entry_json(row.end);
  object["worst_volume_change"] = row.worst_volume;
  object["least_angle_deg"] = row.least_angle_deg;
  object["seconds_a_step"] = row.seconds_a_step;
  if (!row.failure.empty()) object["failure"] = row.failure;
  return object;
}

}  // namespace

std::string motion_text(const MotionTable& table) {
  std::string text =
      "Eq. (10) on a sphere of radius 0.15, RK4 steps of " + number_text(table.options.step) +
      ". Angles in degrees; off: largest distance between the mesh and a dense\nexact copy, either "
      "way, and error: of the vertices from the sphere, max / mean, both of the radius. Folds: edges "
      "that turn by over 120 deg\n(at T/2 the exact surface has a knife edge). none: pure advection; "
      "paper: the recipe as printed.\n\nT = 3\n";
  append_rows(text, table.rows);
  text += "\nT = 0.75, a quarter of the deformation\n";
  append_rows(text, table.quarter);
  if (!table.convergence.empty()) {
    text += "\nConvergence, T = 0.75\n";
    append_rows(text, table.convergence);
    for (const Order& order : orders_of(table.convergence)) {
      append_line(text, "%-44s", order.name.c_str());
      for (std::size_t i = 0; i < order.values.size(); ++i) {
        append_line(text, "  %.3g %%", 100 * order.values[i]);
        if (i > 0)
          append_line(text, " (order %.1f)",
                      observed_order(order.values[i - 1], order.values[i], table.convergence[i - 1].vertices,
                                     table.convergence[i].vertices));
      }
      text += "\n";
    }
  }
  text += "\nGoals\n";
  for (const MotionGoal& goal : motion_goals(table))
    text += std::string(goal.met ? "met     " : "MISSED  ") + goal.wanted + "\n        " + goal.found + "\n";
  text += "\nWhat was tried\n";
  for (const std::string_view sentence : kTried) text += bullet(sentence);
  return text;
}

Json motion_json(const MotionTable& table) {
  Json object = {{"step", table.options.step}, {"radius", kMotionRadius}};
  const auto list = [](const std::vector<MotionRow>& rows) {
    Json array = Json::array();
    for (const MotionRow& row : rows) array.push_back(row_json(row));
    return array;
  };
  object["rows"] = list(table.rows);
  object["quarter"] = list(table.quarter);
  object["convergence"] = list(table.convergence);
  for (const Order& order : orders_of(table.convergence)) {
    Json orders = Json::array();
    for (std::size_t i = 1; i < order.values.size(); ++i)
      orders.push_back(observed_order(order.values[i - 1], order.values[i], table.convergence[i - 1].vertices,
                                      table.convergence[i].vertices));
    object["orders"].push_back({{"of", order.name}, {"values", order.values}, {"orders", std::move(orders)}});
  }
  for (const MotionGoal& goal : motion_goals(table))
    object["goals"].push_back({{"wanted", goal.wanted}, {"found", goal.found}, {"met", goal.met}});
  for (const std::string_view sentence : kTried) object["tried"].push_back(sentence);
  return object;
}

render::Image motion_picture(const MotionTable& table) {
  MotionPictures pictures("fit", 720, 600);
  for (const MotionRow& row : table.rows)
    for (const TriangleMesh& mesh : row.meshes)
      if (!mesh.triangles.empty()) pictures.look_at(mesh);
  std::vector<render::Image> panels;
  for (const MotionRow& row : table.rows) {
    for (std::size_t i = 0; i < row.meshes.size(); ++i) {
      constexpr std::array<double, 3> kShares = {0.25, 0.5, 1};
      if (row.meshes[i].triangles.empty()) {
        panels.emplace_back(720, 600);
        continue;
      }
      panels.push_back(
          pictures.draw(row.meshes[i], row.preset + ", t = " + number_text(kShares[i] * row.period)));
    }
  }
  return tile(panels, 3);
}

}  // namespace isorelax::cli
