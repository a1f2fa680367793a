#include "editor/script_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <functional>

#include "editor/motion_words.h"
#include "mesh/error.h"
#include "model/arguments.h"

namespace isorelax::editor {
namespace {

using Words = std::span<const std::string>;

constexpr std::array kModelWords{
    ScriptWord{"open FILE", "a mesh, or a recorded run"},
    ScriptWord{"save FILE", "the mesh as it is shown"},
    ScriptWord{"save-trace FILE", "the present run"},
    ScriptWord{"add-trace FILE", "a recorded run beside those that are there"},
    ScriptWord{"set OPTION VALUE ...", "settings, as for isorelax smooth: set --mu 0.5 --solver newton"},
    ScriptWord{"run [N]", "as many iterations as set, or N"},
    ScriptWord{"step", "one iteration on"},
    ScriptWord{"seek ITERATION [RUN]", "on the timeline; runs count from 0"},
    ScriptWord{"stage NAME [ROUND]", "gradient, tangent, proposed, control, moved, or off"},
    ScriptWord{"next-stage, previous-stage", "over the ends of iterations"},
    ScriptWord{"vertex ID, triangle ID", "select it"},
    ScriptWord{"worst-by NUMBER, next-worst", "0: what the colours say, ..., in the order of the menu"},
    ScriptWord{"limited NAME", "mark what was limited by: pinned, corner, ..., or none"},
    ScriptWord{"clear", "select nothing"},
    ScriptWord{"pin ID", "hold a vertex, or let it go"},
    ScriptWord{"break PREDICATE", "stop where it holds"},
    ScriptWord{"log PREDICATE", "tell where it holds"},
    ScriptWord{"no-breaks", "remove all of them"},
    ScriptWord{"beside [RUN ...]", "runs shown beside the present one"},
    ScriptWord{"compare RUN RUN", "find where two runs part"},
    ScriptWord{"teach", "the three methods, side by side"},
    ScriptWord{"memory MB", "for full records of steps"},
    ScriptWord{"view KEY=VALUE ...",
               "color=none|angle|max-angle|area|energy, range=run|current, wire=, legend=, "
               "reasons=, smooth=, reversed=on|off, map=NAME"},
    ScriptWord{"reset, undo, redo", ""},
    ScriptWord{"motion [off]", "Run moves the surface; off: it smooths again"},
    ScriptWord{"motion [defaults] OPTION VALUE ...",
               "options of isorelax advect, without dashes: motion field paper preset balanced"},
    ScriptWord{"motion run [N]", "N steps of the motion, or to its end"},
    ScriptWord{"motion sphere [SPEC]", "open a sphere, N[:RADIUS[:X,Y,Z]]; none: the paper's"},
};

unsigned to_number(const std::string& word) {
  unsigned value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size())
    throw UsageError("expected a number, found \"" + word + "\"");
  return value;
}

double to_real(const std::string& word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size())
    throw UsageError("expected a number, found \"" + word + "\"");
  return value;
}

