#include "motion/expression_field.h"

#include <muParser.h>

#include <algorithm>
#include <mutex>
#include <numbers>
#include <utility>
#include <vector>

namespace isorelax {
namespace {

/// Where muParser would assign to a variable: an equals sign that is part of no comparison.
std::size_t assignment_in(std::string_view text) {
  for (std::size_t at = text.find('='); at != std::string_view::npos; at = text.find('=', at + 1)) {
    if (at + 1 < text.size() && text[at + 1] == '=') {
      ++at;
      continue;
    }
    if (at == 0 || std::string_view("<>!").find(text[at - 1]) == std::string_view::npos) return at;
  }
  return std::string_view::npos;
}

/// muParser counts from 0 and puts a space behind the text, which it may name as the place; its reasons tell
/// the place too.
ExpressionError error_of(const std::string& text, const mu::ParserError& error) {
  const std::size_t position = static_cast<std::size_t>(std::max(0, error.GetPos()));
  std::string reason = error.GetMsg();
  for (const std::string_view place : {" found at position", " at position", " at expression position"})
    reason.erase(std::min(reason.find(place), reason.size()));
  return {text, std::min(position, text.size()) + 1, reason};
}

}  // namespace

/// A parser holds the variables it reads: every thread takes one of its own for the time of an evaluation.
class Expression::Pool {
 public:
  explicit Pool(std::string text) : text_(std::move(text)) { give_back(make()); }

  double evaluate(const Vec3& x, double t) {
    std::unique_ptr<Bound> bound = take();
    bound->values = {x[0], x[1], x[2], t};
    double value = 0;
    try {
      value = bound->parser.Eval();
    } catch (const mu::ParserError& error) {
      throw UsageError(text_ + ": " + error.GetMsg());
    }
    give_back(std::move(bound));
    return value;
  }

 private:
  struct Bound {
    mu::Parser parser;
    std::array<double, 4> values{};
  };

  [[nodiscard]] std::unique_ptr<Bound> make() const {
    if (const std::size_t at = assignment_in(text_); at != std::string_view::npos)
      throw ExpressionError(text_, at + 1, "nothing can be assigned; a comparison is ==");
    auto bound = std::make_unique<Bound>();
    try {
      const std::array<const char*, 4> names = {"x", "y", "z", "t"};
      for (std::size_t i = 0; i < names.size(); ++i) bound->parser.DefineVar(names[i], &bound->values[i]);
      bound->parser.DefineConst("pi", std::numbers::pi);
      bound->parser.DefineConst("e", std::numbers::e);
      bound->parser.SetExpr(text_);
      static_cast<void>(bound->parser.Eval());
      if (bound->parser.GetNumResults() != 1) throw ExpressionError(text_, 1, "expected one expression");
    } catch (const mu::ParserError& error) {
      throw error_of(text_, error);
    }
    return bound;
  }

  std::unique_ptr<Bound> take() {
    {
      const std::lock_guard lock(mutex_);
      if (!free_.empty()) {
        std::unique_ptr<Bound> bound = std::move(free_.back());
        free_.pop_back();
        return bound;
      }
    }
    return make();
  }

  void give_back(std::unique_ptr<Bound> bound) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(bound));
  }

  std::string text_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Bound>> free_;
};

namespace {

class ExpressionField final : public VelocityField {
 public:
  explicit ExpressionField(const std::array<std::string, 3>& texts)
      : parts_{Expression(texts[0]), Expression(texts[1]), Expression(texts[2])} {}
  [[nodiscard]] Vec3 at(const Vec3& x, double t) const override {
    return {parts_[0].at(x, t), parts_[1].at(x, t), parts_[2].at(x, t)};
  }

 private:
  std::array<Expression, 3> parts_;
};

}  // namespace

Expression::Expression(const std::string& text) : pool_(std::make_unique<Pool>(text)) {}
Expression::~Expression() = default;
Expression::Expression(Expression&& other) noexcept = default;
Expression& Expression::operator=(Expression&& other) noexcept = default;

double Expression::at(const Vec3& x, double t) const {
  return pool_->evaluate(x, t);
}

std::unique_ptr<VelocityField> make_expression_field(const std::array<std::string, 3>& texts) {
  return std::make_unique<ExpressionField>(texts);
}

}  // namespace isorelax
