#include "cli/benchmark_paper.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/table.h"
#include "view/picture.h"

namespace isorelax::cli {
namespace {

/// As the paper prints angles: one digit behind the point, under one degree two that count.
std::string angle_text(double degrees) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), degrees < 1 ? "%.2g" : "%.1f", degrees);
  return buffer.data();
}

std::string dash_or(const std::optional<double>& degrees) {
  return degrees ? angle_text(*degrees) : "-";
}

std::string padded(std::string text, std::size_t width) {
  text.insert(0, width - std::min(width, text.size()), ' ');
  return text;
}

using Figure = double QualityReport::*;

std::optional<double> figure_of(const PaperRow& row, std::size_t mesh, Figure figure) {
  return row.folded(mesh) ? std::nullopt : std::optional(row.quality[mesh].*figure);
}

constexpr std::size_t kNameWidth = 14;
constexpr std::size_t kColumnWidth = 8;
constexpr std::size_t kPaperWidth = 8;

/// One block of the table; `paper` says where the paper's figures are, none: it prints none.
std::string block(const std::vector<PaperRow>& rows, const std::string& title, Figure figure,
                  std::array<std::optional<double>, kPaperMeshes> PaperFigures::*paper) {
  std::string text = title + "\n" + std::string(kNameWidth, ' ');
  for (const std::string_view mesh : kPaperMeshNames) {
    text += padded(std::string(mesh), kColumnWidth);
    if (paper != nullptr) text += std::string(kPaperWidth, ' ');
  }
  while (text.back() == ' ') text.pop_back();
  text += "\n";
  for (const PaperRow& row : rows) {
    text += std::string(row.name) + std::string(kNameWidth - row.name.size(), ' ');
    for (std::size_t i = 0; i < kPaperMeshes; ++i) {
      text += padded(dash_or(figure_of(row, i, figure)), kColumnWidth);
      if (paper == nullptr) continue;
      text += padded(row.paper ? "(" + dash_or(((*row.paper).*paper)[i]) + ")" : "", kPaperWidth);
    }
    while (text.back() == ' ') text.pop_back();
    text += "\n";
  }
  return text + "\n";
}

std::string iterations_text(const PaperRow& row) {
  const auto [least, most] = std::minmax_element(row.iterations.begin(), row.iterations.end());
  if (*most == 0) return "";
  return *least == *most ? std::to_string(*most) + " steps"
                         : std::to_string(*least) + " to " + std::to_string(*most) + " steps";
}

Json optional_numbers(const std::array<std::optional<double>, kPaperMeshes>& values) {
  Json list = Json::array();
  for (const auto& value : values) list.push_back(value ? Json(*value) : Json(nullptr));
  return list;
}

Json numbers_of(const PaperRow& row, Figure figure) {
  std::array<std::optional<double>, kPaperMeshes> values;
  for (std::size_t i = 0; i < kPaperMeshes; ++i) values[i] = figure_of(row, i, figure);
  return optional_numbers(values);
}

const PaperRow& row_of(const std::vector<PaperRow>& rows, std::string_view key) {
  return *std::find_if(rows.begin(), rows.end(), [&](const PaperRow& row) { return row.key == key; });
}

}  // namespace

std::string paper_text(const std::vector<PaperRow>& rows, const PaperTableOptions& options) {
  std::string text = "Table 1 of Jiao, Bayyana and Zha 2007, on meshes from seed " +
                     std::to_string(options.seed) +
                     "; in brackets what the paper prints for its own. - is a mesh that folded.\n\n";
  text += block(rows, "Smallest angle, degrees", &QualityReport::min_angle_deg, &PaperFigures::min_angle_deg);
  text += block(rows, "Largest angle, degrees", &QualityReport::max_angle_deg, &PaperFigures::max_angle_deg);
  text += block(rows, "Mean of the triangles' smallest angles, degrees (not in the paper)",
                &QualityReport::mean_min_angle_deg, nullptr);
  text += "Rows, with the time of their steps on one thread for all six meshes (";
  for (std::size_t i = 0; i < kPaperMeshes; ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(rows.front().meshes[i].triangle_count());
  }
  text += " triangles)\n";
  for (const PaperRow& row : rows) {
    const std::string steps = iterations_text(row);
    std::array<char, 32> seconds{};
    std::snprintf(seconds.data(), seconds.size(), "; %.2f s", row.seconds);
    text += std::string(row.name) + std::string(kNameWidth - row.name.size() + 1, ' ') +
            std::string(row.about) + (steps.empty() ? "" : "; " + steps + seconds.data()) + "\n";
  }
  text += "\nWhere the paper is silent, and what was done\n";
  for (const std::string_view choice : paper_choices()) text += bullet(choice);
  return text;
}

Json paper_json(const std::vector<PaperRow>& rows, const PaperTableOptions& options) {
  Json object;
  object["seed"] = options.seed;
  for (std::size_t i = 0; i < kPaperMeshes; ++i) {
    const TriangleMesh& mesh = rows.front().meshes[i];
    object["meshes"].push_back({{"name", kPaperMeshNames[i]},
                                {"vertices", mesh.vertex_count()},
                                {"triangles", mesh.triangle_count()}});
  }
  for (const PaperRow& row : rows) {
    Json entry = {{"method", row.key},
                  {"about", row.about},
                  {"iterations", row.iterations},
                  {"seconds", row.seconds},
                  {"min_angle_deg", numbers_of(row, &QualityReport::min_angle_deg)},
                  {"max_angle_deg", numbers_of(row, &QualityReport::max_angle_deg)},
                  {"mean_min_angle_deg", numbers_of(row, &QualityReport::mean_min_angle_deg)},
                  {"area_std_over_mean", numbers_of(row, &QualityReport::area_std_over_mean)}};
    for (std::size_t i = 0; i < kPaperMeshes; ++i) entry["inverted"].push_back(row.quality[i].inverted);
    if (row.paper) {
      entry["paper_min_angle_deg"] = optional_numbers(row.paper->min_angle_deg);
      entry["paper_max_angle_deg"] = optional_numbers(row.paper->max_angle_deg);
    }
    object["rows"].push_back(std::move(entry));
  }
  for (const std::string_view choice : paper_choices()) object["choices"].push_back(choice);
  return object;
}

render::Image paper_picture(const std::vector<PaperRow>& rows) {
  constexpr std::size_t kU1 = 0;
  constexpr std::size_t kR1 = 3;
  const PaperRow& before = row_of(rows, "original");
  const PaperRow& after = row_of(rows, "cnea");
  view::View view;
  view.size = {1800, 1520};
  view.wire = true;
  view.camera = "top";
  view.background = render::kWhiteBackground;
  view::Exhibits exhibits;
  const auto add = [&](const PaperRow& row, std::size_t mesh, const std::string& title) {
    exhibits.meshes.push_back(&row.meshes[mesh]);
    view.labels.push_back(title + ": angles from " + angle_text(row.quality[mesh].min_angle_deg) + " to " +
                          angle_text(row.quality[mesh].max_angle_deg) + "\u00b0");
  };
  add(before, kU1, "(a) U1 as made");
  add(after, kU1, "(b) U1 after CNEA");
  add(before, kR1, "(c) R1 as made");
  add(after, kR1, "(d) R1 after CNEA");
  return view::Studio().draw(view, exhibits).image;
}

}  // namespace isorelax::cli
