#include <array>
#include <charconv>
#include <string>
#include <string_view>

#include "model/command.h"

namespace isorelax::model {
namespace {

std::string number(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

// In single quotes unless every character is harmless to a shell.
std::string quoted(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789/._-+=:,@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string reference_option(const SmoothingSettings& s) {
  switch (s.reference) {
    case ReferenceKind::mean_area:
      return "equilateral";
    case ReferenceKind::edge_length:
      return "equilateral:" + number(s.edge_length);
    case ReferenceKind::initial:
      return "initial";
    case ReferenceKind::file:
      break;
  }
  return quoted(s.reference_file);
}

std::string_view boundary_option(BoundaryRule rule) {
  switch (rule) {
    case BoundaryRule::fixed:
      return "fixed";
    case BoundaryRule::slide:
      return "slide";
    case BoundaryRule::free:
      break;
  }
  return "free";
}

std::string features_option(const SmoothingSettings& s) {
  switch (s.features) {
    case FeatureRule::automatic:
      return "auto";
    case FeatureRule::none:
      return "none";
    case FeatureRule::angle:
      break;
  }
  return number(s.feature_deg);
}

}  // namespace

std::string command_line(const Session& session) {
  if (!session.document) return {};
  const SmoothingSettings& s = session.smoothing;
  auto output = session.document->path;
  output.replace_filename(output.stem().string() + "-smooth" + output.extension().string());
  return "isorelax smooth " + quoted(session.document->path.string()) + " -o " + quoted(output.string()) +
         " --solver " + std::string(solver_option(s.solver)) + " --exponent " + number(s.exponent) +
         " --mu " + number(s.mu_a) + " --reference " + reference_option(s) + " --boundary " +
         std::string(boundary_option(s.boundary)) + " --features " + features_option(s) + " --iterations " +
         std::to_string(s.iterations) + " --tolerance " + number(s.tolerance) + " --max-deviation inf";
}

}  // namespace isorelax::model
