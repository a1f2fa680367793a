#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace isorelax::cli {

/// Two columns for people: a name and a value, the values aligned.
class Table {
 public:
  void row(std::string name, std::string value) { rows_.emplace_back(std::move(name), std::move(value)); }
  [[nodiscard]] std::string text() const;

 private:
  std::vector<std::pair<std::string, std::string>> rows_;
};

/// A sentence in lines of up to 110 characters, the first one after "- ".
[[nodiscard]] std::string bullet(std::string_view sentence);

/// A number for people: six significant digits ("37.2145", "1.2e-05", "inf").
[[nodiscard]] std::string number_text(double value);

}  // namespace isorelax::cli
