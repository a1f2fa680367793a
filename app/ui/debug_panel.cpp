#include <algorithm>
#include <array>
#include <utility>

#include "trace/predicate_names.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

constexpr std::array<std::string_view, 8> kReasonTips{
    "Held by you, or because the mesh is flawed there.",
    "Corners: they have no direction to move in.",
    "On a ridge: along it only.",
    "On the border: held there, or guided along it.",
    "Cut back because a triangle would have folded or become too sharp.",
    "Cut back because the energy would have risen.",
    "Held near the surface as it was.",
    "They ask for no move worth making.",
};

void draw_reason(const Ui& ui, unsigned bit, std::size_t count, std::size_t vertices) {
  const Limit limit = limit_of_bit(bit);
  const std::string name = "reason/" + std::string(limit_name(limit));
  const bool chosen = ui.session.selected_limit == bit;
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  if (button(ui, name, "",
             {.look = chosen ? ButtonLook::pressed : ButtonLook::quiet,
              .width = width,
              .height = ui.px(24),
              .enabled = count > 0 && !ui.session.timeline.empty()}))
    ui.command(model::SelectLimited{chosen ? std::nullopt : std::optional(bit)});
  tooltip(ui, kReasonTips.at(bit), count > 0 ? "Click to mark only these" : "");
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 ink = count > 0 ? color::kText : color::kTextFaint;
  const float y = low.y + 0.5F * (ui.px(24) - ImGui::GetTextLineHeight());
  draw.AddCircleFilled({low.x + ui.px(10), low.y + ui.px(12)}, ui.px(5),
                       faded(color::kLimits[bit], count > 0 ? 1.0F : 0.35F));
  const std::string label(limit_name(limit));
  draw.AddText({low.x + ui.px(24), y}, ink, label.c_str());
  const float share = vertices > 0 ? static_cast<float>(count) / static_cast<float>(vertices) : 0;
  // As long as the longest name leaves it.
  const float names = ui.px(24 + 8) + text_width(*ImGui::GetFont(), limit_name(kLimitConverged));
  const float bar = std::clamp(width - ui.px(80) - names, 0.0F, ui.px(90));
  const float x = low.x + width - ui.px(80) - bar;
  draw.AddRectFilled({x, low.y + ui.px(10)}, {x + bar, low.y + ui.px(14)}, color::kControl, ui.px(2));
  if (count > 0 && bar > 0)
    draw.AddRectFilled({x, low.y + ui.px(10)}, {x + std::max(ui.px(2), bar * share), low.y + ui.px(14)},
                       color::kLimits[bit], ui.px(2));
  const std::string text = count_text(count);
  draw.AddText({low.x + width - ui.px(8) - ImGui::CalcTextSize(text.c_str()).x, y}, ink, text.c_str());
}

void draw_reasons(const Ui& ui) {
  heading(ui, "WHAT LIMITED THE VERTICES");
  const model::Session& s = ui.session;
  if (s.moving() != nullptr) {
    wrapped(ui.fonts.text, color::kTextDim,
            "This is known of a smoother's steps only: the vertices of a moving surface go with the motion.");
    return;
  }
  if (!s.last_step) {
    wrapped(ui.fonts.text, color::kTextDim, "Make a step: then this counts what kept vertices from moving.");
  } else {
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, ui.px(1)});
    for (unsigned bit = 0; bit < kLimitBits; ++bit)
      draw_reason(ui, bit, s.last_step->limits[bit], s.last_step->vertices);
    ImGui::PopStyleVar();
  }
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(3), ui.px(3)});
  bool shown = s.view.reasons;
  if (ImGui::Checkbox("Show them on the mesh", &shown)) perform(ui, Action::reasons);
  mark(ui, "reasons");
  ImGui::PopStyleVar();
  tooltip(ui, "A dot in these colours on every limited vertex.", keys_of(Action::reasons));
}

