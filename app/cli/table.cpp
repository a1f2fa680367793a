#include "cli/table.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace isorelax::cli {

std::string Table::text() const {
  std::size_t width = 0;
  for (const auto& [name, value] : rows_) width = std::max(width, name.size());
  std::string text;
  for (const auto& [name, value] : rows_) {
    text.append(name).append(width - name.size() + 2, ' ').append(value).append("\n");
  }
  return text;
}

std::string bullet(std::string_view sentence) {
  constexpr std::size_t kWidth = 108;
  std::string text;
  while (!sentence.empty()) {
    std::size_t end = sentence.size();
    if (end > kWidth) end = sentence.rfind(' ', kWidth);
    text += (text.empty() ? "- " : "  ") + std::string(sentence.substr(0, end)) + "\n";
    sentence.remove_prefix(std::min(sentence.size(), end + 1));
  }
  return text;
}

std::string number_text(double value) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.6g", value);
  return buffer.data();
}

}  // namespace isorelax::cli
