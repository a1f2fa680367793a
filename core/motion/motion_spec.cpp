#include "motion/motion_spec.h"

#include <charconv>
#include <cmath>

#include "motion/expression_field.h"
#include "motion/sampled_field.h"

namespace isorelax {
namespace {

constexpr double kPaperPeriod = 3;

std::optional<double> plain_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

double number_in(std::string_view text, std::string_view whole) {
  const auto value = plain_number(text);
  if (!value) throw UsageError(std::string(whole) + ": " + std::string(text) + " is not a number");
  return *value;
}

Vec3 vector_in(std::string_view text, std::string_view whole) {
  Vec3 vector;
  for (int i = 0; i < 3; ++i) {
    const std::size_t comma = i < 2 ? text.find(',') : text.size();
    if (comma == std::string_view::npos)
      throw UsageError(std::string(whole) + ": expected three numbers separated by commas");
    vector[i] = number_in(text.substr(0, comma), whole);
    text.remove_prefix(std::min(text.size(), comma + 1));
  }
  return vector;
}

Motion reversing(std::string_view name, std::string_view rest, std::string_view whole) {
  const double period = rest.empty() ? kPaperPeriod : number_in(rest, whole);
  if (!(period > 0)) throw UsageError(std::string(whole) + ": the period is not positive");
  Motion motion;
  motion.field = name == "paper" ? make_paper_field(period) : make_enright_field(period);
  motion.keeps_volume = true;
  motion.period = period;
  return motion;
}

Motion rigid(std::string_view rest, std::string_view whole) {
  RigidMotion rigid;
  // The sign of an exponent or of a number is no separator.
  std::size_t plus = rest.find('+');
  while (plus != std::string_view::npos && plus > 0 &&
         (rest[plus - 1] == 'e' || rest[plus - 1] == 'E' || rest[plus - 1] == ','))
    plus = rest.find('+', plus + 1);
  if (plus != std::string_view::npos) {
    rigid.velocity = vector_in(rest.substr(plus + 1), whole);
    rest = rest.substr(0, plus);
  }
  if (const std::size_t at = rest.find('@'); at != std::string_view::npos) {
    rigid.centre = vector_in(rest.substr(at + 1), whole);
    rest = rest.substr(0, at);
  }
  rigid.rotation = vector_in(rest, whole);
  Motion motion;
  motion.field = make_rigid_field(rigid);
  motion.keeps_volume = true;
  return motion;
}

Motion along_normal(std::string_view rest) {
  Motion motion;
  if (const auto constant = plain_number(rest)) {
    motion.constant_speed = constant;
    motion.speed = [value = *constant](const Vec3&, double) { return value; };
    return motion;
  }
  const auto speed = std::make_shared<Expression>(std::string(rest));
  motion.speed = [speed](const Vec3& x, double t) { return speed->at(x, t); };
  return motion;
}

Motion expressions(std::string_view rest, std::string_view whole) {
  std::array<std::string, 3> parts;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t end = i < 2 ? rest.find(';') : rest.size();
    if (end == std::string_view::npos || rest.substr(0, end).empty())
      throw UsageError(std::string(whole) + ": expected three expressions separated by semicolons");
    parts[i] = rest.substr(0, end);
    rest.remove_prefix(std::min(rest.size(), end + 1));
  }
  Motion motion;
  motion.field = make_expression_field(parts);
  return motion;
}

}  // namespace

Motion parse_motion(std::string_view text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::string_view name = text.substr(0, colon);
  const std::string_view rest = text.substr(std::min(text.size(), colon + 1));
  if (name == "paper" || name == "enright") return reversing(name, rest, text);
  if (name == "rigid") return rigid(rest, text);
  if (name == "shear") {
    ShearMotion shear;
    shear.rate = rest.empty() ? 1 : number_in(rest, text);
    Motion motion;
    motion.field = make_shear_field(shear);
    motion.keeps_volume = true;
    return motion;
  }
  if (name == "normal" && !rest.empty()) return along_normal(rest);
  if (name == "expr") return expressions(rest, text);
  if (name == "file" && !rest.empty()) {
    Motion motion;
    motion.field = read_sampled_field(std::string(rest));
    return motion;
  }
  throw UsageError(std::string(text) +
                   ": expected paper[:T], enright[:T], rigid:WX,WY,WZ[@CX,CY,CZ][+VX,VY,VZ], shear:RATE, "
                   "normal:SPEED, expr:U;V;W or file:PATH");
}

}  // namespace isorelax
