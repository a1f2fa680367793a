#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "mesh/triangle_mesh.h"
#include "quality/report.h"

namespace isorelax::cli {

/// Meshes of the paper's Table 1: three relatively uniform ones and three with random points.
inline constexpr std::size_t kPaperMeshes = 6;
inline constexpr std::array<std::string_view, kPaperMeshes> kPaperMeshNames = {"U1", "U2", "U3",
                                                                               "R1", "R2", "R3"};

/// What the paper prints in one row; none: a dash.
struct PaperFigures {
  std::array<std::optional<double>, kPaperMeshes> min_angle_deg, max_angle_deg;
};

/// One row of the table, computed.
struct PaperRow {
  std::string_view key;               ///< for programs: "laplacian"
  std::string_view name;              ///< for people
  std::string_view about;             ///< what was run, in a line
  std::optional<PaperFigures> paper;  ///< none: our own row
  std::array<TriangleMesh, kPaperMeshes> meshes;
  std::array<QualityReport, kPaperMeshes> quality;
  std::array<unsigned, kPaperMeshes> iterations{};
  double seconds = 0;

  /// Whether the result for a mesh has triangles upside down: a dash in the table.
  [[nodiscard]] bool folded(std::size_t mesh) const { return quality[mesh].inverted > 0; }
};

struct PaperTableOptions {
  std::uint64_t seed = 1;
  /// Triangles of the three meshes of each kind; none: 460, 2394, 11704 and 454, 2126, 10282.
  std::optional<std::array<std::size_t, 3>> triangles;
  /// Steps of the published methods.
  unsigned iterations = 50;
};

/// Makes the meshes and runs every method on them, on one thread. `progress` gets the share done and what
/// comes next.
[[nodiscard]] std::vector<PaperRow> compute_paper_table(
    const PaperTableOptions& options, const std::function<void(double, std::string_view)>& progress);

/// Where the paper says nothing, or something that cannot be meant, and what was done: one sentence or two
/// each.
[[nodiscard]] std::span<const std::string_view> paper_choices();

}  // namespace isorelax::cli