// Says so where the program itself is at fault.
void draw_check(const Ui& ui) {
  const auto& check = ui.session.inspection.check;
  if (!check) return;
  heading(ui, "GRADIENTS");
  if (check->wrong == 0) {
    wrapped(ui.fonts.text, color::kBetter, "All agree with the plain formulas.");
  } else {
    wrapped(ui.fonts.text, color::kWorse,
            count_text(check->wrong) + (check->wrong == 1 ? " vertex has" : " vertices have") +
                " another gradient than the plain formulas give: a fault in the program.");
    if (link(ui, "worst-gradient", "Go to vertex " + std::to_string(check->worst))) {
      ui.command(model::SelectVertex{check->worst});
      ui.request(FlyToSelection{});
      ui.state.tab = SideTab::inspect;
    }
  }
  mark_area(ui, "gradient-check", {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
}

void change_breakpoint(const Ui& ui, const std::function<void(std::vector<model::Breakpoint>&)>& change) {
  std::vector<model::Breakpoint> all = ui.session.breakpoints;
  change(all);
  ui.command(model::SetBreakpoints{std::move(all)});
}

void draw_breakpoint(const Ui& ui, std::size_t k) {
  const model::Breakpoint& point = ui.session.breakpoints[k];
  const std::string name = "break/" + std::to_string(k);
  ImGui::PushID(static_cast<int>(k));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(3), ui.px(3)});
  bool enabled = point.enabled;
  if (ImGui::Checkbox("##on", &enabled)) change_breakpoint(ui, [&](auto& all) { all[k].enabled = enabled; });
  mark(ui, name + "/on");
  ImGui::PopStyleVar();
  ImGui::SameLine(0, ui.px(8));
  text_in(ui.fonts.text, enabled ? color::kText : color::kTextFaint, point.text);
  mark_area(ui, name, {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
  const bool logs = point.action == model::BreakAction::log;
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ui.px(78));
  if (small_button(ui, name + "/action", logs ? "Log" : "Stop",
                   {.look = logs ? ButtonLook::plain : ButtonLook::pressed, .width = ui.px(48)}))
    change_breakpoint(
        ui, [&](auto& all) { all[k].action = logs ? model::BreakAction::stop : model::BreakAction::log; });
  tooltip(ui,
          logs ? "It only tells. Click: the run stops there." : "The run stops there. Click: it only tells.");
  ImGui::SameLine(0, ui.px(4));
  if (button(ui, name + "/remove", "",
             {.icon = Icon::close, .look = ButtonLook::quiet, .width = ui.px(24), .height = ui.px(24)}))
    change_breakpoint(ui, [&](auto& all) { all.erase(all.begin() + static_cast<std::ptrdiff_t>(k)); });
  tooltip(ui, "Remove it.");
  ImGui::PopID();
}

void draw_new_breakpoint(const Ui& ui) {
  Typing& typing = ui.state.typing;
  std::array<char, 256> buffer{};
  typing.predicate.copy(buffer.data(), buffer.size() - 1);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - ui.px(62));
  // What was refused is still typed at; else the next letters would be shortcuts.
  if (std::exchange(typing.refused, false)) ImGui::SetKeyboardFocusHere();
  const bool entered = ImGui::InputTextWithHint("##predicate", "min_angle < 5", buffer.data(), buffer.size(),
                                                ImGuiInputTextFlags_EnterReturnsTrue);
  typing.predicate = buffer.data();
  mark(ui, "predicate");
  tooltip(ui, "A condition on the iterations, then Enter.");
  ImGui::SameLine(0, ui.px(6));
  const bool added =
      button(ui, "add-break", "Add", {.width = ui.px(56), .enabled = !typing.predicate.empty()});
  if (typing.predicate.empty()) return;
  const model::Breakpoint made = model::make_breakpoint(typing.predicate, model::BreakAction::stop);
  if (!made.predicate) {
    draw_mistake(ui, made.text, made.mistake_column, made.mistake);
    mark_area(ui, "mistake", {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
    typing.refused = entered || added;
    return;
  }
  if (!entered && !added) return;
  change_breakpoint(ui, [&](auto& all) { all.push_back(made); });
  typing.predicate.clear();
}

void draw_word(const Ui& ui, const std::string& word, std::string_view meaning) {
  text_in(ui.fonts.small, color::kText, word);
  ImGui::SameLine(ui.px(118));
  wrapped(ui.fonts.small, color::kTextDim, meaning);
}

void draw_breakpoints(const Ui& ui) {
  heading(ui, "BREAKPOINTS");
  for (std::size_t k = 0; k < ui.session.breakpoints.size(); ++k) draw_breakpoint(ui, k);
  draw_new_breakpoint(ui);
  if (ImGui::TreeNodeEx("words", ImGuiTreeNodeFlags_NoTreePushOnOpen, "All words")) {
    for (const PredicateName& word : predicate_names()) draw_word(ui, std::string(word.name), word.meaning);
    for (const PredicateField& word : vertex_fields())
      draw_word(ui, "vertex(ID)." + std::string(word.name), word.meaning);
    for (const PredicateField& word : triangle_fields())
      draw_word(ui, "triangle(ID)." + std::string(word.name), word.meaning);
    wrapped(ui.fonts.small, color::kTextFaint,
            "and numbers, + - * /, < <= > >= == !=, ! && || and parentheses");
  }
  mark(ui, "words");
}

void draw_log(const Ui& ui) {
  const auto& hits = ui.session.hits;
  if (hits.empty()) return;
  heading(ui, "WHERE THEY HELD");
  constexpr std::size_t kMost = 40;
  std::size_t shown = 0;
  for (auto hit = hits.rbegin(); hit != hits.rend() && shown < kMost; ++hit, ++shown) {
    const std::string name = "hit/" + std::to_string(shown);
    if (link(ui, name, "iteration " + std::to_string(hit->iteration)))
      ui.command(model::Seek{hit->iteration, hit->branch});
    tooltip(ui, "Go there.");
    ImGui::SameLine(ui.px(110));
    text_in(ui.fonts.text, hit->action == model::BreakAction::stop ? color::kWorse : color::kTextDim,
            hit->text);
  }
  if (hits.size() > kMost)
    text_in(ui.fonts.small, color::kTextFaint, "and " + count_text(hits.size() - kMost) + " before");
}

}  // namespace

void draw_debug(const Ui& ui) {
  const std::string ended = ui.session.is_running() ? std::string() : describe_last_run(ui.session);
  if (!ended.empty()) {
    heading(ui, "THE LAST RUN");
    wrapped(ui.fonts.text, color::kText, ended);
    mark_area(ui, "ended", {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
  }
  draw_reasons(ui);
  draw_check(ui);
  draw_breakpoints(ui);
  draw_log(ui);
}

}  // namespace isorelax::ui
