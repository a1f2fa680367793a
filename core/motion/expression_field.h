#pragma once

#include <array>
#include <memory>
#include <string>

#include "motion/velocity_field.h"

namespace isorelax {

/// An expression that cannot be read, and where: what() is the text, the column and the reason.
class ExpressionError : public UsageError {
 public:
  ExpressionError(const std::string& text, std::size_t column, const std::string& reason)
      : UsageError(text + ": column " + std::to_string(column) + ": " + reason),
        column_(column),
        reason_(reason) {}
  [[nodiscard]] std::size_t column() const { return column_; }  ///< from 1
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  std::size_t column_;
  std::string reason_;
};

/// A number given by an expression in x, y, z and t (muParser: + - * / ^, comparisons, ?:, sin, cos, tan,
/// exp, ln, sqrt, abs, min, max ..., the constants pi and e).
class Expression {
 public:
  /// Throws ExpressionError.
  explicit Expression(const std::string& text);
  ~Expression();
  Expression(Expression&& other) noexcept;
  Expression& operator=(Expression&& other) noexcept;

  /// Safe from several threads at once.
  [[nodiscard]] double at(const Vec3& x, double t) const;

 private:
  class Pool;
  std::unique_ptr<Pool> pool_;
};

/// A velocity of three expressions. Throws UsageError.
std::unique_ptr<VelocityField> make_expression_field(const std::array<std::string, 3>& texts);

}  // namespace isorelax
