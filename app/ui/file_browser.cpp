#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace isorelax::ui {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTitle = "file-browser";

bool saves(FilePurpose purpose) {
  return purpose == FilePurpose::save_mesh || purpose == FilePurpose::save_picture ||
         purpose == FilePurpose::save_trace || purpose == FilePurpose::save_script;
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool fits(FilePurpose purpose, const fs::path& path) {
  const std::string extension = lower(path.extension().string());
  if (purpose == FilePurpose::save_picture) return extension == ".png";
  if (purpose == FilePurpose::save_trace || purpose == FilePurpose::add_trace) return extension == ".trace";
  if (purpose == FilePurpose::save_script) return extension == ".script";
  if (purpose == FilePurpose::field) return extension == ".vtk";
  if (purpose == FilePurpose::open_mesh && extension == ".trace") return true;
  return model::has_mesh_extension(path);
}

// Reads a folder into the browser; when that fails the browser stays where it is and says why.
void enter(FileBrowser& browser, const fs::path& folder) {
  std::error_code error;
  const fs::path target = fs::weakly_canonical(folder, error);
  std::vector<FileBrowser::Entry> entries;
  fs::directory_iterator list(error ? folder : target, error);
  if (error) {
    browser.error = folder.string() + ": " + error.message();
    return;
  }
  for (const fs::directory_iterator end; list != end; list.increment(error)) {
    if (error) break;
    std::error_code ignored;
    FileBrowser::Entry entry;
    entry.name = list->path().filename().string();
    entry.folder = list->is_directory(ignored);
    if (entry.name.starts_with('.')) continue;
    if (!entry.folder && !browser.all_files && !fits(browser.purpose, entry.name)) continue;
    if (!entry.folder) entry.bytes = list->file_size(ignored);
    entry.modified = list->last_write_time(ignored);
    entries.push_back(std::move(entry));
  }
  std::ranges::sort(entries, [](const auto& a, const auto& b) {
    return a.folder != b.folder ? a.folder : lower(a.name) < lower(b.name);
  });
  browser.folder = target;
  browser.typed_folder = target.string();
  browser.entries = std::move(entries);
  browser.selected = -1;
  browser.error.clear();
  browser.overwrite.clear();
}

std::string size_text(std::uintmax_t bytes) {
  if (bytes < 1024) return std::to_string(bytes) + " B";
  const double kib = static_cast<double>(bytes) / 1024;
  if (kib < 1024) return number_text("%.0f KiB", kib);
  return number_text("%.1f MiB", kib / 1024);
}

std::string_view title(FilePurpose purpose) {
  switch (purpose) {
    case FilePurpose::open_mesh:
      return "Open a mesh or a recorded run";
    case FilePurpose::save_mesh:
      return "Save the mesh";
    case FilePurpose::save_picture:
      return "Save a picture";
    case FilePurpose::comparison:
      return "Choose a mesh to compare with";
    case FilePurpose::save_trace:
      return "Save the run as a trace";
    case FilePurpose::save_script:
      return "Save what was done as a script";
    case FilePurpose::add_trace:
      return "Add a recorded run of this mesh";
    case FilePurpose::field:
      return "Choose a sampled velocity (VTK legacy text)";
    case FilePurpose::reference:
    case FilePurpose::motion_reference:
      break;
  }
  return "Choose a reference mesh";
}

// `path` must not be the browser's own: that one is cleared here.
void deliver(const Ui& ui, const fs::path& path) {
  FileBrowser& browser = ui.state.browser;
  browser.overwrite.clear();
  ImGui::CloseCurrentPopup();
  switch (browser.purpose) {
    case FilePurpose::open_mesh:
      open_file(ui, path);
      break;
    case FilePurpose::save_mesh:
      ui.command(model::SaveFile{path});
      break;
    case FilePurpose::save_picture:
      ui.request(SavePicture{path});
      break;
    case FilePurpose::save_trace:
      ui.command(model::SaveTrace{path});
      break;
    case FilePurpose::save_script:
      ui.request(SaveScript{path});
      break;
    case FilePurpose::add_trace:
      ui.command(model::AddTrace{path});
      break;
    case FilePurpose::comparison:
      ui.request(CompareWithFile{path});
      break;
    case FilePurpose::field: {
      MotionChoices motion = ui.session.motion;
      motion.field.kind = FieldKind::file;
      motion.field.path = path.string();
      ui.command(model::SetMotion{motion, "Field"});
      break;
    }
    case FilePurpose::motion_reference: {
      MotionChoices motion = ui.session.motion;
      motion.reference = path.string();
      ui.command(model::SetMotion{motion, "Reference"});
      break;
    }
    case FilePurpose::reference: {
      model::SmoothingSettings settings = ui.session.smoothing;
      settings.reference = model::ReferenceKind::file;
      settings.reference_file = path.string();
      ui.command(model::SetSmoothing{settings, "Reference"});
      break;
    }
  }
}

// Says why a name cannot be taken, and lets it be typed again.
void refuse(FileBrowser& browser, const std::string& why) {
  browser.error = why;
  browser.focus_name = true;
}

// Takes what is typed or selected: enters a folder, or delivers a file after a look at it.
void accept(const Ui& ui) {
  FileBrowser& browser = ui.state.browser;
  if (browser.name.empty()) {
    refuse(browser, "Choose a file or type its name.");
    return;
  }
  const fs::path path = browser.folder / browser.name;  // an absolute name replaces the folder
  std::error_code error;
  if (fs::is_directory(path, error)) {
    browser.name.clear();
    enter(browser, path);
    return;
  }
  const bool exists = fs::exists(path, error);
  if (!saves(browser.purpose)) {
    if (exists)
      deliver(ui, path);
    else
      refuse(browser, path.string() + ": there is no such file");
    return;
  }
  if (!fits(browser.purpose, path))
    refuse(browser, browser.purpose == FilePurpose::save_picture  ? "The name of a picture ends in .png"
                    : browser.purpose == FilePurpose::save_script ? "The name of a script ends in .script"
                    : browser.purpose == FilePurpose::save_trace
                        ? "The name of a trace ends in .trace"
                        : "The extension of a mesh is one of " + model::mesh_formats());
  else if (!fs::is_directory(path.parent_path(), error))
    refuse(browser, path.parent_path().string() + ": there is no such folder");
  else if (exists)
    browser.overwrite = path;
  else
    deliver(ui, path);
}

void place_button(const Ui& ui, std::string_view name, std::string_view label, const fs::path& folder) {
  if (folder.empty()) return;
  if (button(
          ui, name, label,
          {.look = ButtonLook::quiet, .width = ImGui::GetContentRegionAvail().x, .align = ButtonAlign::left}))
    enter(ui.state.browser, folder);
}

void draw_places(const Ui& ui, float width, float height) {
  ImGui::BeginChild("places", {width, height});
  text_in(ui.fonts.heading, color::kTextFaint, "PLACES");
  const char* home = std::getenv("HOME");
  std::error_code error;
  place_button(ui, "place/home", "Home", home != nullptr ? home : "");
  place_button(ui, "place/work", "Working folder", fs::current_path(error));
  place_button(ui, "place/root", "File system", "/");
  if (!ui.session.recent.empty()) {
    ImGui::Dummy({0, ui.px(6)});
    text_in(ui.fonts.heading, color::kTextFaint, "RECENT");
  }
  for (std::size_t k = 0; k < std::min<std::size_t>(ui.session.recent.size(), 6); ++k) {
    const fs::path& path = ui.session.recent[k];
    if (button(ui, "browser-recent/" + std::to_string(k), path.filename().string(),
               {.look = ButtonLook::quiet,
                .width = ImGui::GetContentRegionAvail().x,
                .align = ButtonAlign::left})) {
      enter(ui.state.browser, path.parent_path());
      ui.state.browser.name = path.filename().string();
    }
    tooltip(ui, path.string());
  }
  ImGui::EndChild();
}

void select(FileBrowser& browser, int index) {
  browser.selected = index;
  browser.scroll_to_selected = true;
  browser.overwrite.clear();
  browser.error.clear();
  const auto& entry = browser.entries[static_cast<std::size_t>(index)];
  if (!entry.folder) browser.name = entry.name;
}

void open_entry(const Ui& ui, int index) {
  FileBrowser& browser = ui.state.browser;
  const FileBrowser::Entry entry = browser.entries[static_cast<std::size_t>(index)];
  if (entry.folder) {
    enter(browser, browser.folder / entry.name);
  } else {
    browser.name = entry.name;
    accept(ui);
  }
}

void draw_entries(const Ui& ui, float height) {
  FileBrowser& browser = ui.state.browser;
  ImGui::PushStyleColor(ImGuiCol_ChildBg, to_vec4(color::kBackdrop));
  ImGui::BeginChild("entries", {0, height}, false,
                    ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoNav);
  if (browser.entries.empty())
    text_in(ui.fonts.text, color::kTextFaint,
            saves(browser.purpose) ? "No such files here yet." : "Nothing to open here.");
  int opened = -1;
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(browser.entries.size()), ImGui::GetTextLineHeightWithSpacing());
  if (browser.scroll_to_selected && browser.selected >= 0)
    ImGui::SetScrollY(std::max(
        0.0F, static_cast<float>(browser.selected) * ImGui::GetTextLineHeightWithSpacing() - 0.5F * height));
  browser.scroll_to_selected = false;
  while (clipper.Step()) {
    for (int k = clipper.DisplayStart; k < clipper.DisplayEnd; ++k) {
      const auto& entry = browser.entries[static_cast<std::size_t>(k)];
      const std::string label = entry.name + (entry.folder ? "/" : "") + "##" + std::to_string(k);
      if (ImGui::Selectable(label.c_str(), browser.selected == k,
                            ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_DontClosePopups)) {
        const bool twice = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
        browser.selected = k;
        if (!entry.folder) browser.name = entry.name;
        if (twice) opened = k;
      }
      mark_area(ui, "entry/" + entry.name, {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
      const std::string size = entry.folder ? "folder" : size_text(entry.bytes);
      ImGui::SameLine(ImGui::GetWindowWidth() - ui.px(28) - ImGui::CalcTextSize(size.c_str()).x);
      text_in(ui.fonts.text, color::kTextFaint, size);
    }
  }
  ImGui::EndChild();
  ImGui::PopStyleColor();
  if (opened >= 0) open_entry(ui, opened);
}

// Up and Down walk through the list, Enter opens, Backspace goes to the parent: also while a name is typed.
void browse_by_keyboard(const Ui& ui) {
  FileBrowser& browser = ui.state.browser;
  const int count = static_cast<int>(browser.entries.size());
  int step = 0;
  if (ImGui::IsKeyPressed(static_cast<int>(Key::down))) step = 1;
  if (ImGui::IsKeyPressed(static_cast<int>(Key::up))) step = -1;
  if (step != 0 && count > 0) select(browser, std::clamp(browser.selected + step, 0, count - 1));
  if (ImGui::IsKeyPressed(static_cast<int>(Key::backspace)) && browser.name.empty() &&
      !ImGui::IsAnyItemActive())
    enter(browser, browser.folder.parent_path());
  const bool is_elsewhere = !ui.state.focused.empty() && ui.state.focused != "name";
  if (is_elsewhere || !ImGui::IsKeyPressed(static_cast<int>(Key::enter), false)) return;
  if (!browser.overwrite.empty())
    deliver(ui, fs::path(browser.overwrite));
  else if (browser.selected >= 0 && browser.entries[static_cast<std::size_t>(browser.selected)].folder)
    open_entry(ui, browser.selected);
  else
    accept(ui);
}

void draw_folder_line(const Ui& ui) {
  FileBrowser& browser = ui.state.browser;
  if (button(ui, "parent", "Up", {.width = ui.px(56)})) enter(browser, browser.folder.parent_path());
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  if (ImGui::InputText("##folder", &browser.typed_folder, ImGuiInputTextFlags_EnterReturnsTrue))
    enter(browser, browser.typed_folder);
  mark(ui, "folder");
}

void draw_name_line(const Ui& ui) {
  FileBrowser& browser = ui.state.browser;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - ui.px(110));
  if (browser.focus_name) ImGui::SetKeyboardFocusHere();
  browser.focus_name = false;
  if (ImGui::InputTextWithHint("##name", "File name or path", &browser.name,
                               ImGuiInputTextFlags_AutoSelectAll)) {
    browser.error.clear();
    browser.overwrite.clear();
    browser.selected = -1;
  }
  mark(ui, "name");
  ImGui::SameLine();
  if (ImGui::Checkbox("All files", &browser.all_files)) enter(browser, browser.folder);
  mark(ui, "all-files");
}

void draw_answers(const Ui& ui) {
  FileBrowser& browser = ui.state.browser;
  const bool asks = !browser.overwrite.empty();
  const std::string note =
      asks ? browser.overwrite.filename().string() + " exists. Replace it?" : browser.error;
  ImGui::AlignTextToFramePadding();
  ImGui::PushTextWrapPos(ImGui::GetWindowWidth() - ui.px(240));
  text_in(ui.fonts.text, asks ? color::kWarning : color::kWorse, note);
  ImGui::PopTextWrapPos();
  if (!note.empty()) mark_area(ui, "browser-note", {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
  ImGui::SameLine(ImGui::GetWindowWidth() - ui.px(220));
  if (button(ui, "browser-cancel", "Cancel", {.width = ui.px(98)})) ImGui::CloseCurrentPopup();
  ImGui::SameLine();
  const std::string_view label = asks ? "Replace" : saves(browser.purpose) ? "Save" : "Open";
  if (button(ui, "browser-accept", label, {.look = ButtonLook::accent, .width = ui.px(98)})) {
    if (asks)
      deliver(ui, fs::path(browser.overwrite));
    else
      accept(ui);
  }
}

}  // namespace

void ask_for_file(const Ui& ui, FilePurpose purpose) {
  FileBrowser& browser = ui.state.browser;
  browser.wanted = browser.focus_name = true;
  browser.purpose = purpose;
  browser.name.clear();
  std::error_code error;
  fs::path folder = browser.folder.empty() ? fs::current_path(error) : browser.folder;
  if (ui.session.document) {
    const fs::path& path = ui.session.save_path ? *ui.session.save_path : ui.session.document->path;
    const std::string stem = path.stem().string();
    if (purpose == FilePurpose::save_picture) browser.name = stem + ".png";
    if (purpose == FilePurpose::save_script) browser.name = stem + ".script";
    if (purpose == FilePurpose::save_trace) browser.name = stem + ".trace";
    if (purpose == FilePurpose::save_mesh)
      browser.name = ui.session.save_path ? path.filename().string()
                                          : stem + (ui.session.moving() != nullptr ? "-moved" : "-smooth") +
                                                path.extension().string();
    if (browser.folder.empty()) folder = fs::absolute(path, error).parent_path();
  }
  enter(browser, folder);
}

void draw_file_browser(const Ui& ui) {
  FileBrowser& browser = ui.state.browser;
  if (browser.wanted) ImGui::OpenPopup(kTitle);
  browser.wanted = false;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const ImVec2 size{std::min(ui.px(820), display.x - ui.px(32)), std::min(ui.px(540), display.y - ui.px(32))};
  ImGui::SetNextWindowPos({0.5F * display.x, 0.5F * display.y}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(18), ui.px(16)});
  browser.open = ImGui::BeginPopupModal(kTitle, nullptr,
                                        ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                            ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  if (browser.open) {
    text_in(ui.fonts.title, color::kText, title(browser.purpose));
    ImGui::Dummy({0, ui.px(2)});
    draw_folder_line(ui);
    const float footer = 2 * (ui.px(size::kControl) + ImGui::GetStyle().ItemSpacing.y) + ui.px(10);
    const float height = ImGui::GetContentRegionAvail().y - footer;
    draw_places(ui, ui.px(170), height);
    ImGui::SameLine();
    draw_entries(ui, height);
    draw_name_line(ui);
    draw_answers(ui);
    browse_by_keyboard(ui);
    if (ImGui::IsKeyPressed(static_cast<int>(Key::escape), false)) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar();
}

}  // namespace isorelax::ui
