#include "editor/script.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <memory>

#include "editor/editor.h"
#include "editor/screenshot.h"
#include "editor/script_words.h"
#include "editor/view_words.h"
#include "editor/word_values.h"
#include "io/mesh_file.h"
#include "mesh/error.h"
#include "model/motion_jobs.h"
#include "render/offscreen.h"
#include "render/picture_size.h"
#include "trace/predicate.h"

namespace isorelax::editor {
namespace {

using Words = std::span<const std::string>;

constexpr std::array kEditorWords{
    ScriptWord{"screenshot FILE.png", "the whole editor"},
    ScriptWord{"picture FILE.png", "what the viewport shows"},
    ScriptWord{"size WxH", "of the editor, in pixels"},
    ScriptWord{"camera ...",
               "a view as isorelax render takes it (iso, 30,20,2, ...), or the recorded numbers"},
    ScriptWord{"frame, fly", "show the whole mesh; go to what is selected"},
    ScriptWord{"tab NAME", "quality, inspect, debug or runs; settings in a narrow editor"},
    ScriptWord{"show MODE [WITH]", "off, split, blink, side, ghost or change; with original or beside"},
    ScriptWord{"click NAME", "a control of the editor by its name, such as run or stage/Tangent"},
    ScriptWord{"key KEYS", "as the help page names them, such as Shift+Right, Enter or Tab"},
    ScriptWord{"type TEXT", "into the field that has the focus"},
    ScriptWord{"expect PREDICATE", "of the shown iteration; what does not hold is told, with exit status 1"},
};

ui::KeyChanged key_of(const std::string& text) {
  for (const ui::Shortcut& shortcut : ui::shortcuts())
    if (shortcut.keys == text) return {shortcut.key, true, shortcut.modifiers};
  constexpr std::array<std::pair<std::string_view, ui::Key>, 5> kOthers{{{"Enter", ui::Key::enter},
                                                                         {"Escape", ui::Key::escape},
                                                                         {"Tab", ui::Key::tab},
                                                                         {"Up", ui::Key::up},
                                                                         {"Down", ui::Key::down}}};
  for (const auto& [name, key] : kOthers)
    if (name == text) return {key, true, {}};
  throw UsageError("\"" + text + "\" is no key of the editor");
}

class Player {
 public:
  explicit Player(const ScriptOptions& options)
      : options_(options),
        folder_(options.file.parent_path()),
        pictures_(options.pictures.empty() ? folder_ : options.pictures),
        size_(options.size),
        context_(render::OffscreenContext::create(render::ContextKind::osmesa)),
        editor_(context_->loader(), Motion::instant, options_.read_plan) {}

  ScriptResult play() {
    std::ifstream file(options_.file);
    if (!file || std::filesystem::is_directory(options_.file)) check_readable(options_.file);
    require_room(size_, options_.scale);
    make_pictures_folder();
    frames(2);
    std::string line;
    while (std::getline(file, line)) {
      ++number_;
      const std::string at = options_.file.string() + ": line " + std::to_string(number_);
      try {
        const std::vector<std::string> words = split_words(line);
        if (!words.empty()) obey(words);
        look_for_errors(words);
      } catch (const UsageError& error) {
        throw UsageError(at + ": " + error.what());
      } catch (const OutputError& error) {
        throw OutputError(at, error.what());
      } catch (const Error& error) {
        throw InputError(at, "", error.what());
      }
    }
    return std::move(result_);
  }

 private:
  void make_pictures_folder() const {
    if (options_.pictures.empty()) return;
    std::error_code problem;
    std::filesystem::create_directories(options_.pictures, problem);
    if (problem) throw OutputError(options_.pictures.string(), problem.message());
  }

  void frames(int count) {
    for (int k = 0; k < count; ++k)
      editor_.frame({.size = size_, .scale = options_.scale, .time = time_ += 0.2});
  }

  // The interface needs a few frames to take notice of what the worker did.
  void settle() {
    int left = 2000;
    do {
      model::finish(editor_.session());
      frames(1);
    } while (--left > 0 && (!editor_.has_settled() || editor_.session().engine.busy()));
    frames(2);
  }

  // What the editor tells its user, and what it refuses to do, ends a script.
  void look_for_errors(Words words) {
    constexpr std::array<std::string_view, 3> kWriters{"save", "save-trace", "picture"};
    for (const model::Message& message : editor_.session().messages) {
      if (message.number <= last_message_) continue;
      last_message_ = message.number;
      if (message.topic == model::Topic::refusal)
        throw UsageError((words.empty() ? "" : words.front() + ": ") + message.text);
      if (message.kind != model::MessageKind::error) continue;
      if (!words.empty() && std::ranges::find(kWriters, words.front()) != kWriters.end())
        throw OutputError(words.front(), message.text);
      throw Error(message.text);
    }
  }

