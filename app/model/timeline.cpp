#include "model/timeline.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace isorelax::model {

unsigned Timeline::longest() const {
  unsigned last = 0;
  for (const Branch& branch : branches) last = std::max(last, branch.tip());
  return last;
}

unsigned Timeline::holder(unsigned branch, unsigned iteration) const {
  while (iteration < branches[branch].start && branches[branch].parent) branch = *branches[branch].parent;
  return branch;
}

const StepSummary* Timeline::step(unsigned branch, unsigned iteration) const {
  if (empty() || iteration == 0) return nullptr;
  while (iteration <= branches[branch].start && branches[branch].parent) branch = *branches[branch].parent;
  const Branch& held = branches[branch];
  if (iteration <= held.start || iteration > held.tip()) return nullptr;
  return &held.steps[iteration - held.start - 1];
}

std::size_t Timeline::made_steps() const {
  std::size_t steps = 0;
  for (const Branch& branch : branches) steps += branch.from_file ? 0 : branch.steps.size();
  return steps;
}

std::string Timeline::numbered_name(unsigned branch) const {
  return std::to_string(branch + 1) + "  " + branches[branch].name;
}

std::vector<IterationRow> Timeline::rows(unsigned branch) const {
  std::vector<IterationRow> rows;
  const Branch& own = branches[branch];
  if (own.parent) {
    rows = this->rows(*own.parent);
    std::erase_if(rows, [&](const IterationRow& row) { return row.iteration > own.start; });
    // The same energy needs no second point at the fork.
    if (!rows.empty() && !own.rows.empty() && rows.back().series == own.rows.front().series) rows.pop_back();
  }
  rows.insert(rows.end(), own.rows.begin(), own.rows.end());
  return rows;
}

bool same_steps(const SmoothingSettings& a, const SmoothingSettings& b) {
  SmoothingSettings other = without_unused(b);
  other.iterations = a.iterations;
  other.tolerance = a.tolerance;
  other.polish = a.polish;
  return without_unused(a) == other;
}

bool same_steps(const Branch& branch, const SmoothingSettings& settings) {
  return same_steps(branch.settings, settings) &&
         (branch.kind == PartKind::solver || branch.settings.polish == settings.polish);
}

bool has_converged(const RunResult& result) {
  return result.stopped != StopReason::iterations && result.stopped != StopReason::cancelled;
}

namespace {

/// What makes other steps under the second settings, with commas between.
std::string other_settings(const SmoothingSettings& from, const SmoothingSettings& to) {
  std::string text;
  const auto add = [&](bool differs, const std::string& name) {
    if (differs) text += (text.empty() ? "" : ", ") + name;
  };
  const auto number = [](const char* format, double value) {
    std::array<char, 64> digits{};
    std::snprintf(digits.data(), digits.size(), format, value);
    return std::string(digits.data());
  };
  add(from.mu_a != to.mu_a, number("\xCE\xBC\xE2\x82\x90 %.2f", to.mu_a));
  add(from.solver != to.solver, std::string(solver_option(to.solver)));
  add(from.exponent != to.exponent, number("exponent %g", to.exponent));
  add(from.reference != to.reference || from.reference_file != to.reference_file ||
          from.edge_length != to.edge_length,
      "another reference");
  add(from.boundary != to.boundary, "another boundary rule");
  add(from.features != to.features || from.feature_deg != to.feature_deg, "other features");
  add(from.pinned != to.pinned, "other pins");
  add(from.reach != to.reach || from.max_deviation != to.max_deviation, "another distance");
  return text;
}

}  // namespace

std::string branch_name(const SmoothingSettings& settings, PartKind kind, const Branch* parent) {
  if (kind == PartKind::polish) {
    constexpr std::array<std::string_view, 4> kGoals{"none", "worst angles", "mean", "worst angles, mean"};
    return "Polish, " + std::string(kGoals.at(static_cast<std::size_t>(settings.polish)));
  }
  if (parent == nullptr || parent->settings.method != settings.method)
    return std::string(title(settings.method));
  const std::string others = other_settings(without_unused(parent->settings), without_unused(settings));
  return others.empty() ? "again" : others;
}

bool same_motion(const MotionChoices& a, const MotionChoices& b) {
  return to_words(a) == to_words(b);
}

std::string_view title(FieldKind kind) {
  constexpr std::array<std::string_view, 7> kTitles{
      "Eq. (10)", "Enright", "Rigid motion", "Shear", "Along the normal", "Expressions", "Sampled file"};
  return kTitles.at(static_cast<std::size_t>(kind));
}

std::string branch_name(const MotionChoices& motion) {
  return std::string(title(motion.field.kind)) + ", " + motion.preset;
}

std::vector<Stage> stages_of(std::size_t passes) {
  std::vector<Stage> stages{{StageKind::gradient}, {StageKind::tangent}, {StageKind::proposed}};
  for (unsigned pass = 0; pass < passes; ++pass) stages.push_back({StageKind::control, pass});
  stages.push_back({StageKind::moved});
  return stages;
}

}  // namespace isorelax::model
