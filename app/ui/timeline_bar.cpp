#include <algorithm>
#include <array>
#include <cmath>

#include "ui/panels.h"
#include "ui/plot.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

using model::Timeline;

ImU32 branch_color(std::size_t branch) {
  return color::kBranches[branch % std::size(color::kBranches)];
}

struct Transport {
  std::string_view name, tip;
  Icon icon;
  Action action;
  bool on = false;
  bool enabled = true;
};

constexpr float kRoomForSpeed = 360;  // width of the timeline, in points
constexpr float kRunButton = 40;

// What the settings have where they are not seen.
void draw_run(const Ui& ui) {
  const bool running = ui.session.is_running();
  if (button(ui, "transport-run", "",
             {.icon = running ? Icon::pause : Icon::run,
              .look = ButtonLook::accent,
              .width = ui.px(kRunButton - 6),
              .height = ui.px(26),
              .enabled = running || ui.session.can_smooth()}))
    perform(ui, Action::run_pause);
  tooltip(ui, running ? "Stop after this step." : "Run, as the settings say.", keys_of(Action::run_pause));
  ImGui::SameLine(0, ui.px(6));
}

void draw_transport(const Ui& ui, bool with_speed) {
  const Playing& playing = ui.state.playing;
  const bool recorded = !ui.session.timeline.empty();
  const bool forward = playing.direction > 0;
  const std::array<Transport, 6> kButtons{{
      {"to-start", "To the mesh as opened.", Icon::to_start, Action::to_start, false, recorded},
      {"play-back", "Play backwards.", playing.direction < 0 ? Icon::pause : Icon::run_back,
       Action::play_backward, playing.direction < 0, recorded},
      {"back", "One iteration back.", Icon::step_back, Action::step_back, false, recorded},
      {"on", "One iteration on: the recorded one, or a new one at the end.", Icon::step, Action::step, false,
       ui.session.can_smooth()},
      {"play", "Play.", forward ? Icon::pause : Icon::run, Action::play_forward, forward, recorded},
      {"to-end", "To the last iteration.", Icon::to_end, Action::to_end, false, recorded},
  }};
  for (const Transport& t : kButtons) {
    if (button(ui, t.name, "",
               {.icon = t.icon,
                .look = t.on ? ButtonLook::pressed : ButtonLook::quiet,
                .width = ui.px(28),
                .height = ui.px(26),
                .enabled = t.enabled}))
      perform(ui, t.action);
    tooltip(ui, t.tip, keys_of(t.action));
    ImGui::SameLine(0, ui.px(1));
  }
  if (!with_speed) return;
  const auto speed = static_cast<std::size_t>(playing.speed);
  ImGui::SameLine(0, ui.px(5));
  const std::string label = number_text("%.0f", kPlaySpeeds.at(speed)) + "/s";
  if (small_button(ui, "speed", label, {.width = ui.px(44), .height = ui.px(26)}))
    ui.state.playing.speed = static_cast<int>((speed + 1) % kPlaySpeeds.size());
  tooltip(ui, "Iterations per second when playing: the next speed.");
}

std::string motion_caption(const model::Session& s, const model::Branch& branch) {
  std::string text = "Step " + std::to_string(s.timeline.cursor.iteration - branch.start) + " of " +
                     std::to_string(branch.steps.size()) +
                     "   \xC2\xB7   t = " + number_text("%.4g", s.moment().time) + " of " +
                     number_text("%.4g", branch.until) + "   \xC2\xB7   " + branch.name;
  if (s.is_running()) return text;
  if (s.is_seeking()) return text + "   \xC2\xB7   going there";
  if (s.task == model::Task::move && !s.continues_branch())
    text += "   \xC2\xB7   Run begins another motion at t = 0";
  return text;
}

