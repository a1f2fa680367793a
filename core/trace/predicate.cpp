#include "trace/predicate.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "trace/predicate_names.h"

namespace isorelax {
namespace {

using Value = Predicate::Value;

/// Thrown inside the parser only.
struct Mistake {
  std::size_t column;  // from 1
  std::string reason;
};

double truth(bool holds) {
  return holds ? 1 : 0;
}

double divide(double a, double b) {
  return a / b;
}

/// Recursive descent; each rule returns what it read as a function of the moment.
class Parser {
 public:
  Parser(std::string_view text, std::vector<Predicate::Element>& elements,
         std::vector<Predicate::Named>& named)
      : text_(text), elements_(elements), named_(named) {}

  Value parse() {
    Value value = either();
    skip_space();
    if (at_ < text_.size()) fail("expected an operator or the end");
    return value;
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const { throw Mistake{at_ + 1, reason}; }

  void skip_space() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }

  bool accept(std::string_view symbol) {
    skip_space();
    if (text_.substr(at_, symbol.size()) != symbol) return false;
    at_ += symbol.size();
    return true;
  }

  void expect(std::string_view symbol) {
    if (!accept(symbol)) fail("expected " + std::string(symbol));
  }

  Value either() {
    Value left = both();
    while (accept("||"))
      left = [a = std::move(left), b = both()](const Moment& m) { return truth(a(m) != 0 || b(m) != 0); };
    return left;
  }

  Value both() {
    Value left = comparison();
    while (accept("&&"))
      left = [a = std::move(left), b = comparison()](const Moment& m) {
        return truth(a(m) != 0 && b(m) != 0);
      };
    return left;
  }

  /// Nothing compares with a value that is not there.
  template <typename Compare>
  Value compared(Value left, Compare compare) {
    return [a = std::move(left), b = sum(), compare](const Moment& m) {
      const double x = a(m);
      const double y = b(m);
      return truth(!std::isnan(x) && !std::isnan(y) && compare(x, y));
    };
  }

  Value comparison() {
    Value left = sum();
    if (accept("<=")) return compared(std::move(left), std::less_equal<>());
    if (accept(">=")) return compared(std::move(left), std::greater_equal<>());
    if (accept("==")) return compared(std::move(left), std::equal_to<>());
    if (accept("!=")) return compared(std::move(left), std::not_equal_to<>());
    if (accept("<")) return compared(std::move(left), std::less<>());
    if (accept(">")) return compared(std::move(left), std::greater<>());
    return left;
  }

  template <typename Combine>
  Value combined(Value left, Value right, Combine combine) {
    return
        [a = std::move(left), b = std::move(right), combine](const Moment& m) { return combine(a(m), b(m)); };
  }

  Value sum() {
    Value left = product();
    for (;;) {
      if (accept("+"))
        left = combined(std::move(left), product(), std::plus<>());
      else if (accept("-"))
        left = combined(std::move(left), product(), std::minus<>());
      else
        return left;
    }
  }

  Value product() {
    Value left = sign();
    for (;;) {
      if (accept("*"))
        left = combined(std::move(left), sign(), std::multiplies<>());
      else if (accept("/"))
        left = combined(std::move(left), sign(), divide);
      else
        return left;
    }
  }

  Value sign() {
    if (++depth_ > kDeepest) fail("nested too deeply");
    Value value;
    if (accept("-"))
      value = [a = sign()](const Moment& m) { return -a(m); };
    else if (accept("!"))
      value = [a = sign()](const Moment& m) { return truth(a(m) == 0); };
    else
      value = primary();
    --depth_;
    return value;
  }