std::string real_text(double value) {
  std::array<char, 40> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

void require(Words words, std::size_t least, std::size_t most) {
  if (words.size() < least + 1) throw UsageError(words.front() + ": something is missing");
  if (words.size() > most + 1) throw UsageError(words.front() + ": \"" + words[most + 1] + "\" is too much");
}

constexpr std::array<std::string_view, 5> kStageNames{"gradient", "tangent", "proposed", "control", "moved"};
constexpr std::array<std::string_view, model::kColorings> kColorNames{"none", "angle", "max-angle", "area",
                                                                      "energy"};

template <std::size_t N>
std::size_t index_of(const std::array<std::string_view, N>& names, const std::string& word) {
  const auto found = std::ranges::find(names, word);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  std::string known;
  for (const std::string_view name : names) known += (known.empty() ? "" : ", ") + std::string(name);
  throw UsageError("\"" + word + "\": expected one of " + known);
}

model::SetStage to_stage(Words words) {
  require(words, 1, 2);
  if (words[1] == "off") return {};
  model::Stage stage{static_cast<model::StageKind>(index_of(kStageNames, words[1]))};
  if (words.size() > 2) stage.pass = std::max(1U, to_number(words[2])) - 1;
  return {stage};
}

model::SelectLimited to_limited(Words words) {
  require(words, 1, 1);
  for (unsigned bit = 0; bit < 8; ++bit)
    if (limit_name(static_cast<Limit>(1U << bit)) == words[1]) return {bit};
  if (words[1] != "none") throw UsageError("\"" + words[1] + "\" is nothing that limits a vertex");
  return {};
}

bool to_switch(const std::string& value) {
  if (value != "on" && value != "off") throw UsageError("expected on or off, found \"" + value + "\"");
  return value == "on";
}

model::SetView to_view(Words words, model::ViewSettings view) {
  for (const std::string& word : words.subspan(1)) {
    const std::size_t equal = std::min(word.find('='), word.size());
    const std::string key = word.substr(0, equal);
    const std::string value = word.substr(std::min(equal + 1, word.size()));
    if (key == "color")
      view.coloring = static_cast<model::Coloring>(index_of(kColorNames, value));
    else if (key == "range")
      view.range_mode = value == "current" ? model::RangeMode::current : model::RangeMode::run;
    else if (key == "map")
      view.color_map = value;
    else if (key == "wire")
      view.wire = to_switch(value);
    else if (key == "legend")
      view.legend = to_switch(value);
    else if (key == "reasons")
      view.reasons = to_switch(value);
    else if (key == "reversed")
      view.reversed = to_switch(value);
    else if (key == "smooth")
      view.shading = to_switch(value) ? model::Shading::smooth : model::Shading::flat;
    else
      throw UsageError("\"" + key + "\" is nothing that a view has");
  }
  return {view};
}

std::string view_line(const model::ViewSettings& view) {
  const auto word = [](bool on) { return on ? "on" : "off"; };
  std::string line = "view color=" + std::string(kColorNames.at(static_cast<std::size_t>(view.coloring))) +
                     " range=" + (view.range_mode == model::RangeMode::current ? "current" : "run") +
                     " wire=" + word(view.wire) + " legend=" + word(view.legend) +
                     " reasons=" + word(view.reasons) + " reversed=" + word(view.reversed) +
                     " smooth=" + word(view.shading == model::Shading::smooth);
  if (!view.color_map.empty()) line += " map=" + view.color_map;
  return line;
}

model::SetBreakpoints with_breakpoint(Words words, const model::Session& session, model::BreakAction action) {
  require(words, 1, 100);
  std::string text;
  for (const std::string& word : words.subspan(1)) text += (text.empty() ? "" : " ") + word;
  model::SetBreakpoints command{session.breakpoints};
  command.breakpoints.push_back(model::make_breakpoint(text, action));
  const model::Breakpoint& made = command.breakpoints.back();
  if (!made.predicate)
    throw UsageError(text + ": column " + std::to_string(made.mistake_column) + ": " + made.mistake);
  return command;
}

std::string breaks_lines(const model::SetBreakpoints& command) {
  std::string lines = "no-breaks";
  for (const model::Breakpoint& point : command.breakpoints)
    if (point.enabled && point.predicate)
      lines += (point.action == model::BreakAction::stop ? "\nbreak " : "\nlog ") + quote_word(point.text);
  return lines;
}

std::string stage_line(const model::SetStage& command) {
  if (!command.stage) return "stage off";
  std::string line = "stage " + std::string(kStageNames.at(static_cast<std::size_t>(command.stage->kind)));
  if (command.stage->kind == model::StageKind::control) line += " " + std::to_string(command.stage->pass + 1);
  return line;
}

std::string list_line(std::string line, const std::vector<unsigned>& numbers) {
  for (const unsigned n : numbers) line += " " + std::to_string(n);
  return line;
}

/// One function for each command that a script can hold.
struct ToLine {
  std::string operator()(const model::OpenFile& c) const { return path_line("open ", c.path); }
  std::string operator()(const model::OpenTrace& c) const { return path_line("open ", c.path); }
  std::string operator()(const model::SaveFile& c) const { return path_line("save ", c.path); }
  std::string operator()(const model::SaveTrace& c) const { return path_line("save-trace ", c.path); }
  std::string operator()(const model::AddTrace& c) const { return path_line("add-trace ", c.path); }
  std::string operator()(const model::SetSmoothing& c) const {
    std::string line = "set";
    for (const std::string& word : model::to_words(c.settings)) line += " " + quote_word(word);
    return line;
  }
  std::string operator()(const model::SetView& c) const { return view_line(c.view); }
  std::string operator()(const model::Run&) const { return "run"; }
  std::string operator()(const model::Step&) const { return "step"; }
  std::string operator()(const model::StepBack&) const { return "step-back"; }
  std::string operator()(const model::Reset&) const { return "reset"; }
  std::string operator()(const model::Undo&) const { return "undo"; }
  std::string operator()(const model::Redo&) const { return "redo"; }
  std::string operator()(const model::SelectNextWorst&) const { return "next-worst"; }
  std::string operator()(const model::ClearSelection&) const { return "clear"; }
  std::string operator()(const model::Seek& c) const {
    return "seek " + std::to_string(c.iteration) + (c.branch ? " " + std::to_string(*c.branch) : "");
  }
  std::string operator()(const model::SetStage& c) const { return stage_line(c); }
  std::string operator()(const model::StepStage& c) const {
    return c.direction > 0 ? "next-stage" : "previous-stage";
  }
  std::string operator()(const model::SelectVertex& c) const { return "vertex " + std::to_string(c.vertex); }
  std::string operator()(const model::SelectTriangle& c) const {
    return "triangle " + std::to_string(c.triangle);
  }
  std::string operator()(const model::SelectLimited& c) const {
    return "limited " + (c.bit ? std::string(limit_name(static_cast<Limit>(1U << *c.bit))) : "none");
  }
  std::string operator()(const model::SetWorstBy& c) const {
    return "worst-by " + std::to_string(static_cast<unsigned>(c.by));
  }
  std::string operator()(const model::TogglePin& c) const { return "pin " + std::to_string(c.vertex); }
  std::string operator()(const model::SetBreakpoints& c) const { return breaks_lines(c); }
  std::string operator()(const model::SetStepBudget& c) const {
    return "memory " + std::to_string(c.bytes >> 20U);
  }
  std::string operator()(const model::ShowBranches& c) const { return list_line("beside", c.branches); }
  std::string operator()(const model::CompareBranches& c) const {
    return list_line("compare", {c.first, c.second});
  }
  std::string operator()(const model::Teach&) const { return "teach"; }
  std::string operator()(const model::SetTask& c) const {
    return c.task == model::Task::move ? "motion" : "motion off";
  }
  std::string operator()(const model::SetMotion& c) const { return editor::to_line(c); }
  std::string operator()(const model::OpenSphere& c) const { return editor::to_line(c); }
  std::string operator()(const model::Move& c) const {
    return "motion run" + (c.steps > 0 ? " " + std::to_string(c.steps) : "");
  }
  // What only the program itself asks for, and what has no effect that lasts.
  std::string operator()(const model::EndEdit&) const { return {}; }
  std::string operator()(const model::Pause&) const { return {}; }
  std::string operator()(const model::Cancel&) const { return {}; }
  std::string operator()(const model::CopyCommandLine&) const { return {}; }
  std::string operator()(const model::Say&) const { return {}; }
  std::string operator()(const model::SetRecent&) const { return {}; }
  std::string operator()(const model::Collect&) const { return {}; }

 private:
  static std::string path_line(const char* word, const std::filesystem::path& path) {
    return word + quote_word(path.string());
  }
};

using Parser = std::function<model::Command(Words, const model::Session&, const std::filesystem::path&)>;

template <typename C>
Parser plain() {
  return [](Words words, const model::Session&, const std::filesystem::path&) -> model::Command {
    require(words, 0, 0);
    return C{};
  };
}

template <typename C>
Parser with_path() {
  return [](Words words, const model::Session&, const std::filesystem::path& folder) -> model::Command {
    require(words, 1, 1);
    return C{folder / words[1]};
  };
}

template <typename C>
Parser with_number() {
  return [](Words words, const model::Session&, const std::filesystem::path&) -> model::Command {
    require(words, 1, 1);
    return C{to_number(words[1])};
  };
}

model::Command to_settings(Words words, const model::Session& session) {
  const auto settings = model::from_words(words.subspan(1), session.smoothing);
  if (!settings) throw UsageError("set: an option or a value is not one of the editor's settings");
  return model::SetSmoothing{*settings, "Settings"};
}

model::Command to_seek(Words words) {
  require(words, 1, 2);
  model::Seek seek{to_number(words[1]), {}};
  if (words.size() > 2) seek.branch = to_number(words[2]);
  return seek;
}

std::vector<unsigned> numbers_after(Words words) {
  std::vector<unsigned> numbers;
  for (const std::string& word : words.subspan(1)) numbers.push_back(to_number(word));
  return numbers;
}

const std::vector<std::pair<std::string_view, Parser>>& parsers() {
  using std::filesystem::path;
  using S = model::Session;
  static const std::vector<std::pair<std::string_view, Parser>> kParsers{
      {"open", with_path<model::OpenFile>()},
      {"save", with_path<model::SaveFile>()},
      {"save-trace", with_path<model::SaveTrace>()},
      {"add-trace", with_path<model::AddTrace>()},
      {"step", plain<model::Step>()},
      {"step-back", plain<model::StepBack>()},
      {"reset", plain<model::Reset>()},
      {"undo", plain<model::Undo>()},
      {"redo", plain<model::Redo>()},
      {"next-worst", plain<model::SelectNextWorst>()},
      {"clear", plain<model::ClearSelection>()},
      {"teach", plain<model::Teach>()},
      {"vertex", with_number<model::SelectVertex>()},
      {"triangle", with_number<model::SelectTriangle>()},
      {"pin", with_number<model::TogglePin>()},
      {"set", [](Words w, const S& s, const path&) { return to_settings(w, s); }},
      {"seek", [](Words w, const S&, const path&) { return to_seek(w); }},
      {"stage", [](Words w, const S&, const path&) -> model::Command { return to_stage(w); }},
      {"next-stage", [](Words, const S&, const path&) -> model::Command { return model::StepStage{1}; }},
      {"previous-stage", [](Words, const S&, const path&) -> model::Command { return model::StepStage{-1}; }},
      {"limited", [](Words w, const S&, const path&) -> model::Command { return to_limited(w); }},
      {"view", [](Words w, const S& s, const path&) -> model::Command { return to_view(w, s.view); }},
      {"break",
       [](Words w, const S& s, const path&) -> model::Command {
         return with_breakpoint(w, s, model::BreakAction::stop);
       }},
      {"log",
       [](Words w, const S& s, const path&) -> model::Command {
         return with_breakpoint(w, s, model::BreakAction::log);
       }},
      {"no-breaks", [](Words, const S&, const path&) -> model::Command { return model::SetBreakpoints{}; }},
      {"beside",
       [](Words w, const S&, const path&) -> model::Command {
         return model::ShowBranches{numbers_after(w)};
       }},
      {"compare",
       [](Words w, const S&, const path&) -> model::Command {
         require(w, 2, 2);
         return model::CompareBranches{to_number(w[1]), to_number(w[2])};
       }},
      {"worst-by",
       [](Words w, const S&, const path&) -> model::Command {
         require(w, 1, 1);
         const unsigned by = to_number(w[1]);
         if (by >= model::kWorstBy) throw UsageError("worst-by: there is no " + w[1]);
         return model::SetWorstBy{static_cast<model::WorstBy>(by)};
       }},
      {"memory",
       [](Words w, const S&, const path&) -> model::Command {
         require(w, 1, 1);
         return model::SetStepBudget{std::size_t{to_number(w[1])} << 20U};
       }},
  };
  return kParsers;
}

}  // namespace

