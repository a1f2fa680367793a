#pragma once

#include <array>
#include <memory>
#include <string>

#include "motion/velocity_field.h"

namespace isorelax {

/// A number given by an expression in x, y, z and t (muParser: + - * / ^, comparisons, ?:, sin, cos, tan,
/// exp, ln, sqrt, abs, min, max ..., the constants pi and e).
class Expression {
 public:
  /// Throws UsageError: the text, the column and what is wrong there.
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
