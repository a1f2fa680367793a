#include "window/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "editor/editor.h"
#include "mesh/error.h"
#include "window/icon.h"
#include "window/key_codes.h"
#include "window/recent_files.h"

namespace isorelax::window {
namespace {

constexpr double kBusyRedraw = 0.1;   // seconds: the progress bar moves
constexpr double kSettleTime = 0.8;   // seconds after an input in which tooltips may still appear
constexpr double kCursorBlink = 0.4;  // seconds

// Initialises GLFW for as long as it lives.
class Glfw {
 public:
  Glfw() {
    if (glfwInit() == GLFW_TRUE) return;
    const char* reason = nullptr;
    glfwGetError(&reason);
    std::string text = "no window can be opened here";
    if (reason != nullptr) text += " (" + std::string(reason) + ")";
    throw UsageError(text +
                     "; without a display use: isorelax smooth, isorelax render, isorelax quality, or "
                     "isorelax view --screenshot PICTURE.png");
  }
  ~Glfw() { glfwTerminate(); }
  Glfw(const Glfw&) = delete;
  Glfw& operator=(const Glfw&) = delete;
};

struct WindowDeleter {
  void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};
using WindowPtr = std::unique_ptr<GLFWwindow, WindowDeleter>;

// In points: both panels at their usual widths with the transport between them; and half of a Full HD
// display, which is all of one at twice the scale.
constexpr int kLeastWidth = 960;
constexpr int kLeastHeight = 540;

// Points of the wanted size for which the screen has room.
std::pair<int, int> size_on_screen(const WindowOptions& options) {
  std::pair<int, int> size{options.width, options.height};
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
    float scale_x = 1, scale_y = 1;
    glfwGetMonitorContentScale(monitor, &scale_x, &scale_y);
    int x = 0, y = 0, width = 0, height = 0;
    glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
    if (width > 0 && height > 0)
      size = {std::min(size.first, static_cast<int>(static_cast<float>(width) / scale_x)),
              std::min(size.second, static_cast<int>(static_cast<float>(height) / scale_y))};
  }
  return size;
}

WindowPtr create_window(const WindowOptions& options) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  const auto [width, height] = size_on_screen(options);
  WindowPtr window(glfwCreateWindow(width, height, "Isorelax", nullptr, nullptr));
  if (!window) {
    const char* reason = nullptr;
    glfwGetError(&reason);
    throw UsageError("no window with OpenGL 3.3 can be opened" +
                     (reason != nullptr ? " (" + std::string(reason) + ")" : std::string()));
  }
  // What GLFW counts in may be pixels or points.
  int opened = width;
  glfwGetWindowSize(window.get(), &opened, nullptr);
  const double per_point = static_cast<double>(opened) / width;
  glfwSetWindowSizeLimits(window.get(), static_cast<int>(std::min(kLeastWidth, width) * per_point),
                          static_cast<int>(std::min(kLeastHeight, height) * per_point), GLFW_DONT_CARE,
                          GLFW_DONT_CARE);
  return window;
}

// Between GLFW and the editor: events in, cursor, clipboard and title out.
class Host {
 public:
  /// `scale`: pixels per point; none: what the monitor under the window asks for.
  Host(GLFWwindow* window, editor::Editor& editor, std::optional<float> scale)
      : window_(window), editor_(editor), scale_(scale) {
    glfwSetWindowUserPointer(window, this);
    connect();
    ImGui::SetCurrentContext(&editor.interface().context());
    ImGuiIO& io = ImGui::GetIO();
    io.ClipboardUserData = window;
    io.GetClipboardTextFn = [](void* w) { return glfwGetClipboardString(static_cast<GLFWwindow*>(w)); };
    io.SetClipboardTextFn = [](void* w, const char* text) {
      glfwSetClipboardString(static_cast<GLFWwindow*>(w), text);
    };
    cursors_ = {glfwCreateStandardCursor(GLFW_ARROW_CURSOR), glfwCreateStandardCursor(GLFW_IBEAM_CURSOR),
                glfwCreateStandardCursor(GLFW_HRESIZE_CURSOR)};
  }

  [[nodiscard]] editor::Editor::FrameOptions frame_options() const {
    int width = 1;
    int height = 1;
    glfwGetFramebufferSize(window_, &width, &height);
    float scale = 1;
    glfwGetWindowContentScale(window_, &scale, nullptr);
    return {.size = {std::max(1, width), std::max(1, height)},
            .scale = scale_.value_or(std::clamp(scale, 0.75F, 4.0F)),
            .time = glfwGetTime()};
  }

  void update_cursor() {
    const ImGuiMouseCursor cursor = editor_.interface().cursor();
    const std::size_t index = cursor == ImGuiMouseCursor_TextInput  ? 1
                              : cursor == ImGuiMouseCursor_ResizeEW ? 2
                                                                    : 0;
    glfwSetCursor(window_, cursors_[index]);
  }

  void update_title() {
    const model::Session& s = editor_.session();
    std::string title = "Isorelax";
    if (s.document)
      title = s.document->path.filename().string() + (s.has_unsaved_changes() ? " *" : "") +
              " \xE2\x80\x93 " + title;
    if (title == title_) return;
    title_ = std::move(title);
    glfwSetWindowTitle(window_, title_.c_str());
  }