  Value primary() {
    skip_space();
    if (accept("(")) {
      Value inside = either();
      expect(")");
      return inside;
    }
    const char c = at_ < text_.size() ? text_[at_] : '\0';
    if ((c >= '0' && c <= '9') || c == '.') return [x = number()](const Moment&) { return x; };
    const std::size_t start = at_;
    const std::string_view word = name();
    if (word.empty()) fail("expected a number or a name");
    if (word == "vertex") return element(word, vertex_fields());
    if (word == "triangle") return element(word, triangle_fields());
    for (const PredicateName& known : predicate_names())
      if (known.name == word) return note(std::string(word), known.value);
    at_ = start;
    fail("unknown name " + std::string(word));
  }

  Value note(std::string name, Value value) {
    if (std::ranges::find(named_, name, &Predicate::Named::name) == named_.end())
      named_.push_back({std::move(name), value});
    return value;
  }

  Value element(std::string_view kind, std::span<const PredicateField> fields) {
    expect("(");
    skip_space();
    const std::size_t column = at_ + 1;
    Index id = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), id);
    if (error != std::errc()) fail("expected an id");
    at_ = static_cast<std::size_t>(end - text_.data());
    const bool is_vertex = kind == "vertex";
    elements_.push_back({is_vertex, id, column});
    expect(")");
    expect(".");
    const std::size_t start = at_;
    const std::string_view word = name();
    for (const PredicateField& field : fields) {
      if (field.name != word) continue;
      const auto read = [id, is_vertex, value = field.value](const Moment& m) {
        const std::size_t count = is_vertex ? m.positions.size() : m.triangles.size();
        return id < count ? value(m, id) : std::numeric_limits<double>::quiet_NaN();
      };
      return note(std::string(kind) + "(" + std::to_string(id) + ")." + std::string(word), read);
    }
    at_ = start;
    std::string known;
    for (const PredicateField& field : fields) known += (known.empty() ? "" : ", ") + std::string(field.name);
    fail("expected one of " + known);
  }

  double number() {
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc()) fail("expected a number");
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }

  std::string_view name() {
    const auto belongs = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    };
    const std::size_t start = at_;
    while (at_ < text_.size() && belongs(text_[at_])) ++at_;
    return text_.substr(start, at_ - start);
  }

  static constexpr int kDeepest = 200;
  std::string_view text_;
  std::vector<Predicate::Element>& elements_;
  std::vector<Predicate::Named>& named_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

template <typename Entry>
void list(std::string& text, const std::string& before, std::span<const Entry> entries) {
  for (const Entry& entry : entries) {
    const std::string name = before + std::string(entry.name);
    text += "  " + name + std::string(name.size() < 24 ? 24 - name.size() : 1, ' ') +
            std::string(entry.meaning) + "\n";
  }
}

}  // namespace

Predicate::Predicate(std::string text) : text_(std::move(text)) {
  try {
    value_ = Parser(text_, elements_, named_).parse();
  } catch (const Mistake& mistake) {
    throw PredicateError(text_, mistake.column, mistake.reason);
  }
}

void Predicate::check(std::size_t vertices, std::size_t triangles) const {
  for (const Element& element : elements_) {
    const std::size_t count = element.is_vertex ? vertices : triangles;
    if (element.id < count) continue;
    throw PredicateError(text_, element.column,
                         "the mesh has " + std::to_string(count) +
                             (element.is_vertex ? " vertices" : " triangles") + ", counted from 0");
  }
}

bool Predicate::holds(const Moment& moment) const {
  const double value = value_(moment);
  return value != 0 && !std::isnan(value);
}

std::string Predicate::values(const Moment& moment) const {
  std::string text;
  for (const Named& named : named_) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), named.value(moment),
                                   std::chars_format::general, 9)
                         .ptr;
    text += (text.empty() ? "" : ", ") + named.name + " = " + std::string(digits.data(), end);
  }
  return text;
}

std::string Predicate::reference() {
  std::string text;
  list(text, "", predicate_names());
  list(text, "vertex(ID).", vertex_fields());
  list(text, "triangle(ID).", triangle_fields());
  return text;
}

}  // namespace isorelax
