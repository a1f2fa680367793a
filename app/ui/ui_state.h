#pragma once

#include <imgui.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "model/command.h"
#include "ui/shortcuts.h"
#include "ui/theme.h"

namespace isorelax::ui {

struct Rect {
  ImVec2 low{0, 0};
  ImVec2 high{0, 0};
  [[nodiscard]] float width() const { return high.x - low.x; }
  [[nodiscard]] float height() const { return high.y - low.y; }
  [[nodiscard]] ImVec2 center() const { return {0.5F * (low.x + high.x), 0.5F * (low.y + high.y)}; }
};

// What the interface asks of the program around it: the camera, the renderer and the window are not in the
// session.
struct OrbitView {
  float dx = 0, dy = 0;  ///< pixels
};
struct PanView {
  float dx = 0, dy = 0;
};
struct ZoomView {
  float factor = 1;    ///< 2: twice as large
  float x = 0, y = 0;  ///< pixel of the viewport that stays in place
};
struct FrameView {};
/// Turns to a standard view, and frames it.
struct LookFrom {
  std::string_view view;  ///< as `isorelax render --camera` calls it
};
struct FlyToSelection {};
/// Selects what is under a pixel of the viewport: a vertex where one is near, else the triangle.
struct PickAt {
  float x = 0, y = 0;
};
struct SavePicture {
  std::filesystem::path path;
};
/// Writes down what was done so far as a script.
struct SaveScript {
  std::filesystem::path path;
};
/// Puts the view into the clipboard as text.
struct CopyView {};
/// Takes over a view from text.
struct PasteView {
  std::string text;
};
/// Keeps the present state to be compared with.
struct RememberState {};
/// Reads a mesh to be compared with.
struct CompareWithFile {
  std::filesystem::path path;
};
struct Quit {};
using Request =
    std::variant<OrbitView, PanView, ZoomView, FrameView, LookFrom, FlyToSelection, PickAt, SavePicture,
                 SaveScript, CopyView, PasteView, RememberState, CompareWithFile, Quit>;

/// What one frame of the interface asks for, in order.
struct Output {
  std::vector<model::Command> commands;
  std::vector<Request> requests;
};

/// What a file dialog chooses for.
enum class FilePurpose : std::uint8_t {
  open_mesh,
  save_mesh,
  save_picture,
  reference,
  comparison,
  save_trace,
  add_trace,
  save_script,
  field,
  motion_reference,
};

/// How the mesh is shown beside another state of it.
enum class CompareMode : std::uint8_t { off, split, blink, side_by_side, ghost, change };
/// What it is shown beside.
enum class CompareWith : std::uint8_t { original, remembered, file, beside };
struct Comparison {
  CompareMode mode = CompareMode::off;
  CompareWith with = CompareWith::original;
  float divider = 0.5F;       ///< of a split, share of the viewport's width
  bool remembers = false;     ///< there is a remembered state
  std::string remembered;     ///< what it is called
  std::string file;           ///< name of the file that was read; empty: none
  float blink_seconds = 0;    ///< since the last change
  bool blink_before = false;  ///< what a blink shows now
  bool dragged = false;       ///< the pointer has hold of the divider
};

/// A folder as it was listed, and where the user is in it.
struct FileBrowser {
  struct Entry {
    std::string name;
    bool folder = false;
    std::uintmax_t bytes = 0;
    std::filesystem::file_time_type modified;
  };
  bool wanted = false;  ///< opens with the next frame
  bool open = false;
  FilePurpose purpose = FilePurpose::open_mesh;
  std::filesystem::path folder;
  std::string typed_folder;
  std::string name;
  std::vector<Entry> entries;
  int selected = -1;
  bool all_files = false;
  bool scroll_to_selected = false;
  bool focus_name = false;          ///< the field of the name gets the keyboard, all of it selected
  std::string error;                ///< shown in the dialog until something else is done
  std::filesystem::path overwrite;  ///< waits for "Replace?"; empty: no question
};

/// What waits for the answer to "Save changes?".
struct PendingQuit {};
using PendingAction = std::variant<std::monostate, PendingQuit, std::filesystem::path, SphereStart>;

/// What the panel at the right shows; settings only where there is no other panel for them.
enum class SideTab : std::uint8_t { quality, inspect, debug, runs, settings };

/// The timeline playing by itself.
struct Playing {
  int direction = 0;  ///< 1 forwards, -1 backwards, 0 not at all
  int speed = 2;      ///< which of kPlaySpeeds
  float due = 0;      ///< iterations that have become due
};
inline constexpr std::array kPlaySpeeds{1.0F, 4.0F, 12.0F, 30.0F, 120.0F};  ///< iterations per second

/// What is being typed into the inspector and the list of breakpoints.
struct Typing {
  std::string id;
  bool triangle = false;                                    ///< the id is that of a triangle
  std::optional<Index> selected_vertex, selected_triangle;  ///< when it was last followed
  std::string predicate;
  bool refused = false;  ///< the predicate that was entered cannot be read: its field gets the keyboard
  bool logs = false;     ///< the predicate tells instead of stopping
  int compare_with = 0;
  bool exponent = false, tolerance = false;  ///< other ones than the usual, even where they are the same
};

/// How the viewport looks at the mesh: unit vectors.
struct Looking {
  Vec3 up = Vec3::UnitY();
  Vec3 toward_eye = Vec3::UnitZ();
  double triangle_pixels = 100;  ///< square root of the pixels that a triangle has on average, seen straight
};

/// State of the widgets: nothing here is about the mesh.
struct UiState {
  bool panels_hidden = false;
  float left_width = 300;   ///< points
  float right_width = 352;  ///< points
  bool help_wanted = false;
  bool has_mesh = false;  ///< there is a mesh, and so a timeline
  SideTab tab = SideTab::quality;
  Playing playing;
  bool seeks_guard = false;  ///< the first round of the energy guard is looked for
  Typing typing;
  ImVec2 press_at{0, 0};  ///< where the pointer went down in the viewport
  FileBrowser browser;
  PendingAction pending;
  bool ask_unsaved = false;
  bool go_on_after_save = false;  ///< with `pending`
  std::uint64_t dismissed_message = 0;
  std::array<float, 2> typed_range{0, 1};
  Comparison comparison;
  Looking looking;

  /// Where each named widget was drawn in the last frame.
  std::map<std::string, Rect, std::less<>> rects;
  /// Names of the widgets that Tab stops at, in the order of drawing.
  std::vector<std::string> stops;
  std::string focus_request;     ///< gets the keyboard focus in this frame
  std::string focused;           ///< has it; empty: the viewport
  std::string next_focus;        ///< gets it in the next frame
  bool segment_focused = false;  ///< one of choices side by side has it: arrows choose
  int segment_step = 0;          ///< what they chose in this frame: 1 the next, -1 the one before
};

/// What the functions that draw panels share.
struct Ui {
  const model::Session& session;
  UiState& state;
  Output& output;
  const Fonts& fonts;
  float scale = 1;

  [[nodiscard]] float px(float points) const { return points * scale; }
  /// Asks for one of the alternatives of model::Command.
  template <typename C>
  void command(C&& c) const {
    output.commands.emplace_back(std::forward<C>(c));
  }
  /// Asks for one of the alternatives of Request.
  template <typename R>
  void request(R&& r) const {
    output.requests.emplace_back(std::forward<R>(r));
  }
};

}  // namespace isorelax::ui