std::string caption(const model::Session& s) {
  const Timeline& timeline = s.timeline;
  if (timeline.empty()) return "Nothing has been run yet: Space runs, Right makes one step.";
  if (const model::Branch* branch = s.moving()) return motion_caption(s, *branch);
  if (s.shared_iteration() > timeline.cursor.iteration)
    return "Iteration " + std::to_string(s.shared_iteration()) + "   \xC2\xB7   " + timeline.current()->name +
           " ended at " + std::to_string(timeline.cursor.iteration);
  std::string text = "Iteration " + std::to_string(timeline.cursor.iteration) + " of " +
                     std::to_string(timeline.last()) + "   \xC2\xB7   " + timeline.current()->name;
  const model::StepSummary* step = timeline.step(timeline.cursor.branch, timeline.cursor.iteration);
  if (step != nullptr && step->kind != StepKind::unknown)
    text += "   \xC2\xB7   step: " + std::string(step_kind_name(step->kind));
  if (s.is_running()) return text;
  if (s.is_seeking()) return text + "   \xC2\xB7   going there";
  if (!s.continues_branch()) text += "   \xC2\xB7   Run begins a branch here";
  return text;
}

// From iterations to pixels.
struct Track {
  Rect area;
  unsigned last = 1;

  [[nodiscard]] float x(double iteration) const {
    return area.low.x + static_cast<float>(iteration / last) * area.width();
  }
  [[nodiscard]] unsigned iteration(float at) const {
    const float share = std::clamp((at - area.low.x) / area.width(), 0.0F, 1.0F);
    return static_cast<unsigned>(std::lround(share * static_cast<float>(last)));
  }
};

void draw_curve(const Track& track, const std::vector<model::IterationRow>& rows,
                double model::IterationRow::*field, ImU32 ink, float width) {
  if (rows.size() < 2) return;
  const auto [low, high] = std::ranges::minmax(rows, {}, field);
  const double span = high.*field - low.*field;
  if (!(span > 0) || !std::isfinite(span)) return;
  std::vector<ImVec2> piece;
  const auto flush = [&] {
    ImGui::GetWindowDrawList()->AddPolyline(piece.data(), static_cast<int>(piece.size()), ink,
                                            ImDrawFlags_None, width);
    piece.clear();
  };
  for (std::size_t k = 0; k < rows.size(); ++k) {
    // Energies of other settings are no continuation.
    if (k > 0 && rows[k].series != rows[k - 1].series) flush();
    const double share = (rows[k].*field - low.*field) / span;
    piece.emplace_back(track.x(rows[k].iteration),
                       track.area.high.y - static_cast<float>(0.1 + 0.8 * share) * track.area.height());
  }
  flush();
}

// One bar for each branch, from where it began to where it ends.
void draw_lanes(const Ui& ui, const Track& track) {
  const auto& branches = ui.session.timeline.branches;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float each = std::min(ui.px(7), track.area.height() / static_cast<float>(branches.size()));
  for (std::size_t k = 0; k < branches.size(); ++k) {
    const float y = track.area.low.y + each * static_cast<float>(k);
    const bool present = k == ui.session.timeline.cursor.branch;
    const ImU32 ink = faded(branch_color(k), present ? 1.0F : 0.4F);
    const Rect lane{{track.x(branches[k].start), y + 1}, {track.x(branches[k].tip()), y + each - 1}};
    draw.AddRectFilled(lane.low, {std::max(lane.high.x, lane.low.x + 2), lane.high.y}, ink, ui.px(1.5F));
    mark_area(ui, "lane/" + std::to_string(k), lane);
  }
}

void draw_hits(const Ui& ui, const Track& track) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (const model::BreakHit& hit : ui.session.hits) {
    if (hit.branch != ui.session.timeline.cursor.branch) continue;
    const ImU32 ink = hit.action == model::BreakAction::stop ? color::kWorse : color::kWarning;
    draw.AddCircleFilled({track.x(hit.iteration), track.area.high.y - ui.px(4)}, ui.px(3), ink);
  }
}

void draw_cursor(const Ui& ui, const Track& track) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float x = std::floor(track.x(ui.session.shared_iteration())) + 0.5F;
  const float top = track.area.low.y - ui.px(3);
  draw.AddLine({x, top}, {x, track.area.high.y}, color::kText, ui.px(1.5F));
  draw.AddTriangleFilled({x - ui.px(5), top - ui.px(3)}, {x + ui.px(5), top - ui.px(3)}, {x, top + ui.px(4)},
                         color::kText);
}

