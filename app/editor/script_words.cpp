#include "editor/script_words.h"

#include <algorithm>
#include <array>
#include <functional>

#include "editor/motion_words.h"
#include "editor/view_words.h"
#include "editor/word_values.h"
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
    ScriptWord{"set [defaults] OPTION VALUE ...",
               "settings, as for isorelax smooth: set --mu 0.5 --solver newton; what is not named stays, or "
               "is as by default"},
    ScriptWord{"run [N]", "as many iterations as set, or N"},
    ScriptWord{"step, step-back", "one iteration on; one back"},
    ScriptWord{"seek ITERATION [RUN]", "on the timeline; runs count from 1, as the editor shows them"},
    ScriptWord{"stage NAME [ROUND]", "gradient, tangent, proposed, control, moved, or off"},
    ScriptWord{"next-stage, previous-stage", "over the ends of iterations"},
    ScriptWord{"vertex ID, triangle ID", "select it, open the inspector, fly there if it is out of sight"},
    ScriptWord{"worst-by NUMBER, next-worst", "0: what the colours say, ..., in the order of the menu"},
    ScriptWord{"limited NAME", "mark what was limited by: pinned, corner, ..., or none"},
    ScriptWord{"clear", "select nothing"},
    ScriptWord{"pin ID", "hold a vertex, or let it go"},
    ScriptWord{"break PREDICATE", "stop where it holds"},
    ScriptWord{"log PREDICATE", "tell where it holds"},
    ScriptWord{"no-breaks", "remove all of them"},
    ScriptWord{"beside [RUN ...]", "runs shown beside the present one"},
    ScriptWord{"compare RUN RUN", "find where two runs part"},
    ScriptWord{"remove RUN", "a run that no other one began in"},
    ScriptWord{"teach", "the three methods, side by side"},
    ScriptWord{"memory MB", "for full records of steps"},
    ScriptWord{"view KEY=VALUE ...",
               "color=none|angle|max-angle|area|energy, range=run|current|LO:HI, wire=, legend=, "
               "reasons=, smooth=, reversed=on|off, map=NAME"},
    ScriptWord{"reset, undo, redo", ""},
    ScriptWord{"motion [off]", "Run moves the surface; off: it smooths again"},
    ScriptWord{"motion [defaults] OPTION VALUE ...",
               "options of isorelax advect, without dashes: motion field paper preset balanced"},
    ScriptWord{"motion run [N]", "N steps of the motion, or to its end"},
    ScriptWord{"motion sphere [SPEC]", "open a sphere, N[:RADIUS[:X,Y,Z]]; none: the paper's"},
};

constexpr std::array<std::string_view, 5> kStageNames{"gradient", "tangent", "proposed", "control", "moved"};

model::SetStage to_stage(Words words, const model::Session& session) {
  require(words, 1, 2);
  if (words[1] == "off") return {};
  model::Stage stage{static_cast<model::StageKind>(index_of(kStageNames, words[1]))};
  if (words.size() < 3 && stage.kind != model::StageKind::control) return {stage};
  if (stage.kind != model::StageKind::control) throw UsageError("stage: only control has rounds");
  const std::string number = words.size() > 2 ? words[2] : "1";
  const auto round = to_number<unsigned>(number);
  const model::Cursor& at = session.timeline.cursor;
  const model::StepSummary* step = session.timeline.step(at.branch, at.iteration);
  const unsigned rounds = step != nullptr ? step->fold_passes + step->energy_passes : round;
  if (round == 0 || round > rounds)
    throw UsageError(
        "stage: there is no round " + number +
        (rounds == 0 ? ": the step has none at all" : ": they count from 1 to " + std::to_string(rounds)));
  stage.pass = round - 1;
  return {stage};
}

