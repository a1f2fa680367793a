#include "cli/motion_table.h"

#include <cmath>
#include <cstdio>

namespace isorelax::cli {
namespace {

constexpr double kFullPeriod = 3;
constexpr double kQuarterPeriod = 0.75;

MotionSetup setup_for(std::string_view preset, std::size_t vertices, double period,
                      const MotionTableOptions& options) {
  MotionSetup setup;
  setup.sphere = SphereStart{};
  setup.sphere->vertices = vertices;
  setup.sphere->radius = kMotionRadius;
  setup.start = make_sphere(*setup.sphere);
  setup.motion = parse_motion("paper");
  setup.motion.field = make_paper_field(period);
  setup.motion.period = period;
  setup.options = motion_preset(preset);
  setup.options.step = options.step;
  setup.options.threads = options.threads;
  setup.until = period;
  return setup;
}

MotionRow run_row(std::string_view preset, std::size_t vertices, double period,
                  const MotionTableOptions& options, const std::function<void(double)>& progress) {
  constexpr std::size_t kFewVertices = 12000;
  MotionRow row;
  row.preset = preset;
  row.period = period;
  row.vertices = vertices;
  MotionRun run(setup_for(preset, vertices, period, options), vertices < kFewVertices ? 2 : 1);
  std::size_t moment = 0;
  double seconds = 0;
  try {
    while (!run.done()) {
      run.advance();
      const double share = run.surface().state().time / period;
      const bool half = row.middle.step == 0 && share > 0.5 - 1e-9;
      const MotionEntry entry =
          run.measure(half || run.done() ? MotionRun::Detail::exact : MotionRun::Detail::plain);
      row.worst_volume = std::max(row.worst_volume, std::abs(entry.volume_change));
      row.least_angle_deg = std::min(row.least_angle_deg, entry.measure.min_angle_deg);
      seconds += entry.seconds;
      constexpr std::array<double, 3> kMoments = {0.25, 0.5, 1};
      if (moment < kMoments.size() && share > kMoments[moment] - 1e-9) row.meshes[moment++] = run.mesh();
      if (half) row.middle = entry;
      row.end = entry;
      progress(share);
    }
  } catch (const MotionError& error) {
    row.failure = error.what();
  }
  row.seconds_a_step = row.end.step > 0 ? seconds / static_cast<double>(row.end.step) : 0;
  return row;
}

/// A row of figures that prototypes reached before (T = 3, 11660 triangles); shares as far as they were
/// noted.
struct KnownRow {
  const char* name;
  double mean_angle_deg;
  double below_15;               ///< not noted: 1
  double error_max, error_mean;  ///< of the radius
  double volume;
};
constexpr std::array<KnownRow, 5> kKnownRows = {{
    {"pure advection", 12, 1, 4e-7, 4e-7, 0.0062},
    {"tangential, accuracy first", 15, 0.60, 0.11, 0.0009, 0.0045},
    {"tangential, balanced", 25, 0.10, 0.13, 0.0018, 0.0072},
    {"tangential, angles first", 36, 0.02, 0.22, 0.0067, 0.054},
    {"carrier", 27, 1, 0.00015, 0.00006, 0.024},
}};

std::string format_text(const char* format, double a, double b = 0, double c = 0, double d = 0,
                        double e = 0) {
  std::array<char, 256> line{};
  std::snprintf(line.data(), line.size(), format, a, b, c, d, e);
  return line.data();
}

double error_max(const MotionRow& row) {
  return row.end.error ? row.end.error->max / kMotionRadius : 1;
}
double error_mean(const MotionRow& row) {
  return row.end.error ? row.end.error->mean / kMotionRadius : 1;
}

bool beats(const MotionRow& row, const KnownRow& known) {
  const MotionMeasure& m = row.middle.measure;
  return row.failure.empty() && m.mean_angle_deg >= known.mean_angle_deg &&
         m.below_15_deg <= known.below_15 && error_max(row) <= known.error_max &&
         error_mean(row) <= known.error_mean && row.worst_volume <= known.volume;
}

MotionGoal beat_goal(const MotionTable& table, const KnownRow& known) {
  MotionGoal goal;
  goal.wanted = std::string("no worse than ") + known.name +
                format_text(" in mean angle %.0f, error %.2g / %.2g %%, volume %.2f %%", known.mean_angle_deg,
                            100 * known.error_max, 100 * known.error_mean, 100 * known.volume) +
                (known.below_15 < 1 ? format_text(", share under 15 deg %.0f %%", 100 * known.below_15) : "");
  for (const MotionRow& row : table.rows) {
    if (row.preset == "none" || !beats(row, known)) continue;
    goal.met = true;
    goal.found += (goal.found.empty() ? "" : "; ") + row.preset +
                  format_text(" %.1f, %.2g / %.2g %%, %.3f %%, %.1f %%", row.middle.measure.mean_angle_deg,
                              100 * error_max(row), 100 * error_mean(row), 100 * row.worst_volume,
                              100 * row.middle.measure.below_15_deg);
  }
  if (!goal.met) goal.found = "no preset; the nearest stand in the table";
  return goal;
}

MotionGoal exact_goal(const MotionTable& table) {
  MotionGoal goal;
  goal.wanted = "mean angle 25 at mid-time with error under 2 % / 0.1 % and |dV| under 0.5 % throughout";
  for (const MotionRow& row : table.rows) {
    if (!row.failure.empty() || row.middle.measure.mean_angle_deg < 25 || error_max(row) >= 0.02 ||
        error_mean(row) >= 0.001 || row.worst_volume >= 0.005)
      continue;
    goal.met = true;
    goal.found += (goal.found.empty() ? "" : "; ") + row.preset +
                  format_text(" %.1f, %.2g / %.2g %%, %.3f %%", row.middle.measure.mean_angle_deg,
                              100 * error_max(row), 100 * error_mean(row), 100 * row.worst_volume);
  }
  if (!goal.met) goal.found = "no preset";
  return goal;
}

MotionGoal fold_goal(const MotionTable& table) {
  MotionGoal goal{"no folded edge at the end, carrier presets", "", true};
  for (const MotionRow& row : table.rows) {
    if (row.preset == "none" || row.preset == "paper") continue;
    goal.met = goal.met && row.failure.empty() && row.end.measure.folded_edges == 0;
    goal.found +=
        (goal.found.empty() ? "" : ", ") + row.preset + " " + std::to_string(row.end.measure.folded_edges);
  }
  return goal;
}

MotionGoal quarter_goal(const MotionTable& table) {
  MotionGoal goal;
  goal.wanted = "a quarter of the deformation: min angle 15, mean 38, area ratio 20, |dV| 0.2 %, error 0.5 %";
  for (const MotionRow& row : table.quarter) {
    const MotionMeasure& m = row.middle.measure;
    const std::string figures =
        row.preset + format_text(" %.1f, %.1f, %.1f, %.3f %%, %.2g %%", m.min_angle_deg, m.mean_angle_deg,
                                 m.area_max_over_min, 100 * row.worst_volume, 100 * error_max(row));
    if (!row.failure.empty() || m.min_angle_deg < 15 || m.mean_angle_deg < 38 || m.area_max_over_min > 20 ||
        row.worst_volume > 0.002 || error_max(row) > 0.005)
      continue;
    goal.met = true;
    goal.found += (goal.found.empty() ? "" : "; ") + figures;
  }
  if (!goal.met) goal.found = "no preset";
  return goal;
}

}  // namespace

MotionTable compute_motion_table(const MotionTableOptions& options,
                                 const std::function<void(double, std::string_view)>& progress) {
  constexpr std::array<const char*, 5> kPresets = {"none", "paper", "accuracy", "balanced", "angles"};
  MotionTable table;
  table.options = options;
  double total = 0;
  for (const double period : {kFullPeriod, kQuarterPeriod})
    total += kPresets.size() * period * static_cast<double>(options.vertices);
  for (const std::size_t size : options.convergence) total += kQuarterPeriod * static_cast<double>(size);
  double done = 0;
  const auto add = [&](std::vector<MotionRow>& rows, const char* preset, std::size_t vertices,
                       double period) {
    const double work = period * static_cast<double>(vertices);
    const std::string name = std::string(preset) + ", " + std::to_string(vertices) + " vertices";
    rows.push_back(run_row(preset, vertices, period, options,
                           [&](double share) { progress((done + share * work) / total, name); }));
    done += work;
  };
  for (const char* preset : kPresets) add(table.rows, preset, options.vertices, kFullPeriod);
  for (const char* preset : kPresets) add(table.quarter, preset, options.vertices, kQuarterPeriod);
  for (const std::size_t size : options.convergence) add(table.convergence, "balanced", size, kQuarterPeriod);
  return table;
}

std::vector<MotionGoal> motion_goals(const MotionTable& table) {
  std::vector<MotionGoal> goals;
  goals.reserve(kKnownRows.size() + 3);
  for (const KnownRow& known : kKnownRows) goals.push_back(beat_goal(table, known));
  goals.push_back(exact_goal(table));
  goals.push_back(fold_goal(table));
  goals.push_back(quarter_goal(table));
  return goals;
}

}  // namespace isorelax::cli