  void execute(const model::Command& command) {
    editor_.act(command);
    settle();
  }

  // The editor tells its user, who opens one then; a script goes on as if it had done something.
  void require_mesh(Words words) {
    constexpr std::array<std::string_view, 7> kOfAMesh{"run",        "step", "seek",  "save",
                                                       "save-trace", "fly",  "expect"};
    if (!editor_.session().document && std::ranges::find(kOfAMesh, words.front()) != kOfAMesh.end())
      throw UsageError(words.front() + ": no mesh is open");
  }

  void obey(Words words) {
    require_mesh(words);
    if (const auto command = parse_line(words, editor_.session(), folder_)) {
      execute(*command);
      if (words.front() == "vertex" || words.front() == "triangle") show_selection();
      return;
    }
    const auto found = std::ranges::find(handlers_, words.front(), &Handler::name);
    if (found == handlers_.end()) throw UsageError("\"" + words.front() + "\" is no command");
    require(words, found->least, found->most);
    (this->*found->act)(words);
    settle();
  }

  // What a click on it does; and what is clicked on can be seen.
  void show_selection() {
    editor_.interface().state().tab = ui::SideTab::inspect;
    if (!editor_.sees_selection()) editor_.ask(ui::FlyToSelection{});
    settle();
  }

  void run(Words words) {
    if (words.size() < 2) {
      execute(model::Run{});
      return;
    }
    if (editor_.session().task == model::Task::move) {
      const std::array<std::string, 3> move{"motion", "run", words[1]};
      execute(*parse_line(move, editor_.session(), folder_));
      return;
    }
    const std::array<std::string, 3> set{"set", "--iterations", words[1]};
    execute(*parse_line(set, editor_.session(), folder_));
    execute(model::Run{});
  }

  void screenshot(Words words) {
    settle();
    const std::filesystem::path file = picture_file(words[1]);
    render::write_png(file, editor_.picture());
    result_.pictures.push_back(file);
  }

  void picture(Words words) {
    const std::filesystem::path file = picture_file(words[1]);
    editor_.ask(ui::SavePicture{file});
    result_.pictures.push_back(file);
  }

  [[nodiscard]] std::filesystem::path picture_file(const std::string& name) const {
    render::require_png_name(name);
    return pictures_ / name;
  }

  void resize(Words words) {
    const render::PictureSize size = render::parse_size(words[1]);
    require_room(size, options_.scale);
    size_ = size;
  }

  void camera(Words words) {
    if (words.size() > 2)
      editor_.look(parse_camera_words(words));
    else
      editor_.look(words[1]);
  }

  void frame_mesh(Words /*words*/) { editor_.ask(ui::FrameView{}); }
  void fly(Words /*words*/) { editor_.ask(ui::FlyToSelection{}); }
  void tab(Words words) {
    editor_.interface().state().tab = static_cast<ui::SideTab>(index_of(kTabWords, words[1]));
  }
  void show(Words words) {
    ui::Comparison& comparison = editor_.interface().state().comparison;
    comparison.mode = static_cast<ui::CompareMode>(index_of(kModeWords, words[1]));
    if (words.size() > 2) comparison.with = static_cast<ui::CompareWith>(index_of(kPartnerWords, words[2]));
  }

  void click(Words words) {
    const auto& rects = editor_.interface().state().rects;
    const auto found = rects.find(words[1]);
    if (found == rects.end()) {
      std::string names;
      for (const auto& [name, rect] : rects) names += (names.empty() ? "" : ", ") + name;
      throw UsageError("click: there is no \"" + words[1] + "\" to be seen, but " + names);
    }
    const ImVec2 at = found->second.center();
    auto& input = editor_.interface().input();
    input.push(ui::PointerMoved{at.x, at.y});
    settle();
    input.push(ui::ButtonChanged{0, true});
    input.push(ui::ButtonChanged{0, false});
  }

  void key(Words words) {
    ui::KeyChanged press = key_of(words[1]);
    editor_.interface().input().push(press);
    press.down = false;
    press.modifiers = {};
    editor_.interface().input().push(press);
  }

  void type(Words words) {
    std::string text;
    for (const std::string& word : words.subspan(1)) text += (text.empty() ? "" : " ") + word;
    editor_.interface().input().push(ui::TextTyped{text});
  }

  void expect(Words words) {
    std::string text;
    for (const std::string& word : words.subspan(1)) text += (text.empty() ? "" : " ") + word;
    const Predicate predicate(text);
    const TriangleMesh& mesh = editor_.session().document->mesh();
    predicate.check(mesh.positions.size(), mesh.triangles.size());
    if (const std::string fault = fault_of(predicate); !fault.empty())
      result_.failures.push_back(options_.file.string() + ": line " + std::to_string(number_) + ": " + fault);
  }

