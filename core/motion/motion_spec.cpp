#include "motion/motion_spec.h"

#include <cmath>

#include "io/text_in.h"
#include "io/text_out.h"
#include "motion/expression_field.h"
#include "motion/sampled_field.h"

namespace isorelax {
namespace {

std::optional<double> plain_number(std::string_view text) {
  double value = 0;
  if (!read_number(text, value) || !std::isfinite(value)) return std::nullopt;
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

/// The number behind the colon; without a colon `otherwise`.
double number_behind(std::size_t colon, std::string_view whole, double otherwise, const char* what) {
  if (colon == whole.size()) return otherwise;
  const std::string_view rest = whole.substr(colon + 1);
  if (rest.empty()) throw UsageError(std::string(whole.substr(0, colon)) + ": no " + what + " is given");
  return number_in(rest, whole);
}

void read_rigid(std::string_view rest, std::string_view whole, RigidMotion& rigid) {
  rigid = {};
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
}

void read_expressions(std::string_view rest, std::string_view whole, std::array<std::string, 3>& parts) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t end = i < 2 ? rest.find(';') : rest.size();
    if (end == std::string_view::npos)
      throw UsageError(std::string(whole) + ": expected three expressions separated by semicolons");
    parts[i] = rest.substr(0, end);
    rest.remove_prefix(std::min(rest.size(), end + 1));
  }
}

std::string vector_text(const Vec3& v) {
  return digits_of(v[0]) + "," + digits_of(v[1]) + "," + digits_of(v[2]);
}

std::string rigid_text(const RigidMotion& rigid) {
  std::string text = "rigid:" + vector_text(rigid.rotation);
  if (rigid.centre != Vec3::Zero()) text += "@" + vector_text(rigid.centre);
  if (rigid.velocity != Vec3::Zero()) text += "+" + vector_text(rigid.velocity);
  return text;
}

Motion along_normal(const std::string& text) {
  Motion motion;
  if (const auto constant = plain_number(text)) {
    motion.constant_speed = constant;
    motion.speed = [value = *constant](const Vec3&, double) { return value; };
    return motion;
  }
  const auto speed = std::make_shared<Expression>(text);
  motion.speed = [speed](const Vec3& x, double t) { return speed->at(x, t); };
  return motion;
}

}  // namespace

FieldSpec parse_field(std::string_view text, const FieldSpec& others) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::string_view name = text.substr(0, colon);
  const std::string_view rest = text.substr(std::min(text.size(), colon + 1));
  FieldSpec spec = others;
  if (name == "paper" || name == "enright") {
    spec.kind = name == "paper" ? FieldKind::paper : FieldKind::enright;
    spec.period = number_behind(colon, text, FieldSpec{}.period, "period");
    if (!(spec.period > 0)) throw UsageError(std::string(text) + ": the period is not positive");
  } else if (name == "rigid") {
    spec.kind = FieldKind::rigid;
    read_rigid(rest, text, spec.rigid);
  } else if (name == "shear") {
    spec.kind = FieldKind::shear;
    spec.rate = number_behind(colon, text, FieldSpec{}.rate, "rate");
  } else if (name == "normal" && colon < text.size()) {
    spec.kind = FieldKind::normal;
    spec.speed = rest;
  } else if (name == "expr") {
    spec.kind = FieldKind::expressions;
    read_expressions(rest, text, spec.expressions);
  } else if (name == "file" && colon < text.size()) {
    spec.kind = FieldKind::file;
    spec.path = rest;
  } else {
    throw UsageError(std::string(text) +
                     ": expected paper[:T], enright[:T], rigid:WX,WY,WZ[@CX,CY,CZ][+VX,VY,VZ], shear:RATE, "
                     "normal:SPEED, expr:U;V;W or file:PATH");
  }
  return spec;
}

std::string to_text(const FieldSpec& spec) {
  switch (spec.kind) {
    case FieldKind::paper:
      return "paper:" + digits_of(spec.period);
    case FieldKind::enright:
      return "enright:" + digits_of(spec.period);
    case FieldKind::rigid:
      return rigid_text(spec.rigid);
    case FieldKind::shear:
      return "shear:" + digits_of(spec.rate);
    case FieldKind::normal:
      return "normal:" + spec.speed;
    case FieldKind::expressions:
      return "expr:" + spec.expressions[0] + ";" + spec.expressions[1] + ";" + spec.expressions[2];
    case FieldKind::file:
      break;
  }
  return "file:" + spec.path;
}

Motion make_motion(const FieldSpec& spec) {
  Motion motion;
  switch (spec.kind) {
    case FieldKind::paper:
    case FieldKind::enright:
      motion.field =
          spec.kind == FieldKind::paper ? make_paper_field(spec.period) : make_enright_field(spec.period);
      motion.keeps_volume = true;
      motion.period = spec.period;
      break;
    case FieldKind::rigid:
      motion.field = make_rigid_field(spec.rigid);
      motion.place = [rigid = spec.rigid](const Vec3& x, double t) { return place_after(x, rigid, t); };
      motion.keeps_volume = true;
      break;
    case FieldKind::shear: {
      ShearMotion shear;
      shear.rate = spec.rate;
      motion.field = make_shear_field(shear);
      motion.place = [shear](const Vec3& x, double t) { return place_after(x, shear, t); };
      motion.keeps_volume = true;
      break;
    }
    case FieldKind::normal:
      if (spec.speed.empty()) throw UsageError("normal: no speed is given");
      return along_normal(spec.speed);
    case FieldKind::expressions:
      for (const std::string& part : spec.expressions)
        if (part.empty())
          throw UsageError(to_text(spec) + ": expected three expressions separated by semicolons");
      motion.field = make_expression_field(spec.expressions);
      break;
    case FieldKind::file:
      if (spec.path.empty()) throw UsageError("file: no sampled field was chosen");
      motion.field = read_sampled_field(spec.path);
      break;
  }
  return motion;
}

Motion parse_motion(std::string_view text) {
  return make_motion(parse_field(text));
}

}  // namespace isorelax
