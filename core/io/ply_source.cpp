#include "io/ply_source.h"

#include "io/attribute_access.h"
#include "io/scalar_bytes.h"
#include "mesh/error.h"

namespace isorelax {
PlySource::PlySource(std::string_view bytes, const std::string& name, const PlyHeader& header)
    : bytes_(bytes),
      text_(bytes.substr(header.size), name, {}),
      encoding_(header.encoding),
      position_(header.size) {
  text_.start_after_line(header.lines);
}

double PlySource::text_number(ScalarType type) {
  const std::string_view word = text_.word_across_lines();
  if (word.empty()) {
    fail("the file ends here");
  }
  const std::optional<double> value = parse_double(word);
  if (!value) {
    fail("not a number: " + in_quotes(word));
  }
  const bool whole = !is_real(type);
  if (whole && !fits(*value == 0.0 ? 0.0 : *value, type)) {
    fail(in_quotes(word) + " is not of type " + ply_type_name(type));
  }
  return whole && *value == 0.0 ? 0.0 : *value;
}

double PlySource::number(ScalarType type) {
  if (encoding_ == FileEncoding::text) {
    return text_number(type);
  }
  const std::size_t size = size_of(type);
  if (bytes_.size() - position_ < size) {
    fail("the file ends here");
  }
  const double value =
      load_scalar(bytes_.data() + position_, type,
                  encoding_ == FileEncoding::binary_big_endian ? std::endian::big : std::endian::little);
  position_ += size;
  return value;
}

std::size_t PlySource::list_size(const PlyProperty& list) {
  const double size = number(*list.list_count);
  if (size < 0.0) {
    fail("a list has a negative count");
  }
  const auto count = static_cast<std::size_t>(size);
  if (count > bytes_left() / least_size(list.type) + 1) {
    fail("a list promises " + std::to_string(count) + " numbers, but only " + std::to_string(bytes_left()) +
         " bytes follow");
  }
  return count;
}

void PlySource::skip(ScalarType type, std::size_t count) {
  if (encoding_ == FileEncoding::text) {
    for (std::size_t i = 0; i < count; ++i) {
      static_cast<void>(text_number(type));
    }
    return;
  }
  if (count > bytes_left() / size_of(type)) {
    fail("the file ends here");
  }
  position_ += count * size_of(type);
}

void PlySource::end_row() {
  if (encoding_ == FileEncoding::text) {
    if (const std::string_view word = text_.peek_word(); !word.empty()) {
      fail("more on the line than the element has: " + in_quotes(word));
    }
  }
}

std::string PlySource::describe_rest() {
  element_ = nullptr;
  if (encoding_ == FileEncoding::text) {
    if (!text_.find_word()) {
      return "";
    }
    if (parse_double(text_.peek_word())) {
      fail("more numbers follow than the header promises");
    }
    return "everything after the last element, from " + place() + " on, left out";
  }
  const std::string_view rest = bytes_.substr(position_);
  if (rest.find_first_not_of(" \t\r\n") != std::string_view::npos) {
    fail(std::to_string(rest.size()) + " more bytes follow than the header promises");
  }
  return "";
}

std::size_t PlySource::least_size(ScalarType type) const {
  // A digit and a blank; the very last number has no blank, for which bounds add one.
  return encoding_ == FileEncoding::text ? 2 : size_of(type);
}

std::size_t PlySource::bytes_left() const {
  return encoding_ == FileEncoding::text ? text_.bytes_left() : bytes_.size() - position_;
}

void PlySource::at(const PlyElement& element, std::size_t row) {
  element_ = &element;
  row_ = row;
}

std::string PlySource::place() const {
  return encoding_ == FileEncoding::text ? "line " + std::to_string(text_.line())
                                         : "byte " + std::to_string(position_);
}

void PlySource::fail(const std::string& reason) const {
  std::string what;
  if (element_ != nullptr) {
    what = in_quotes(element_->name) + " " + std::to_string(row_) + " of " + std::to_string(element_->count) +
           ": ";
  }
  throw InputError(one_line(text_.name()), place(), what + reason);
}

}  // namespace isorelax