model::SelectLimited to_limited(Words words) {
  require(words, 1, 1);
  for (unsigned bit = 0; bit < kLimitBits; ++bit)
    if (limit_name(limit_of_bit(bit)) == words[1]) return {bit};
  if (words[1] != "none") throw UsageError("\"" + words[1] + "\" is nothing that limits a vertex");
  return {};
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
  if (session.document) {
    const TriangleMesh& mesh = session.document->mesh();
    made.predicate->check(mesh.positions.size(), mesh.triangles.size());
  }
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

/// A name that means the same in every folder: a script takes others from its own, wherever that is.
std::string whole(const std::filesystem::path& path) {
  std::error_code error;
  const auto absolute = std::filesystem::absolute(path, error);
  return (error ? path : absolute.lexically_normal()).string();
}

/// All of them, whatever was set before; those, too, that the method has no use for but the colours may.
std::string settings_line(const model::SmoothingSettings& settings) {
  std::string line = "set defaults";
  if (settings.method != model::Method::near_isometry)
    line += " --method " + std::string(model::method_option(settings.method));
  model::SmoothingSettings others = settings;
  others.method = model::Method::near_isometry;
  if (!others.reference_file.empty()) others.reference_file = whole(others.reference_file);
  for (const std::string& word : model::to_words(others)) line += " " + quote_word(word);
  return line;
}

/// Runs count from 1, as the editor shows them.
std::string run_word(unsigned run) {
  return std::to_string(run + 1);
}

std::string runs_line(std::string line, const std::vector<unsigned>& runs) {
  for (const unsigned run : runs) line += " " + run_word(run);
  return line;
}

/// One function for each command that a script can hold.
struct ToLine {
  std::string operator()(const model::OpenFile& c) const { return path_line("open ", c.path); }
  std::string operator()(const model::OpenTrace& c) const { return path_line("open ", c.path); }
  std::string operator()(const model::SaveFile& c) const { return path_line("save ", c.path); }
  std::string operator()(const model::SaveTrace& c) const { return path_line("save-trace ", c.path); }
  std::string operator()(const model::AddTrace& c) const { return path_line("add-trace ", c.path); }
  std::string operator()(const model::SetSmoothing& c) const { return settings_line(c.settings); }
  std::string operator()(const model::SetView& c) const { return editor::to_line(c); }
  std::string operator()(const model::Run&) const { return "run"; }
  std::string operator()(const model::Step&) const { return "step"; }
  std::string operator()(const model::StepBack&) const { return "step-back"; }
  std::string operator()(const model::Reset&) const { return "reset"; }
  std::string operator()(const model::Undo&) const { return "undo"; }
  std::string operator()(const model::Redo&) const { return "redo"; }
  std::string operator()(const model::SelectNextWorst&) const { return "next-worst"; }
  std::string operator()(const model::ClearSelection&) const { return "clear"; }
  std::string operator()(const model::Seek& c) const {
    return "seek " + std::to_string(c.iteration) + (c.branch ? " " + run_word(*c.branch) : "");
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
    return "limited " + (c.bit ? std::string(limit_name(limit_of_bit(*c.bit))) : "none");
  }
  std::string operator()(const model::SetWorstBy& c) const {
    return "worst-by " + std::to_string(static_cast<unsigned>(c.by));
  }
  std::string operator()(const model::TogglePin& c) const { return "pin " + std::to_string(c.vertex); }
  std::string operator()(const model::SetBreakpoints& c) const { return breaks_lines(c); }
  std::string operator()(const model::SetStepBudget& c) const {
    return "memory " + std::to_string(c.bytes >> 20U);
  }
  std::string operator()(const model::ShowBranches& c) const { return runs_line("beside", c.branches); }
  std::string operator()(const model::CompareBranches& c) const {
    return runs_line("compare", {c.first, c.second});
  }
  std::string operator()(const model::RemoveRun& c) const { return runs_line("remove", {c.branch}); }
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
    return word + quote_word(whole(path));
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

model::Command step_stage(Words words, int direction) {
  require(words, 0, 0);
  return model::StepStage{direction};
}

template <typename C>
Parser with_path() {
  return [](Words words, const model::Session&, const std::filesystem::path& folder) -> model::Command {
    require(words, 1, 1);
    return C{folder / words[1]};
  };
}

/// A number that must be below a count of what there is.
unsigned to_number_of(const std::string& word, const std::string& what, std::size_t count) {
  const unsigned value = to_number<unsigned>(word);
  if (count == 0) throw UsageError("there is no " + what + " " + word + ": there is none at all");
  if (value >= count)
    throw UsageError("there is no " + what + " " + word + ": the last is " + std::to_string(count - 1));
  return value;
}

unsigned to_run(const std::string& word, const model::Session& session) {
  const std::size_t count = session.timeline.branches.size();
  const unsigned run = to_number<unsigned>(word);
  if (run >= 1 && run <= count) return run - 1;
  throw UsageError("there is no run " + word + ": " +
                   (count == 0 ? "there is none at all" : "they count from 1 to " + std::to_string(count)));
}

template <typename C>
model::Command of_vertex(Words words, const model::Session& session) {
  require(words, 1, 1);
  return C{
      to_number_of(words[1], "vertex", session.document ? session.document->mesh().positions.size() : 0)};
}

model::Command of_triangle(Words words, const model::Session& session) {
  require(words, 1, 1);
  return model::SelectTriangle{
      to_number_of(words[1], "triangle", session.document ? session.document->mesh().triangles.size() : 0)};
}

model::Command to_settings(Words words, const model::Session& session, const std::filesystem::path& folder) {
  std::vector<std::string> unknown;
  const bool anew = words.size() > 1 && words[1] == "defaults";
  const model::SmoothingSettings others = anew ? model::SmoothingSettings{} : session.smoothing;
  model::SmoothingSettings settings = model::nearest_settings(words.subspan(anew ? 2 : 1), others, unknown);
  const bool names_file = settings.reference == model::ReferenceKind::file &&
                          std::ranges::find(words, "--reference") != words.end();
  if (names_file) settings.reference_file = (folder / settings.reference_file).string();
  if (!unknown.empty())
    throw UsageError("set: \"" + unknown.front() +
                     "\": no setting of the editor, or no value for it; "
                     "isorelax smooth --help tells what each takes");
  return model::SetSmoothing{settings, "Settings"};
}

model::Command to_seek(Words words, const model::Session& session) {
  require(words, 1, 2);
  const auto& branches = session.timeline.branches;
  model::Seek seek;
  if (words.size() > 2) seek.branch = to_run(words[2], session);
  const unsigned branch = seek.branch.value_or(session.timeline.cursor.branch);
  const std::size_t last = branches.empty() ? 0 : session.shared_last(branch);
  seek.iteration = to_number_of(words[1], "iteration", last + 1);
  return seek;
}

std::vector<unsigned> to_runs(Words words, const model::Session& session) {
  std::vector<unsigned> runs;
  for (const std::string& word : words.subspan(1)) runs.push_back(to_run(word, session));
  return runs;
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
      {"vertex", [](Words w, const S& s, const path&) { return of_vertex<model::SelectVertex>(w, s); }},
      {"triangle", [](Words w, const S& s, const path&) { return of_triangle(w, s); }},
      {"pin", [](Words w, const S& s, const path&) { return of_vertex<model::TogglePin>(w, s); }},
      {"set", [](Words w, const S& s, const path& f) { return to_settings(w, s, f); }},
      {"seek", [](Words w, const S& s, const path&) { return to_seek(w, s); }},
      {"stage", [](Words w, const S& s, const path&) -> model::Command { return to_stage(w, s); }},
      {"next-stage", [](Words w, const S&, const path&) { return step_stage(w, 1); }},
      {"previous-stage", [](Words w, const S&, const path&) { return step_stage(w, -1); }},
      {"limited", [](Words w, const S&, const path&) -> model::Command { return to_limited(w); }},
      {"view",
       [](Words w, const S& s, const path&) -> model::Command { return parse_view_words(w, s.view); }},
      {"break",
       [](Words w, const S& s, const path&) -> model::Command {
         return with_breakpoint(w, s, model::BreakAction::stop);
       }},
      {"log",
       [](Words w, const S& s, const path&) -> model::Command {
         return with_breakpoint(w, s, model::BreakAction::log);
       }},
      {"no-breaks", plain<model::SetBreakpoints>()},
      {"beside",
       [](Words w, const S& s, const path&) -> model::Command { return model::ShowBranches{to_runs(w, s)}; }},
      {"compare",
       [](Words w, const S& s, const path&) -> model::Command {
         require(w, 2, 2);
         const std::vector<unsigned> runs = to_runs(w, s);
         return model::CompareBranches{runs[0], runs[1]};
       }},
      {"remove",
       [](Words w, const S& s, const path&) -> model::Command {
         require(w, 1, 1);
         return model::RemoveRun{to_run(w[1], s)};
       }},
      {"worst-by",
       [](Words w, const S&, const path&) -> model::Command {
         require(w, 1, 1);
         const unsigned by = to_number<unsigned>(w[1]);
         if (by >= model::kWorstBy) throw UsageError("worst-by: there is no " + w[1]);
         return model::SetWorstBy{static_cast<model::WorstBy>(by)};
       }},
      {"memory",
       [](Words w, const S&, const path&) -> model::Command {
         require(w, 1, 1);
         return model::SetStepBudget{std::size_t{to_number<unsigned>(w[1])} << 20U};
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
  std::string quoted = "\"";
  for (const char c : word) quoted += c == '"' ? std::string("\"'\"'\"") : std::string(1, c);
  return quoted + "\"";
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

std::span<const ScriptWord> model_words() {
  return kModelWords;
}

}  // namespace isorelax::editor
