#include "io/ply_columns.h"

#include <algorithm>

namespace isorelax {
namespace {

struct Meaning {
  const char* attribute;
  std::vector<const char*> names;
  /// A column that belongs to it when it is there; null: none.
  const char* optional;
};

/// For each meaning the names to write first, then other names in use.
const std::vector<Meaning>& meanings() {
  static const std::vector<Meaning> kMeanings{
      {"normal", {"nx", "ny", "nz"}, nullptr},
      {"color", {"red", "green", "blue"}, "alpha"},
      {"color", {"r", "g", "b"}, "a"},
      {"color", {"diffuse_red", "diffuse_green", "diffuse_blue"}, "diffuse_alpha"},
      {"texcoord", {"s", "t"}, nullptr},
      {"texcoord", {"u", "v"}, nullptr},
      {"texcoord", {"texture_u", "texture_v"}, nullptr},
  };
  return kMeanings;
}

constexpr std::size_t kNotFound = static_cast<std::size_t>(-1);

std::size_t find_column(const std::vector<PlyColumn>& columns, const char* name) {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const PlyColumn& c) { return c.name == name; });
  return found == columns.end() ? kNotFound : static_cast<std::size_t>(found - columns.begin());
}

/// Places of the meaning's columns; empty when one is missing or their types differ.
std::vector<std::size_t> find_members(const std::vector<PlyColumn>& columns, const Meaning& meaning) {
  std::vector<std::size_t> members;
  for (const char* name : meaning.names) {
    members.push_back(find_column(columns, name));
    if (members.back() == kNotFound || columns[members.back()].type != columns[members.front()].type) {
      return {};
    }
  }
  const std::size_t more = meaning.optional == nullptr ? kNotFound : find_column(columns, meaning.optional);
  if (more != kNotFound && columns[more].type == columns[members.front()].type) {
    members.push_back(more);
  }
  return members;
}

Attribute interleaved(const std::vector<PlyColumn>& columns, const std::vector<std::size_t>& members,
                      const char* name) {
  const PlyColumn& first = columns[members.front()];
  Attribute attribute{name, first.type, static_cast<unsigned>(members.size()), {}};
  attribute.values.reserve(first.values.size() * members.size());
  for (std::size_t row = 0; row < first.values.size(); ++row) {
    for (const std::size_t member : members) {
      attribute.values.push_back(columns[member].values[row]);
    }
  }
  return attribute;
}

}  // namespace

std::vector<Attribute> join_columns(std::vector<PlyColumn>&& columns) {
  struct Placed {
    std::size_t place;
    Attribute attribute;
  };
  std::vector<Placed> placed;
  std::vector<bool> joined(columns.size(), false);
  std::vector<std::string> taken;
  for (const Meaning& meaning : meanings()) {
    const std::vector<std::size_t> members = find_members(columns, meaning);
    if (members.empty() || std::find(taken.begin(), taken.end(), meaning.attribute) != taken.end()) {
      continue;
    }
    taken.emplace_back(meaning.attribute);
    placed.push_back({*std::min_element(members.begin(), members.end()),
                      interleaved(columns, members, meaning.attribute)});
    for (const std::size_t member : members) {
      joined[member] = true;
      columns[member].values = {};
    }
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!joined[i]) {
      placed.push_back({i, {std::move(columns[i].name), columns[i].type, 1, std::move(columns[i].values)}});
    }
  }
  std::sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) { return a.place < b.place; });
  std::vector<Attribute> attributes;
  attributes.reserve(placed.size());
  for (Placed& entry : placed) {
    attributes.push_back(std::move(entry.attribute));
  }
  return attributes;
}

std::vector<std::string> ply_names(const Attribute& attribute) {
  for (const Meaning& meaning : meanings()) {
    const std::size_t least = meaning.names.size();
    if (attribute.name == meaning.attribute &&
        (attribute.width == least || (attribute.width == least + 1 && meaning.optional != nullptr))) {
      std::vector<std::string> names(meaning.names.begin(), meaning.names.end());
      if (attribute.width > least) {
        names.emplace_back(meaning.optional);
      }
      return names;
    }
  }
  if (attribute.width == 1) {
    return {attribute.name};
  }
  std::vector<std::string> names;
  for (unsigned k = 0; k < attribute.width; ++k) {
    names.push_back(attribute.name + "_" + std::to_string(k));
  }
  return names;
}

}  // namespace isorelax
