// What leaves the editor as a file or as text, and views that come back.

#include <imgui.h>

#include <cmath>
#include <utility>

#include "editor/editor.h"
#include "editor/session_view.h"
#include "io/atomic_file.h"
#include "mesh/error.h"
#include "view/picture.h"

namespace isorelax::editor {

// Scripts are played at a pixel per point: so large, what is in it stands where it stood.
std::string Editor::script() const {
  const auto points = [this](int pixels) { return std::lround(static_cast<float>(pixels) / scale_); };
  const std::string size =
      "size " + std::to_string(points(display_.width)) + "x" + std::to_string(points(display_.height));
  return log_.text(size, camera_, interface_.state());
}

void Editor::save_script(const std::filesystem::path& path) {
  try {
    write_file_atomically(path, script());
    say(model::MessageKind::info, "Saved " + path.string(), model::Topic::saving);
  } catch (const Error& error) {
    say(model::MessageKind::error, error.what(), model::Topic::saving);
  }
}

// The picture of one mesh carries its view: `isorelax render --like` it gives the same bytes. What stands
// beside or over another state is taken as the viewport shows it, and no view says how to make that again.
void Editor::save_picture(const std::filesystem::path& path) {
  if (!session_.current) return;
  try {
    saving_ = !shows_names();
    draw_pictures();
    saving_ = false;
    if (shows_others() || before_.drawn) {
      const render::PictureSize room = panes_room();
      const ImVec2 size{static_cast<float>(room.width), static_cast<float>(room.height)};
      painter_.paint(
          interface_,
          interface_.compose(session_, {.display = size, .scale = scale_, .viewport = viewport_image()}),
          room);
      render::write_png(path, painter_.read_back());
    } else {
      const view::View view = present_view();
      render::Image image = current_.renderer.read_back();
      if (view.transparent) unmultiply(image);
      view::write_picture(path, {image, view});
    }
    say(model::MessageKind::info, "Saved " + path.string(), model::Topic::saving);
  } catch (const Error& error) {
    say(model::MessageKind::error, error.what(), model::Topic::saving);
  }
}

void Editor::copy_view() {
  if (!session_.current) return;
  ImGui::SetCurrentContext(&interface_.context());
  ImGui::SetClipboardText(view::to_json(present_view()).c_str());
  say(model::MessageKind::info, "Copied the view");
}

void Editor::paste_view(const std::string& text) {
  if (!session_.current) return;
  try {
    view::View view = view::parse_view(text, "The clipboard");
    if (const auto* spec = std::get_if<std::string>(&view.camera))
      view.camera = render::parse_camera(*spec, session_.current->positions(), pane(), fit_options());
    flight_.reset();
    camera_ = std::get<render::Camera>(view.camera);
    act(model::SetView{settings_of(view, session_.view)});
    const bool other_size = view.size != pane();
    const std::string size = std::to_string(view.size.width) + " x " + std::to_string(view.size.height);
    base_ = std::move(view);
    say(model::MessageKind::info, "Pasted the view" + (other_size ? ", of a picture of " + size : ""),
        model::Topic::view);
  } catch (const Error& error) {
    say(model::MessageKind::error, error.what(), model::Topic::view);
  }
}

}  // namespace isorelax::editor