std::vector<std::string> split_words(std::string_view line) {
  std::vector<std::string> words;
  bool inside = false;  // a word
  char quote = '\0';
  for (const char c : line) {
    if (quote != '\0') {
      if (c == quote)
        quote = '\0';
      else
        words.back() += c;
      continue;
    }
    if (c == '#' && !inside) break;
    if (c == ' ' || c == '\t' || c == '\r') {
      inside = false;
      continue;
    }
    if (!inside) words.emplace_back();
    inside = true;
    if (c == '"' || c == '\'')
      quote = c;
    else
      words.back() += c;
  }
  if (quote != '\0') throw UsageError("a quote does not end");
  return words;
}

std::string quote_word(const std::string& word) {
  if (!word.empty() && word.find_first_of(" \t'\"#") == std::string::npos) return word;
  const char quote = word.find('"') == std::string::npos ? '"' : '\'';
  return quote + word + quote;
}

std::string to_line(const model::Command& command) {
  return std::visit(ToLine(), command);
}

std::optional<model::Command> parse_line(Words words, const model::Session& session,
                                         const std::filesystem::path& folder) {
  if (auto command = parse_motion_words(words, session, folder)) return command;
  for (const auto& [name, parser] : parsers())
    if (name == words.front()) return parser(words, session, folder);
  return std::nullopt;
}

