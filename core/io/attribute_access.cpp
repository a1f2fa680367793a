#include "io/attribute_access.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "io/polygon_soup.h"
#include "io/text_scanner.h"

namespace isorelax {
namespace {

template <class Integer>
bool fits_integer(double value) {
  return value >= static_cast<double>(std::numeric_limits<Integer>::min()) &&
         value < std::ldexp(1.0, std::numeric_limits<Integer>::digits) && value == std::trunc(value) &&
         !(value == 0.0 && std::signbit(value));
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// The corner attribute as one value per vertex, where all corners of each vertex agree bit for bit; vertices
/// without a corner get zero. None when two corners of a vertex differ or a corner has no value.
std::optional<Attribute> as_vertex_attribute(const TriangleMesh& mesh, const CornerAttribute& corner) {
  const std::size_t width = corner.width;
  Attribute result{corner.name, ScalarType::float64, corner.width, {}};
  result.values.assign(mesh.positions.size() * width, 0.0);
  std::vector<std::uint32_t> source(mesh.positions.size(), kNone);
  for (std::size_t c = 0; c < corner.indices.size(); ++c) {
    const std::uint32_t index = corner.indices[c];
    std::uint32_t& known = source[mesh.triangles[c / 3][c % 3]];
    if (index == kNone) {
      return std::nullopt;
    }
    if (known == kNone) {
      known = index;
      continue;
    }
    for (std::size_t k = 0; known != index && k < width; ++k) {
      if (!same_bits(corner.values[width * known + k], corner.values[width * index + k])) {
        return std::nullopt;
      }
    }
  }
  for (std::size_t v = 0; v < source.size(); ++v) {
    if (source[v] != kNone) {
      std::copy_n(corner.values.begin() + static_cast<std::ptrdiff_t>(width * source[v]), width,
                  result.values.begin() + static_cast<std::ptrdiff_t>(width * v));
    }
  }
  return result;
}

}  // namespace

bool fits(double value, ScalarType type) {
  switch (type) {
    case ScalarType::int8:
      return fits_integer<std::int8_t>(value);
    case ScalarType::uint8:
      return fits_integer<std::uint8_t>(value);
    case ScalarType::int16:
      return fits_integer<std::int16_t>(value);
    case ScalarType::uint16:
      return fits_integer<std::uint16_t>(value);
    case ScalarType::int32:
      return fits_integer<std::int32_t>(value);
    case ScalarType::uint32:
      return fits_integer<std::uint32_t>(value);
    case ScalarType::float32:
      return std::isnan(value) || std::isinf(value) ||
             (std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max()) &&
              static_cast<double>(static_cast<float>(value)) == value);
    case ScalarType::float64:
      return true;
    case ScalarType::int64:
      return fits_integer<std::int64_t>(value);
    case ScalarType::uint64:
      return fits_integer<std::uint64_t>(value);
  }
  return false;
}

ScalarType fitting_type(const std::vector<double>& values, ScalarType wished) {
  const bool all =
      std::all_of(values.begin(), values.end(), [&](double value) { return fits(value, wished); });
  return all ? wished : ScalarType::float64;
}

const Attribute* take_attribute(const std::vector<Attribute>& attributes, const std::string& name,
                                unsigned least, unsigned most, WrittenParts& written) {
  for (const Attribute& attribute : attributes) {
    if (attribute.name == name && attribute.width >= least && attribute.width <= most) {
      written.insert(&attribute);
      return &attribute;
    }
  }
  return nullptr;
}

std::optional<Attribute> take_vertex_attribute(const TriangleMesh& mesh, const std::string& name,
                                               unsigned least, unsigned most, WrittenParts& written) {
  if (const Attribute* found = take_attribute(mesh.attributes.vertex, name, least, most, written)) {
    return *found;
  }
  for (const CornerAttribute& corner : mesh.attributes.corner) {
    if (corner.name == name && corner.width >= least && corner.width <= most) {
      std::optional<Attribute> result = as_vertex_attribute(mesh, corner);
      if (result) {
        written.insert(&corner);
        return result;
      }
    }
  }
  return std::nullopt;
}

std::vector<std::string> report_not_written(const MeshAttributes& attributes, const WrittenParts& written,
                                            FileFormat format) {
  std::vector<std::string> messages;
  const auto report = [&](const void* part, const std::string& what) {
    if (!written.contains(part)) {
      messages.push_back(what + " not written: " + format_name(format) + " has no place for it");
    }
  };
  for (const Attribute& attribute : attributes.vertex) {
    report(&attribute, "vertex attribute " + in_quotes(attribute.name));
  }
  for (const Attribute& attribute : attributes.face) {
    report(&attribute, "face attribute " + in_quotes(attribute.name));
  }
  for (const CornerAttribute& attribute : attributes.corner) {
    report(&attribute, "corner attribute " + in_quotes(attribute.name));
  }
  for (const FaceLabels& labels : attributes.face_labels) {
    report(&labels, counted(labels.labels.size(), "face label", "face labels") + " of kind " +
                        in_quotes(labels.keyword));
  }
  for (const LowerElements* elements : {&attributes.points, &attributes.lines}) {
    if (elements->count() == 0) {
      continue;
    }
    const bool points = elements->corners == 1;
    const std::string noun = points ? "points" : "lines";
    report(elements,
           counted(elements->count(), points ? "point" : "line", noun.c_str()) + " beside the triangles");
    for (const Attribute& attribute : elements->values) {
      if (written.contains(elements)) {
        report(&attribute, "attribute " + in_quotes(attribute.name) + " of " + noun);
      }
    }
  }
  if (!attributes.comments.empty()) {
    report(&attributes.comments, counted(attributes.comments.size(), "comment", "comments"));
  }
  for (const std::string& line : attributes.header_lines) {
    report(&line, "header line " + in_quotes(line));
  }
  return messages;
}

bool is_byte_color(const Attribute& color) {
  const bool real = color.type == ScalarType::float32 || color.type == ScalarType::float64;
  return !real && fitting_type(color.values, ScalarType::uint8) == ScalarType::uint8;
}

}  // namespace isorelax
