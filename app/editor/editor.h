#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "editor/painter.h"
#include "editor/partner.h"
#include "editor/session_log.h"
#include "editor/view_scene.h"
#include "model/command.h"
#include "render/renderer.h"
#include "ui/interface.h"

namespace isorelax::editor {

enum class Motion : std::uint8_t { animated, instant };

/// Session, interface, camera and renderer put together: the editor without a window. Needs a current OpenGL
/// context for its whole life.
class Editor {
 public:
  /// `read_plan` understands the words that recorded runs were made with (Engine::set_plan_reader).
  explicit Editor(render::GlLoader loader, Motion motion = Motion::animated, PlanReader read_plan = {});

  struct FrameOptions {
    render::PictureSize size;
    float scale = 1;  ///< pixels per point
    double time = 0;  ///< seconds, ascending
  };
  /// Takes over what the worker did, draws the mesh if anything about it changed, runs the interface, carries
  /// out what it asks for, and paints all of it into a framebuffer.
  void frame(const FrameOptions& options);
  /// Copies the last frame to the window's framebuffer.
  void show(render::PictureSize window) const { painter_.show(window); }
  /// The last frame.
  [[nodiscard]] render::Image picture() const { return painter_.read_back(); }

  /// Executes a command as if the interface had asked for it: it is written down.
  void act(const model::Command& command);
  /// Carries out a request as if the interface had made it.
  void ask(const ui::Request& request) { carry_out_request(request); }
  /// Takes a camera, or the one that a text means for the mesh (render::parse_camera). Throws UsageError.
  void look(const render::Camera& camera) { camera_ = camera; }
  void look(const std::string& spec);
  /// Whether the selected vertex or triangle is in the picture and nothing hides it.
  [[nodiscard]] bool sees_selection();
  /// What was done so far, as a script (script.h), in an editor as large as in the last frame.
  [[nodiscard]] std::string script() const;

  /// Whether nothing is on its way: another frame looks the same, but for a blink, which never ends.
  [[nodiscard]] bool has_settled() const;
  /// Whether another frame would look different without any new input.
  [[nodiscard]] bool is_restless() const { return !has_settled() || interface_.is_restless(); }
  [[nodiscard]] bool wants_to_quit() const { return quit_; }
  [[nodiscard]] model::Session& session() { return session_; }
  [[nodiscard]] ui::Interface& interface() { return interface_; }
  [[nodiscard]] const render::Camera& camera() const { return camera_; }

  /// Where the time of the last frame went, in seconds. Software rendering is all in `drawing`.
  struct Times {
    double thinking = 0;  ///< session, scene and interface
    double drawing = 0;   ///< OpenGL
  };
  [[nodiscard]] const Times& times() const { return times_; }

 private:
  // What a picture of a mesh depends on: equal keys, equal pictures.
  struct PictureKey {
    const model::Geometry* geometry = nullptr;
    const model::EnergyState* energy = nullptr;
    const model::MeshState* against = nullptr;
    view::View view;
    bool lines_only = false;
    double caption_lift = 0, legend_top = 0;
    // What is laid over it.
    const StepRecord* step = nullptr;
    std::optional<model::Stage> stage;
    std::optional<Index> vertex;
    std::optional<unsigned> limit;
    bool reasons = false;
    std::vector<Index> pinned;
    std::vector<render::Swatch> dots;  ///< told in it, and drawn in another one
    bool operator==(const PictureKey&) const = default;
  };
  /// A picture that is kept until something about it changes.
  struct KeptPicture {
    explicit KeptPicture(render::GlLoader loader) : renderer(loader) {}
    render::Renderer renderer;
    ViewScene scene;
    PictureKey key;
    bool drawn = false;
  };
  struct Flight {
    render::Camera from, to;
    double start = 0;
  };

  void follow_document();
  [[nodiscard]] render::FitOptions fit_options();
  void move_camera(double time);
  void follow_motion();
  void tell_camera();
  void follow_panes();
  [[nodiscard]] bool shows_names() const;
  [[nodiscard]] float bar_height() const;
  [[nodiscard]] int panes_top() const;
  [[nodiscard]] render::PictureSize panes_room() const;
  [[nodiscard]] float top_covered() const;
  void clear_overlays(render::Scene& scene) const;
  [[nodiscard]] render::Camera framed(const render::Camera& camera);
  [[nodiscard]] view::View present_view() const;
  [[nodiscard]] bool shows_before() const;
  [[nodiscard]] std::size_t panes() const;
  [[nodiscard]] render::PictureSize pane() const;
  [[nodiscard]] Shown shown_now() const;
  [[nodiscard]] bool shows_others() const;
  [[nodiscard]] int legend_strip() const;
  void draw_pictures();
  void draw_others();
  void draw_legend();
  [[nodiscard]] std::optional<render::Pick> pick_at(const Shown& shown, int x, int y);
  void pick(float x, float y);
  [[nodiscard]] std::array<float, 2> in_pane(float x, float y) const;
  void draw(KeptPicture& picture, const Shown& shown, const view::View& view);
  void carry_out(const ui::Output& output);
  void carry_out_request(const ui::Request& request);
  void fly_to(const render::Camera& to);
  [[nodiscard]] render::Camera beside_divider(const render::Camera& camera) const;
  [[nodiscard]] ui::ViewportImage viewport_image() const;
  void save_picture(const std::filesystem::path& path);
  void save_script(const std::filesystem::path& path);
  void copy_view();
  void paste_view(const std::string& text);
  void say(model::MessageKind kind, const std::string& text, model::Topic topic = model::Topic::other);

  model::Session session_;
  ui::Interface interface_;
  KeptPicture current_;
  KeptPicture before_;
  render::GlLoader loader_;
  std::vector<std::unique_ptr<KeptPicture>> others_;  // of the branches beside the present one
  std::unique_ptr<KeptPicture> legend_;               // theirs, where they have one
  Painter painter_;
  Partner partner_;
  SessionLog log_;
  Motion motion_;
  render::Camera camera_;
  view::View base_;  ///< pasted last: what the session has no setting for
  std::optional<Flight> flight_;
  render::Camera framed_;           ///< as it was when it last framed the mesh by itself or when asked to
  Eigen::AlignedBox3d framed_box_;  ///< of the moving surface in it
  std::optional<render::PictureSize> framed_pane_;  ///< of several beside each other when it did
  bool framed_change_ = false;                      ///< with the legend of a change when it did
  std::optional<render::Camera> framed_alone_;      ///< as it was before there were several, or a change
  model::DocumentPtr shown_document_;
  std::shared_ptr<const model::Geometry> measured_;
  double triangle_side_ = 0;  ///< of a square as large as its mean triangle, in length units
  render::PictureSize viewport_;
  render::PictureSize display_{1280, 720};
  float scale_ = 1;
  double time_ = 0;
  bool acted_ = false;
  std::vector<render::Swatch> dots_;  ///< what those in the present picture mean
  bool saving_ = false;               ///< a picture, which nothing is laid over
  bool quit_ = false;
  Times times_;
};

}  // namespace isorelax::editor