std::string to_line(const render::Camera& camera) {
  std::string line = "camera";
  for (const double x : {camera.target.x(), camera.target.y(), camera.target.z(), camera.azimuth_deg,
                         camera.elevation_deg, camera.extent})
    line += " " + real_text(x);
  line += camera.up == render::UpAxis::y ? " y" : " z";
  return line + (camera.projection == render::Projection::perspective ? " perspective" : " orthographic");
}

render::Camera parse_camera_words(Words words) {
  require(words, 8, 8);
  render::Camera camera;
  camera.target = {to_real(words[1]), to_real(words[2]), to_real(words[3])};
  camera.azimuth_deg = to_real(words[4]);
  camera.elevation_deg = to_real(words[5]);
  camera.extent = to_real(words[6]);
  if (!(camera.extent > 0)) throw UsageError("camera: the extent must be positive");
  constexpr std::array<std::string_view, 2> kUp{"y", "z"};
  constexpr std::array<std::string_view, 2> kProjection{"perspective", "orthographic"};
  camera.up = index_of(kUp, words[7]) == 0 ? render::UpAxis::y : render::UpAxis::z;
  camera.projection = index_of(kProjection, words[8]) == 0 ? render::Projection::perspective
                                                           : render::Projection::orthographic;
  return camera;
}

std::span<const ScriptWord> model_words() {
  return kModelWords;
}

}  // namespace isorelax::editor
