#include <algorithm>
#include <array>
#include <charconv>

#include "ui/inspector_parts.h"
#include "ui/motion_panel.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

constexpr std::array<std::string_view, kStepKinds> kStepTips{
    "",
    "The paper's step: along the gradient, by as much as the size of the triangles allows.",
    "Newton's step of each vertex: the gradient through the inverse of its own block of second derivatives.",
    "A step of all vertices together, by what the steps before tell of how gradients change (L-BFGS).",
    "Twenty sweeps to the means of the neighbours: it does not follow the gradient, and nothing moves where "
    "the energy would rise.",
    "One vertex after the other, each downhill from where those before it are by then: where many are at the "
    "limit of the distance.",
    "Laplacian smoothing: to the mean of the neighbours. It does not follow the gradient.",
    "Angle-based smoothing: to where the angles about the vertex are alike. It does not follow the gradient.",
    "Of the polish: it raises the smallest angles and lowers the largest, not the energy.",
    "Of the polish: it raises the mean of the triangles' smallest angles, not the energy.",
};

// A field for text with a hint; true when Enter ends it.
bool text_field(const Ui& ui, const char* name, const char* hint, std::string& text, float width) {
  std::array<char, 256> buffer{};
  text.copy(buffer.data(), buffer.size() - 1);
  ImGui::SetNextItemWidth(width);
  const std::string id = "##" + std::string(name);
  const bool entered = ImGui::InputTextWithHint(id.c_str(), hint, buffer.data(), buffer.size(),
                                                ImGuiInputTextFlags_EnterReturnsTrue);
  text = buffer.data();
  mark(ui, name);
  return entered;
}

void go_to_typed(const Ui& ui) {
  const std::string& text = ui.state.typing.id;
  Index id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
  if (error != std::errc() || end != text.data() + text.size()) {
    ui.command(
        model::Say{{model::MessageKind::info, "\"" + text + "\" is no number of a vertex or triangle."}});
    return;
  }
  if (ui.state.typing.triangle)
    ui.command(model::SelectTriangle{id});
  else
    ui.command(model::SelectVertex{id});
  ui.request(FlyToSelection{});
}

void draw_choice(const Ui& ui) {
  constexpr std::array<std::string_view, 2> kWhat{"Vertex", "Triangle"};
  Typing& typing = ui.state.typing;
  const model::Session& s = ui.session;
  if (typing.selected_vertex != s.selected_vertex || typing.selected_triangle != s.selected_triangle) {
    if (s.selected_triangle || s.selected_vertex) typing.triangle = s.selected_triangle.has_value();
    typing.selected_vertex = s.selected_vertex;
    typing.selected_triangle = s.selected_triangle;
  }
  const float width = ImGui::GetContentRegionAvail().x;
  const int choice = segmented(ui, "inspect-what", kWhat, typing.triangle ? 1 : 0, 0.52F * width);
  if (choice >= 0) typing.triangle = choice == 1;
  ImGui::SameLine(0, ui.px(8));
  if (text_field(ui, "inspect-id", "number", typing.id, ImGui::GetContentRegionAvail().x)) go_to_typed(ui);
  tooltip(ui, "Type the number of a vertex or triangle, from 0, and press Enter.");

  std::array<std::string_view, model::kWorstBy> labels;
  for (std::size_t k = 0; k < labels.size(); ++k) labels[k] = model::title(static_cast<model::WorstBy>(k));
  const float button = ui.px(104);
  if (small_button(ui, "next-worst", "Next worst  N", {.width = button, .height = ui.px(size::kControl)}))
    perform(ui, Action::next_worst);
  tooltip(ui, "Fly to the next worst triangle.", keys_of(Action::next_worst));
  ImGui::SameLine(0, ui.px(8));
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
  const int by = combo(ui, "worst-by", labels, static_cast<int>(ui.session.worst_by));
  tooltip(ui, "What worst means.");
  if (by >= 0) ui.command(model::SetWorstBy{static_cast<model::WorstBy>(by)});
}

// The step that the numbers are of.
std::string step_text(const model::Session& s) {
  const unsigned k = s.timeline.cursor.iteration;
  if (k > 0) return "The step to iteration " + std::to_string(k);
  return s.timeline.empty() ? "The step that would be the first" : "The first step";
}

// What made it; the pointer on it tells more.
void draw_step_line(const Ui& ui, const std::string& rest) {
  const auto& step = ui.session.inspection.step;
  const StepKind kind = step ? step->record->kind : StepKind::unknown;
  std::string text = step_text(ui.session);
  if (kind != StepKind::unknown) text += "   \xC2\xB7   " + std::string(step_kind_name(kind));
  text_in(ui.fonts.small, color::kTextFaint, text + rest);
  tooltip(ui, kStepTips.at(static_cast<std::size_t>(kind)));
}