// The time of an iteration of the moving surface that is shown.
std::optional<double> time_at(const model::Session& s, double iteration) {
  const model::Branch* branch = s.moving();
  if (branch == nullptr || iteration < branch->start) return std::nullopt;
  const auto k = static_cast<std::size_t>(iteration - branch->start);
  if (k >= branch->moments.size()) return std::nullopt;
  return branch->moments[k].time;
}

// Clicks and drags; a press on another branch' bar goes over to it.
void scrub(const Ui& ui, const Track& track) {
  const model::Session& s = ui.session;
  if (s.timeline.empty()) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const unsigned at = track.iteration(mouse.x);
  if (ImGui::IsItemActivated()) {
    ui.state.playing.direction = 0;
    for (std::size_t k = 0; k < s.timeline.branches.size(); ++k) {
      const Rect& lane = ui.state.rects.find("lane/" + std::to_string(k))->second;
      const bool inside = mouse.y >= lane.low.y && mouse.y < lane.high.y && mouse.x >= lane.low.x - 3 &&
                          mouse.x <= lane.high.x + 3;
      if (inside && k != s.timeline.cursor.branch) {
        ui.command(model::Seek{at, static_cast<unsigned>(k)});
        return;
      }
    }
  }
  if (ImGui::IsItemActive() && std::min(at, s.shared_last()) != s.shared_iteration())
    ui.command(model::Seek{at, {}});
  if (!ImGui::IsItemHovered()) return;
  const auto& rows = s.history;
  const auto row = std::ranges::find(rows, at, &model::IterationRow::iteration);
  std::string text = "Iteration " + std::to_string(at);
  if (const auto time = time_at(s, at)) text += "\nt = " + number_text("%.6g", *time);
  if (row != rows.end())
    text += "\nEnergy " + number_text("%.6g", row->energy) + "\nSmallest angle " +
            number_text("%.2f", row->min_angle_deg) + "\xC2\xB0";
  const model::StepSummary* step = s.timeline.step(s.timeline.cursor.branch, at);
  if (step != nullptr && step->kind != StepKind::unknown)
    text += "\nStep: " + std::string(step_kind_name(step->kind));
  for (const model::BreakHit& hit : s.hits)
    if (hit.iteration == at && hit.branch == s.timeline.cursor.branch) text += "\n" + hit.text;
  ImGui::BeginTooltip();
  text_in(ui.fonts.small, color::kText, text);
  ImGui::EndTooltip();
}

void draw_ticks(const Ui& ui, const Track& track) {
  const model::Session& s = ui.session;
  const Rect& area = track.area;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float line = ui.fonts.small->FontSize;
  float free = area.low.x;
  for (const double t : round_ticks(0, track.last, s.moving() != nullptr ? 5 : 8)) {
    if (t != std::floor(t)) continue;
    std::string text = number_text("%.0f", t);
    if (const auto time = time_at(s, t)) text += "  (t " + number_text("%.3g", *time) + ")";
    const float width = ui.fonts.small->CalcTextSizeA(line, 1e9F, 0, text.c_str()).x;
    draw.AddLine({track.x(t), area.high.y}, {track.x(t), area.high.y + ui.px(3)}, color::kLine);
    const float x =
        std::floor(std::min(std::max(track.x(t) - 0.5F * width, area.low.x), area.high.x - width));
    if (x < free) continue;
    free = x + width + ui.px(6);
    draw.AddText(ui.fonts.small, line, {x, area.high.y + ui.px(3)}, color::kTextFaint, text.c_str());
  }
}

void draw_track(const Ui& ui, const Rect& area, bool with_ticks) {
  const model::Session& s = ui.session;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const Track track{area, std::max(1U, s.timeline.longest())};
  draw.AddRectFilled(area.low, area.high, color::kBackdrop, ui.px(4));
  ImGui::SetCursorScreenPos({area.low.x - ui.px(6), area.low.y - ui.px(6)});
  ImGui::InvisibleButton("track", {area.width() + ui.px(12), area.height() + ui.px(10)});
  mark_area(ui, "track", area);
  if (s.timeline.empty()) return;
  draw_curve(track, s.history, &model::IterationRow::energy, faded(color::kAccent, 0.55F), ui.px(1.25F));
  draw_curve(track, s.history, &model::IterationRow::min_angle_deg, faded(color::kSecond, 0.55F),
             ui.px(1.25F));
  draw_lanes(ui, track);
  draw_hits(ui, track);
  draw_cursor(ui, track);
  if (with_ticks) draw_ticks(ui, track);
  scrub(ui, track);
}

