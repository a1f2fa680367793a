#include "model/arguments.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>

#include "io/mesh_file.h"
#include "io/text_in.h"
#include "io/text_out.h"
#include "mesh/error.h"
#include "model/command.h"

namespace isorelax::model {
namespace {

std::string reference_word(const SmoothingSettings& s) {
  switch (s.reference) {
    case ReferenceKind::mean_area:
      return "equilateral";
    case ReferenceKind::edge_length:
      return "equilateral:" + digits_of(s.edge_length);
    case ReferenceKind::initial:
      return "initial";
    case ReferenceKind::file:
      break;
  }
  return s.reference_file;
}

constexpr std::array<std::string_view, 3> kBoundaryWords{"fixed", "slide", "free"};

std::string features_word(const SmoothingSettings& s) {
  switch (s.features) {
    case FeatureRule::automatic:
      return "auto";
    case FeatureRule::none:
      return "none";
    case FeatureRule::angle:
      break;
  }
  return digits_of(s.feature_deg);
}

std::string pin_word(const std::vector<Index>& pinned) {
  std::string word = "vertices:";
  for (const Index v : pinned) word += (word.back() == ':' ? "" : ",") + std::to_string(v);
  return word;
}

std::string reach_word(const SmoothingSettings& s) {
  switch (s.reach) {
    case Reach::nearest:
      return "nearest";
    case Reach::widest:
      return "widest";
    case Reach::any:
      return "inf";
    case Reach::typed:
      break;
  }
  return digits_of(s.max_deviation);
}

bool read_number_between(double low, double high, std::string_view word, double& value) {
  return read_number(word, value) && value >= low && value <= high;
}

/// Which of several words this is.
template <typename Choice, typename NameOf>
bool read_choice(const std::string& word, std::initializer_list<Choice> choices, const NameOf& name,
                 Choice& value) {
  const auto* found = std::ranges::find_if(choices, [&](Choice c) { return name(c) == word; });
  if (found == choices.end()) return false;
  value = *found;
  return true;
}

bool read_reference(const std::string& word, SmoothingSettings& s) {
  constexpr std::string_view kEdge = "equilateral:";
  if (word == "equilateral") {
    s.reference = ReferenceKind::mean_area;
  } else if (word.starts_with(kEdge)) {
    s.reference = ReferenceKind::edge_length;
    return read_number(std::string_view(word).substr(kEdge.size()), s.edge_length) && s.edge_length > 0;
  } else if (word == "initial") {
    s.reference = ReferenceKind::initial;
  } else {
    s.reference = ReferenceKind::file;
    s.reference_file = word;
  }
  return true;
}

bool read_features(const std::string& word, SmoothingSettings& s) {
  if (word == "auto")
    s.features = FeatureRule::automatic;
  else if (word == "none")
    s.features = FeatureRule::none;
  else
    s.features = FeatureRule::angle;
  return s.features != FeatureRule::angle || read_number_between(0, 180, word, s.feature_deg);
}

bool read_pins(const std::string& word, SmoothingSettings& s) {
  constexpr std::string_view kVertices = "vertices:";
  if (!word.starts_with(kVertices)) return false;
  for (std::size_t at = kVertices.size(); at <= word.size();) {
    const std::size_t comma = std::min(word.find(',', at), word.size());
    Index id = 0;
    if (!read_number(std::string_view(word).substr(at, comma - at), id)) return false;
    s.pinned.push_back(id);
    at = comma + 1;
  }
  std::ranges::sort(s.pinned);
  s.pinned.erase(std::unique(s.pinned.begin(), s.pinned.end()), s.pinned.end());
  return true;
}

bool read_reach(const std::string& word, SmoothingSettings& s) {
  if (word == "nearest")
    s.reach = Reach::nearest;
  else if (word == "widest")
    s.reach = Reach::widest;
  else if (word == "inf")
    s.reach = Reach::any;
  else
    s.reach = Reach::typed;
  return s.reach != Reach::typed || (read_number(word, s.max_deviation) && s.max_deviation >= 0);
}

using Reader = std::function<bool(const std::string&, SmoothingSettings&)>;

const std::map<std::string, Reader>& readers() {
  using S = SmoothingSettings;
  constexpr double kLargest = std::numeric_limits<double>::max();
  static const std::map<std::string, Reader> kReaders{
      {"--method",
       [](const std::string& w, S& s) {
         return read_choice(w, {Method::near_isometry, Method::laplacian, Method::angle_based}, method_option,
                            s.method);
       }},
      {"--solver",
       [](const std::string& w, S& s) {
         return read_choice(w, {Solver::automatic, Solver::jacobi, Solver::newton, Solver::lbfgs},
                            solver_option, s.solver);
       }},
      {"--exponent", [](const std::string& w, S& s) { return read_number_between(1, 64, w, s.exponent); }},
      {"--mu", [](const std::string& w, S& s) { return read_number_between(0, 1, w, s.mu_a); }},
      {"--reference", read_reference},
      {"--boundary",
       [](const std::string& w, S& s) {
         return read_choice(
             w, {BoundaryRule::fixed, BoundaryRule::slide, BoundaryRule::free},
             [](BoundaryRule rule) { return kBoundaryWords.at(static_cast<std::size_t>(rule)); }, s.boundary);
       }},
      {"--features", read_features},
      {"--iterations", [](const std::string& w, S& s) { return read_number(w, s.iterations); }},
      {"--tolerance",
       [](const std::string& w, S& s) { return read_number_between(0, kLargest, w, s.tolerance); }},
      {"--pin", read_pins},
      {"--polish",
       [](const std::string& w, S& s) {
         return read_choice(w, {Polish::none, Polish::worst, Polish::mean, Polish::both}, polish_option,
                            s.polish);
       }},
      {"--max-deviation", read_reach},
      // Those that are held stand among the pins.
      {"--marks", [](const std::string&, S&) { return true; }},
      // Results do not depend on it.
      {"--threads", [](const std::string&, S&) { return true; }}};
  return kReaders;
}

}  // namespace

std::vector<std::string> to_words(const SmoothingSettings& s) {
  std::vector<std::string> words;
  const auto add = [&](const char* option, std::string value) {
    words.emplace_back(option);
    words.push_back(std::move(value));
  };
  if (s.method == Method::near_isometry) {
    add("--solver", std::string(solver_option(s.solver)));
    add("--exponent", digits_of(s.exponent));
    add("--mu", digits_of(s.mu_a));
    add("--reference", reference_word(s));
  } else {
    add("--method", std::string(method_option(s.method)));
  }
  add("--boundary", std::string(kBoundaryWords.at(static_cast<std::size_t>(s.boundary))));
  add("--features", features_word(s));
  if (!s.pinned.empty()) add("--pin", pin_word(s.pinned));
  add("--iterations", std::to_string(s.iterations));
  add("--tolerance", digits_of(s.tolerance));
  if (s.polish != Polish::none) add("--polish", std::string(polish_option(s.polish)));
  add("--max-deviation", reach_word(s));
  return words;
}

SmoothingSettings nearest_settings(std::span<const std::string> words, const SmoothingSettings& others,
                                   std::vector<std::string>& unknown) {
  SmoothingSettings settings = others;
  // Each adds to the others.
  if (std::ranges::find(words, "--pin") != words.end()) settings.pinned.clear();
  for (std::size_t k = 0; k < words.size(); k += 2) {
    const std::string value = k + 1 < words.size() ? words[k + 1] : std::string();
    const auto reader = readers().find(words[k]);
    SmoothingSettings read = settings;
    if (reader != readers().end() && k + 1 < words.size() && reader->second(value, read))
      settings = std::move(read);
    else
      unknown.push_back(value.empty() ? words[k] : words[k] + " " + value);
  }
  return settings;
}

std::optional<SmoothingSettings> from_words(std::span<const std::string> words,
                                            const SmoothingSettings& others) {
  std::vector<std::string> unknown;
  const SmoothingSettings settings = nearest_settings(words, others, unknown);
  return unknown.empty() ? std::optional(settings) : std::nullopt;
}

SmoothingSettings settings_of(const RunWords& words) {
  if (const auto settings = from_words(words.arguments)) return *settings;
  std::string text;
  for (const std::string& word : words.arguments) text += (text.empty() ? "" : " ") + word;
  throw UsageError("the run was made with \"" + text + "\", which the editor has no settings for");
}

Trace about(const Document& document, const SmoothingSettings& settings) {
  Trace trace;
  trace.program = "isorelax " ISORELAX_VERSION;
  trace.input = document.path.string();
  trace.arguments = to_words(settings);
  if (settings.reference == ReferenceKind::file)
    trace.resources.push_back({settings.reference_file, hash_of(read_bytes(settings.reference_file))});
  return trace;
}

}  // namespace isorelax::model