void draw_title(const Ui& ui, const std::string& text) {
  ImGui::Dummy({0, ui.px(2)});
  text_in(ui.fonts.title, color::kText, text);
  mark_area(ui, "inspected", {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
}

void draw_vertex(const Ui& ui, Index vertex) {
  const model::Session& s = ui.session;
  draw_title(ui, "Vertex " + std::to_string(vertex));
  const bool pinned = std::ranges::binary_search(s.smoothing.pinned, vertex);
  const float pin = ui.px(60);
  ImGui::SameLine(ImGui::GetContentRegionMax().x - pin - ui.px(56));
  if (small_button(ui, "fly", "Fly", {.width = ui.px(50)})) ui.request(FlyToSelection{});
  tooltip(ui, "Take the camera there.");
  ImGui::SameLine(0, ui.px(6));
  if (small_button(ui, "pin", pinned ? "Unpin" : "Pin",
                   {.look = pinned ? ButtonLook::pressed : ButtonLook::plain,
                    .width = pin,
                    .enabled = !s.is_running()}))
    perform(ui, Action::pin);
  tooltip(ui, "Hold it in later runs, or let it go.", keys_of(Action::pin));
  const auto& e = s.inspection.vertex;
  if (!e || e->vertex != vertex) {
    text_in(ui.fonts.text, color::kTextFaint,
            s.is_running() ? "Pause the run to look into its step." : "...");
    return;
  }
  draw_step_line(ui, "");
  wrapped(ui.fonts.text, color::kText, why_sentence(*e));
  if (e->share_error >= kShareErrorLimit || e->quotient_error >= kQuotientErrorLimit)
    wrapped(ui.fonts.text, color::kWorse,
            "Its gradient is not that of the energy: a fault in the program. See Gradient below.");
  mark_area(ui, "why", {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
  ImGui::Dummy({0, ui.px(2)});
  draw_ring(ui, *e, ui.px(190));
  draw_move_section(ui, *e);
  draw_gradient_section(ui, *e);
  draw_class_section(ui, *e);
  draw_path_section(ui);
}

void draw_triangle(const Ui& ui, Index triangle) {
  const model::Session& s = ui.session;
  draw_title(ui, "Triangle " + std::to_string(triangle));
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ui.px(50));
  if (small_button(ui, "fly", "Fly", {.width = ui.px(50)})) ui.request(FlyToSelection{});
  tooltip(ui, "Take the camera there.");
  const auto& e = s.inspection.triangle;
  if (!e || e->triangle != triangle) {
    text_in(ui.fonts.text, color::kTextFaint,
            s.is_running() ? "Pause the run to look into its step." : "...");
    return;
  }
  const std::string rank =
      s.rank_of_worst() > 0 ? "   \xC2\xB7   worst no. " + std::to_string(s.rank_of_worst()) : std::string();
  draw_step_line(ui, rank);
  wrapped(ui.fonts.text, color::kText, triangle_sentence(*e));
  ImGui::Dummy({0, ui.px(2)});
  draw_triangles(ui, *e, ui.px(150));
  draw_triangle_sections(ui, *e);
}

}  // namespace

void draw_inspector(const Ui& ui) {
  draw_choice(ui);
  const model::Session& s = ui.session;
  const model::Branch* branch = s.timeline.current();
  if (branch != nullptr && !branch->not_redone.empty())
    wrapped(ui.fonts.text, color::kWarning, "Steps cannot be looked into: " + branch->not_redone + ".");
  if (const auto& step = s.inspection.step; step && !step->mismatch.empty())
    wrapped(ui.fonts.text, color::kWarning, step->mismatch);
  if (const auto& step = s.inspection.step; step && !step->made_with.empty())
    wrapped(ui.fonts.small, color::kTextDim, "Part of the run " + step->made_with + ".");
  if (s.moving() != nullptr && s.selected_vertex) {
    draw_moving_vertex(ui);
  } else if (s.moving() != nullptr && s.selected_triangle) {
    draw_moving_triangle(ui);
  } else if (s.selected_vertex) {
    draw_vertex(ui, *s.selected_vertex);
  } else if (s.selected_triangle) {
    draw_triangle(ui, *s.selected_triangle);
  } else {
    ImGui::Dummy({0, ui.px(10)});
    wrapped(ui.fonts.text, color::kTextDim,
            "Click a vertex or a triangle, type a number, or press N, and see why it moves or does not.");
  }
}

}  // namespace isorelax::ui