// What the two curves behind the track are.
constexpr std::array<std::pair<std::string_view, ImU32>, 2> kCurves{
    {{"smallest angle", color::kSecond}, {"energy", color::kAccent}}};

float curve_key_width(const Ui& ui) {
  float width = 0;
  for (const auto& [label, ink] : kCurves) width += text_width(*ui.fonts.small, label) + ui.px(28);
  return width;
}

void draw_curve_key(const Ui& ui, float right, float y) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float line = ui.fonts.small->FontSize;
  for (const auto& [label, ink] : kCurves) {
    right -= text_width(*ui.fonts.small, label);
    draw.AddText(ui.fonts.small, line, {std::floor(right), y}, color::kTextFaint, label.data(),
                 label.data() + label.size());
    right -= ui.px(16);
    draw.AddLine({right, y + 0.55F * line}, {right + ui.px(11), y + 0.55F * line}, ink, ui.px(1.5F));
    right -= ui.px(12);
  }
}

// What is shown in words, what the curves are, and the track with its numbers.
void draw_captioned_track(const Ui& ui, const Rect& rect) {
  const float line = ui.fonts.small->FontSize;
  const float top = rect.low.y + ui.px(41);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float room = rect.width() - 2 * ui.px(14);
  const std::string text = fitted(*ui.fonts.small, caption(ui.session), room);
  draw.AddText(ui.fonts.small, line, {rect.low.x + ui.px(14), top}, color::kTextDim, text.c_str());
  const float left = room - text_width(*ui.fonts.small, text);
  if (!ui.session.timeline.empty() && curve_key_width(ui) <= left)
    draw_curve_key(ui, rect.high.x - ui.px(14), top);
  draw_track(ui,
             {{rect.low.x + ui.px(16), top + line + ui.px(8)},
              {rect.high.x - ui.px(16), rect.high.y - line - ui.px(6)}},
             true);
}

}  // namespace

void draw_timeline(const Ui& ui, const Rect& rect, bool folded) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(14), ui.px(8)});
  begin_panel("timeline", rect, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  if (folded) draw_run(ui);
  draw_transport(ui, rect.width() >= ui.px(folded ? kRoomForSpeed + kRunButton : kRoomForSpeed));
  // Steps of a moving surface have no stages.
  if (!ui.session.timeline.empty() && ui.session.moving() == nullptr)
    draw_stages(ui, rect.width() - ui.px(14));
  const bool low = rect.height() < ui.px(size::kTimeline);
  if (low) {
    draw_track(
        ui,
        {{rect.low.x + ui.px(16), rect.low.y + ui.px(45)}, {rect.high.x - ui.px(16), rect.high.y - ui.px(6)}},
        false);
  } else {
    draw_captioned_track(ui, rect);
  }
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddLine(rect.low, {rect.high.x, rect.low.y}, color::kLine);
  mark_area(ui, "timeline", rect);
  ImGui::End();
  ImGui::PopStyleVar();
}

void play(const Ui& ui, float seconds) {
  Playing& playing = ui.state.playing;
  const model::Session& s = ui.session;
  if (playing.direction == 0) return;
  if (s.timeline.empty() || s.is_running()) {
    playing.direction = 0;
    return;
  }
  if (s.is_seeking()) return;  // an iteration is shown before the next one is asked for
  playing.due += seconds * kPlaySpeeds.at(static_cast<std::size_t>(playing.speed));
  const auto steps = static_cast<unsigned>(playing.due);
  if (steps == 0) return;
  playing.due -= static_cast<float>(steps);
  const unsigned at = s.shared_iteration();
  const unsigned last = s.shared_last();
  const unsigned left = playing.direction > 0 ? last - std::min(at, last) : at;
  if (left == 0) {
    playing = {0, playing.speed, 0};
    return;
  }
  const unsigned go = std::min(steps, left);
  ui.command(model::Seek{playing.direction > 0 ? at + go : at - go, {}});
}

}  // namespace isorelax::ui