  // Sleeps until there is something to draw.
  void wait() {
    const bool busy = editor_.session().engine.progress().busy;
    const double since_input = glfwGetTime() - last_input_;
    ImGui::SetCurrentContext(&editor_.interface().context());
    if (editor_.is_restless())
      glfwPollEvents();
    else if (busy || since_input < kSettleTime)
      glfwWaitEventsTimeout(kBusyRedraw);
    else if (ImGui::GetIO().WantTextInput)
      glfwWaitEventsTimeout(kCursorBlink);
    else
      glfwWaitEvents();
  }

 private:
  static Host& of(GLFWwindow* window) { return *static_cast<Host*>(glfwGetWindowUserPointer(window)); }

  void push(ui::InputEvent event) {
    last_input_ = glfwGetTime();
    editor_.interface().input().push(std::move(event));
  }

  void connect() {
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) { of(w).pointer_moved(x, y); });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int mods) {
      if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
      // The modifiers of a click matter even when their key went down in another window.
      of(w).push(ui::KeyChanged{ui::Key::none, false, modifiers_of(mods)});
      of(w).push(ui::ButtonChanged{button, action == GLFW_PRESS});
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double x, double y) {
      of(w).push(ui::WheelTurned{static_cast<float>(x), static_cast<float>(y)});
    });
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int /*scancode*/, int action, int mods) {
      of(w).key_changed(key, action, mods);
    });
    glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned code) { of(w).text_typed(code); });
    glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
      if (count > 0) of(w).editor_.interface().drop(paths[0]);
    });
    glfwSetWindowCloseCallback(window_, [](GLFWwindow* w) {
      glfwSetWindowShouldClose(w, GLFW_FALSE);
      of(w).editor_.interface().ask_to_quit();
    });
  }

  // Window coordinates are not pixels on every system.
  void pointer_moved(double x, double y) {
    int width = 1;
    int height = 1;
    glfwGetWindowSize(window_, &width, &height);
    const auto size = frame_options().size;
    push(ui::PointerMoved{static_cast<float>(x * size.width / std::max(1, width)),
                          static_cast<float>(y * size.height / std::max(1, height))});
  }

  void key_changed(int glfw_key, int action, int mods) {
    const ui::Key key = key_of(glfw_key);
    ui::Modifiers modifiers = modifiers_of(mods);
    const bool down = action != GLFW_RELEASE;
    // A modifier key reports the state before itself.
    if (glfw_key == GLFW_KEY_LEFT_SHIFT || glfw_key == GLFW_KEY_RIGHT_SHIFT) modifiers.shift = down;
    if (glfw_key == GLFW_KEY_LEFT_CONTROL || glfw_key == GLFW_KEY_RIGHT_CONTROL) modifiers.control = down;
    push(ui::KeyChanged{key, down, modifiers});
  }

  void text_typed(unsigned code) {
    std::string text;
    if (code < 0x80) {
      text = static_cast<char>(code);
    } else if (code < 0x800) {
      text = {static_cast<char>(0xC0 | code >> 6), static_cast<char>(0x80 | (code & 0x3F))};
    } else if (code < 0x10000) {
      text = {static_cast<char>(0xE0 | code >> 12), static_cast<char>(0x80 | (code >> 6 & 0x3F)),
              static_cast<char>(0x80 | (code & 0x3F))};
    }
    push(ui::TextTyped{std::move(text)});
    if (code == '?') {
      // Which key types it depends on the keyboard.
      push(ui::KeyChanged{ui::Key::question, true, {}});
      push(ui::KeyChanged{ui::Key::question, false, {}});
    }
  }

  GLFWwindow* window_;
  editor::Editor& editor_;
  std::optional<float> scale_;
  std::array<GLFWcursor*, 3> cursors_{};
  std::string title_;
  double last_input_ = 0;
};

void run_frames(GLFWwindow* window, editor::Editor& editor, Host& host, const WindowOptions& options) {
  unsigned drawn = 0;
  while (!editor.wants_to_quit()) {
    const auto frame = host.frame_options();
    editor.frame(frame);
    editor.show(frame.size);
    glfwSwapBuffers(window);
    host.update_cursor();
    host.update_title();
    ++drawn;
    // A test counts frames only once the worker has done what it was asked.
    if (options.frames && drawn >= *options.frames && !editor.session().engine.busy() &&
        !editor.is_restless())
      break;
    if (options.frames)
      glfwPollEvents();
    else
      host.wait();
  }
}

}  // namespace

void run_window(const WindowOptions& options) {
  const Glfw glfw;
  const WindowPtr window = create_window(options);
  glfwMakeContextCurrent(window.get());
  glfwSwapInterval(1);
  set_icon(window.get());
  editor::Editor editor([](const char* name) -> render::GlProc { return glfwGetProcAddress(name); },
                        editor::Motion::animated, options.read_plan);
  model::Session& session = editor.session();
  Host host(window.get(), editor, options.scale);
  session.engine.set_wake([] { glfwPostEmptyEvent(); });

  auto recent = load_recent_files();
  if (options.files.size() > 1) recent.insert(recent.begin(), options.files.begin() + 1, options.files.end());
  model::execute(session, model::SetRecent{recent});
  if (!options.files.empty()) editor.act(model::OpenFile{options.files.front()});
  run_frames(window.get(), editor, host, options);
  session.engine.set_wake({});
  if (!options.frames) save_recent_files(session.recent);
  if (options.screenshot) render::write_png(*options.screenshot, editor.picture());
}

}  // namespace isorelax::window