  // Predicates may ask for the arrays of the step: looking inside it brings them.
  std::string fault_of(const Predicate& predicate) {
    model::Session& session = editor_.session();
    const bool at_the_start = session.timeline.cursor.iteration == 0;
    if (session.moving() != nullptr || at_the_start) return fault_of_state(predicate);
    const auto stage = session.timeline.cursor.stage;
    if (!stage) execute(model::SetStage{model::Stage{}});
    const auto& step = session.inspection.step;
    const model::StepSummary* summary =
        session.timeline.step(session.timeline.cursor.branch, session.timeline.cursor.iteration);
    if (!step || summary == nullptr) return "the step could not be looked into";
    const QualityReport& quality = session.current->quality();
    TraceIteration numbers;
    numbers.before = summary->before;
    numbers.after = summary->after;
    numbers.largest_move = summary->largest_move;
    numbers.fold_passes = summary->fold_passes;
    numbers.energy_passes = summary->energy_passes;
    numbers.moved = summary->moved;
    numbers.limits = summary->limits;
    numbers.quality = {quality.min_angle_deg, quality.max_angle_deg, quality.mean_min_angle_deg,
                       quality.inverted};
    const Moment now{.iteration = session.timeline.cursor.iteration,
                     .numbers = numbers,
                     .record = *step->record,
                     .positions = session.current->positions(),
                     .triangles = session.document->mesh().triangles,
                     .inverted_at_start = session.original->quality().inverted,
                     .stop = session.timeline.cursor.iteration == session.timeline.last()};
    std::string fault = fault_at(predicate, now);
    if (!stage) execute(model::SetStage{});
    return fault;
  }

  // What is known of a moment, or of the mesh as opened; of the way of single vertices in a step nothing is.
  std::string fault_of_state(const Predicate& predicate) {
    const model::Session& session = editor_.session();
    const auto positions = session.current->positions();
    const QualityReport& quality = session.current->quality();
    TraceIteration numbers;
    numbers.quality = {quality.min_angle_deg, quality.max_angle_deg, quality.mean_min_angle_deg,
                       quality.inverted};
    if (session.current->energy) numbers.after.energy = session.current->energy->total;
    const std::vector<Vec3> unknown(positions.size(), Vec3::Constant(std::nan("")));
    const StepRecord record = model::record_of_motion(unknown, positions);
    const Moment now{.iteration = session.timeline.cursor.iteration,
                     .numbers = numbers,
                     .record = record,
                     .positions = positions,
                     .triangles = session.document->mesh().triangles,
                     .inverted_at_start = session.original->quality().inverted,
                     .stop = session.timeline.cursor.iteration == session.timeline.last(),
                     .time = session.moving() != nullptr ? session.moment().time : 0};
    return fault_at(predicate, now);
  }

  static std::string fault_at(const Predicate& predicate, const Moment& now) {
    if (predicate.holds(now)) return {};
    const std::string values = predicate.values(now);
    return "does not hold: " + predicate.text() + (values.empty() ? "" : "; " + values);
  }

  static constexpr std::size_t kAnyNumber = 1000;
  struct Handler {
    std::string_view name;
    std::size_t least, most;  // words behind it
    void (Player::*act)(Words);
  };
  static constexpr std::array<Handler, 13> handlers_{{{"run", 0, 1, &Player::run},
                                                      {"screenshot", 1, 1, &Player::screenshot},
                                                      {"picture", 1, 1, &Player::picture},
                                                      {"size", 1, 1, &Player::resize},
                                                      {"camera", 1, kAnyNumber, &Player::camera},
                                                      {"frame", 0, 0, &Player::frame_mesh},
                                                      {"fly", 0, 0, &Player::fly},
                                                      {"tab", 1, 1, &Player::tab},
                                                      {"show", 1, 2, &Player::show},
                                                      {"click", 1, 1, &Player::click},
                                                      {"key", 1, 1, &Player::key},
                                                      {"type", 1, kAnyNumber, &Player::type},
                                                      {"expect", 1, kAnyNumber, &Player::expect}}};

  ScriptOptions options_;
  std::filesystem::path folder_, pictures_;
  render::PictureSize size_;
  std::unique_ptr<render::OffscreenContext> context_;
  Editor editor_;
  ScriptResult result_;
  unsigned number_ = 0;
  std::uint64_t last_message_ = 0;
  double time_ = 0;
};

}  // namespace

ScriptResult run_script(const ScriptOptions& options) {
  return Player(options).play();
}

std::string script_reference() {
  std::string text;
  const auto list = [&](std::span<const ScriptWord> words) {
    for (const ScriptWord& word : words) {
      std::string line = "  " + std::string(word.usage);
      if (!word.meaning.empty()) line += std::string(line.size() < 30 ? 30 - line.size() : 2, ' ');
      text += line + std::string(word.meaning) + "\n";
    }
  };
  list(model_words());
  list(kEditorWords);
  return text;
}

}  // namespace isorelax::editor
