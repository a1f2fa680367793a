#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>

#include "io/attribute_access.h"
#include "io/cells.h"
#include "io/mesh_file.h"
#include "io/mixed_scanner.h"
#include "io/msh_layout.h"
#include "io/text_scanner.h"

namespace isorelax {
namespace {

constexpr unsigned kMostElementTags = 1000;

/// Reads Gmsh's MSH, versions 2.x and 4.1, text and binary: nodes, elements up to dimension two, names of
/// groups. See the Gmsh reference manual, "MSH file format" and "Legacy formats".
class MshReader {
 public:
  MshReader(std::string_view bytes, const std::string& name) : in_(bytes, name), bytes_(bytes) {}

  RawMesh read() {
    while (!in_.peek_word().empty()) read_section(in_.word());
    if (!has_format_) in_.fail("no section $MeshFormat");
    finish();
    return std::move(raw_);
  }

  [[nodiscard]] FileEncoding encoding() const {
    if (!binary_) return FileEncoding::text;
    return order_ == std::endian::little ? FileEncoding::binary_little_endian
                                         : FileEncoding::binary_big_endian;
  }

 private:
  using EntityKey = std::pair<int, std::int64_t>;  // dimension and tag

  void read_section(std::string_view section);
  void end_section(std::string_view section);
  void pass_over(std::string_view section);
  void read_format();
  void read_comments();
  void read_names();
  void read_entities();
  void read_nodes_2();
  void read_nodes_4();
  void read_node_block();
  void add_node(std::uint64_t tag, const Vec3& position);
  void read_elements_2();
  void read_element_2(std::int64_t type, std::uint64_t tags);
  void read_elements_4();
  void add_element(std::int64_t number, std::int64_t physical, std::int64_t entity);
  [[nodiscard]] MshElementType type_of(std::int64_t number) const;
  [[nodiscard]] Index vertex_of(std::uint64_t tag) const;
  void take_nodes(const MshElementType& type);
  void finish();

  // Numbers as the file's kind has them.
  std::int64_t int32(const char* what) {
    return binary_ ? in_.raw<std::int32_t>(order_, what) : in_.integer(what);
  }
  std::uint64_t size(const char* what) {
    return binary_ ? in_.raw<std::uint64_t>(order_, what) : in_.count(what);
  }
  /// A node's or an element's own number.
  std::uint64_t tag(const char* what) {
    if (version_ >= 4) return size(what);
    const std::int64_t value = int32(what);
    if (value < 0) in_.fail(std::string(what) + " is negative");
    return static_cast<std::uint64_t>(value);
  }
  double real(const char* what) { return binary_ ? in_.raw<double>(order_, what) : in_.number(what); }
  Vec3 position();
  /// Least bytes of so many numbers.
  [[nodiscard]] std::size_t least(std::size_t numbers, std::size_t binary_bytes) const {
    return binary_ ? binary_bytes : 2 * numbers;
  }

  MixedScanner in_;
  std::string_view bytes_;
  bool has_format_ = false, binary_ = false;
  int version_ = 2;
  std::endian order_ = std::endian::little;
  RawMesh raw_;
  CellSorter cells_;
  std::vector<Index> element_;
  std::vector<double> physical_, entity_, nodes_;
  std::unordered_map<std::uint64_t, Index> vertex_;  ///< only where nodes are not numbered 1, 2, 3, ...
  bool in_sequence_ = true;
  std::map<EntityKey, std::int64_t> entity_group_;
  std::size_t more_groups_ = 0, partitioned_ = 0;
};

void MshReader::read_section(std::string_view section) {
  if (section.size() < 2 || section.front() != '$')
    in_.fail("expected a section such as $Nodes, found " + in_quotes(section));
  if (section == "$NOD") in_.fail("version 1 of MSH is not read; 2 and 4.1 are");
  if (section == "$Comments") return read_comments();
  if (section == "$MeshFormat") {
    read_format();
  } else if (!has_format_) {
    in_.fail(in_quotes(section) + " stands before $MeshFormat");
  } else if (section == "$PhysicalNames") {
    read_names();
  } else if (section == "$Entities" && version_ == 4) {
    read_entities();
  } else if (section == "$Nodes") {
    version_ == 4 ? read_nodes_4() : read_nodes_2();
  } else if (section == "$Elements") {
    version_ == 4 ? read_elements_4() : read_elements_2();
  } else {
    return pass_over(section);
  }
  end_section(section);
}

void MshReader::end_section(std::string_view section) {
  const std::string wanted = "$End" + std::string(section.substr(1));
  const std::string_view found = in_.word();
  if (found != wanted)
    in_.fail("expected " + in_quotes(wanted) + ", found " +
             (found.empty() ? "the end of the file" : in_quotes(found)));
}

void MshReader::pass_over(std::string_view section) {
  const std::string wanted = "$End" + std::string(section.substr(1));
  const std::size_t end = bytes_.find(wanted, in_.position());
  if (end == std::string_view::npos) in_.fail("the file ends within " + in_quotes(section));
  in_.skip_to(end + wanted.size());
  raw_.messages.push_back("section " + in_quotes(section) + " left out");
}

void MshReader::read_format() {
  if (has_format_) in_.fail("$MeshFormat stands twice");
  const std::string_view version = in_.word();
  if (version == "4.1") {
    version_ = 4;
  } else if (!version.starts_with("2") || !parse_double(version) || *parse_double(version) >= 3) {
    in_.fail("version " + in_quotes(version) + " of MSH is not read; 2 and 4.1 are");
  }
  const std::int64_t kind = in_.integer("the kind of file");
  if (kind != 0 && kind != 1) in_.fail("the kind of file is neither 0 (text) nor 1 (binary)");
  binary_ = kind == 1;
  if (in_.integer("the size of a number") != 8) in_.fail("only numbers of 8 bytes are read");
  has_format_ = true;
  in_.line();
  if (!binary_) return;
  const auto one = in_.raw<std::int32_t>(std::endian::little, "the mark of the byte order");
  if (one != 1) order_ = std::endian::big;
  if (one != 1 && one != 0x01000000) in_.fail("the mark of the byte order is not 1");
}

void MshReader::read_comments() {
  in_.line();
  while (in_.bytes_left() > 0) {
    const std::string_view line = in_.line();
    if (line == "$EndComments") return;
    raw_.attributes.comments.emplace_back(line);
  }
  in_.fail("the file ends within '$Comments'");
}

void MshReader::read_names() {
  const std::uint64_t count = in_.count("the number of names");
  in_.promise(count, 6, "names");
  in_.line();
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::string_view line = in_.line();
    if (line.starts_with("$") || line.find('"') == std::string_view::npos)
      in_.fail("expected the dimension, number and name of a group, found " + in_quotes(line));
    raw_.attributes.header_lines.push_back(kMshNames + std::string(line));
  }
}

Vec3 MshReader::position() {
  static constexpr std::array<const char*, 3> kNames{
      "the x coordinate of a node", "the y coordinate of a node", "the z coordinate of a node"};
  Vec3 found;
  for (unsigned k = 0; k < 3; ++k) {
    found[k] = real(kNames[k]);
    if (!std::isfinite(found[k]))
      in_.fail(std::string(kNames[k]) +
               (std::isnan(found[k]) ? " is not a number (NaN)" : " is infinite or too large"));
  }
  return found;
}

/// Which groups each entity belongs to; an element keeps the first.
void MshReader::read_entities() {
  std::array<std::uint64_t, 4> counts{};
  if (binary_) in_.line();
  for (std::uint64_t& count : counts) count = size("the number of entities");
  for (int dimension = 0; dimension < 4; ++dimension) {
    in_.promise(counts[static_cast<std::size_t>(dimension)], least(4, 20), "entities");
    for (std::uint64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
      const std::int64_t tag = int32("the number of an entity");
      for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) static_cast<void>(real("the extent of an entity"));
      const std::uint64_t groups = size("the number of groups of an entity");
      in_.promise(groups, least(1, 4), "groups");
      for (std::uint64_t k = 0; k < groups; ++k) {
        const std::int64_t group = int32("a group");
        if (k == 0) entity_group_[{dimension, tag}] = group;
      }
      more_groups_ += groups > 1 ? 1 : 0;
      if (dimension == 0) continue;
      const std::uint64_t bounds = size("the number of bounds of an entity");
      in_.promise(bounds, least(1, 4), "bounds");
      for (std::uint64_t k = 0; k < bounds; ++k) static_cast<void>(int32("a bound of an entity"));
    }
  }
}

void MshReader::add_node(std::uint64_t tag, const Vec3& position) {
  const auto index = static_cast<Index>(raw_.positions.size());
  raw_.positions.push_back(position);
  nodes_.push_back(static_cast<double>(tag));
  if (in_sequence_ && tag == index + std::uint64_t{1}) return;
  if (in_sequence_) {
    in_sequence_ = false;
    for (Index v = 0; v < index; ++v) vertex_.emplace(v + std::uint64_t{1}, v);
  }
  if (!vertex_.emplace(tag, index).second) in_.fail("node " + std::to_string(tag) + " stands twice");
}

void MshReader::read_nodes_2() {
  const std::uint64_t count = in_.count("the number of nodes");
  if (binary_) in_.line();
  in_.promise(count, least(4, 28), "nodes");
  raw_.positions.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t number = tag("the number of a node");
    add_node(number, position());
  }
}

void MshReader::read_nodes_4() {
  if (binary_) in_.line();
  const std::uint64_t blocks = size("the number of blocks");
  in_.promise(size("the number of nodes"), least(4, 32), "nodes");
  static_cast<void>(size("the smallest number of a node"));
  static_cast<void>(size("the largest number of a node"));
  in_.promise(blocks, least(4, 20), "blocks");
  for (std::uint64_t block = 0; block < blocks; ++block) read_node_block();
}

void MshReader::read_node_block() {
  const std::int64_t dimension = int32("the dimension of a block");
  static_cast<void>(int32("the entity of a block"));
  const bool parametric = int32("whether a block is parametric") != 0;
  const std::uint64_t count = size("the number of nodes of a block");
  in_.promise(count, least(4, 32), "nodes");
  std::vector<std::uint64_t> tags(count);
  for (std::uint64_t& number : tags) number = tag("the number of a node");
  const std::int64_t parameters = parametric ? std::clamp<std::int64_t>(dimension, 0, 3) : 0;
  for (const std::uint64_t number : tags) {
    add_node(number, position());
    for (std::int64_t k = 0; k < parameters; ++k) static_cast<void>(real("a parameter of a node"));
  }
}

MshElementType MshReader::type_of(std::int64_t number) const {
  const auto type = msh_element_type(number);
  if (!type) in_.fail("element type " + std::to_string(number) + " is not known");
  if (type->order > 1)
    in_.fail("elements of higher order are not read: save them with Mesh.ElementOrder = 1");
  return *type;
}

Index MshReader::vertex_of(std::uint64_t tag) const {
  if (in_sequence_ && tag >= 1 && tag <= raw_.positions.size()) return static_cast<Index>(tag - 1);
  const auto found = vertex_.find(tag);
  if (in_sequence_ || found == vertex_.end())
    in_.fail("an element names node " + std::to_string(tag) + ", which does not stand before it");
  return found->second;
}

void MshReader::take_nodes(const MshElementType& type) {
  element_.clear();
  for (unsigned k = 0; k < type.nodes; ++k) element_.push_back(vertex_of(tag("a node of an element")));
}

void MshReader::add_element(std::int64_t number, std::int64_t physical, std::int64_t entity) {
  static constexpr std::array<CellKind, 4> kKinds{CellKind::points, CellKind::line, CellKind::polygon,
                                                  CellKind::volume};
  cells_.add(kKinds[type_of(number).dimension], element_);
  physical_.push_back(static_cast<double>(physical));
  entity_.push_back(static_cast<double>(entity));
}

void MshReader::read_elements_2() {
  const std::uint64_t count = in_.count("the number of elements");
  if (binary_) in_.line();
  in_.promise(count, least(4, 8), "elements");
  for (std::uint64_t done = 0; done < count;) {
    if (!binary_) {
      static_cast<void>(tag("the number of an element"));
      const std::int64_t type = int32("the type of an element");
      read_element_2(type, in_.count("the number of tags"));
      ++done;
      continue;
    }
    const std::int64_t type = int32("the type of elements");
    const std::int64_t follow = int32("how many elements follow");
    const std::int64_t tags = int32("the number of tags");
    if (follow < 1 || static_cast<std::uint64_t>(follow) > count - done)
      in_.fail(std::to_string(follow) + " elements follow where " + std::to_string(count - done) +
               " are left");
    if (tags < 0) in_.fail("the number of tags is negative");
    for (std::int64_t i = 0; i < follow; ++i) {
      static_cast<void>(tag("the number of an element"));
      read_element_2(type, static_cast<std::uint64_t>(tags));
    }
    done += static_cast<std::uint64_t>(follow);
  }
}

void MshReader::read_element_2(std::int64_t type, std::uint64_t tags) {
  if (tags > kMostElementTags) in_.fail("an element with " + std::to_string(tags) + " tags");
  std::array<std::int64_t, 2> known{};
  for (std::uint64_t k = 0; k < tags; ++k) {
    const std::int64_t value = int32("a tag of an element");
    if (k < known.size()) known[k] = value;
  }
  partitioned_ += tags > known.size() ? 1 : 0;
  take_nodes(type_of(type));
  add_element(type, known[0], known[1]);
}

void MshReader::read_elements_4() {
  if (binary_) in_.line();
  const std::uint64_t blocks = size("the number of blocks");
  in_.promise(size("the number of elements"), least(2, 16), "elements");
  static_cast<void>(size("the smallest number of an element"));
  static_cast<void>(size("the largest number of an element"));
  in_.promise(blocks, least(4, 20), "blocks");
  for (std::uint64_t block = 0; block < blocks; ++block) {
    const std::int64_t dimension = int32("the dimension of a block");
    const std::int64_t entity = int32("the entity of a block");
    const std::int64_t number = int32("the type of elements");
    const std::uint64_t count = size("the number of elements of a block");
    const MshElementType type = type_of(number);
    in_.promise(count, least(type.nodes + 1, 8 * (type.nodes + std::size_t{1})), "elements");
    const auto group = entity_group_.find({static_cast<int>(dimension), entity});
    const std::int64_t physical = group == entity_group_.end() ? 0 : group->second;
    for (std::uint64_t i = 0; i < count; ++i) {
      static_cast<void>(tag("the number of an element"));
      take_nodes(type);
      add_element(number, physical, entity);
    }
  }
}

void MshReader::finish() {
  // Nothing is said where all have the number that is written where nothing is said.
  const auto add = [&](const char* name, std::vector<double>& values, double usual) {
    const auto are_all = [&](double number) {
      return std::ranges::all_of(values, [&](double value) { return value == number; });
    };
    if (are_all(0) || are_all(usual)) return;
    const ScalarType type = fitting_type(values, ScalarType::int32);
    cells_.add_values({name, type, 1, std::move(values)});
  };
  add(kPhysicalGroup, physical_, kMshNoGroup);
  add(kGeometricEntity, entity_, kMshOnlyEntity);
  cells_.finish(raw_);
  if (!in_sequence_) {
    const ScalarType type = fitting_type(nodes_, ScalarType::uint32);
    raw_.attributes.vertex.push_back({kMshNode, type, 1, std::move(nodes_)});
  }
  if (more_groups_ > 0) {
    raw_.messages.push_back(counted(more_groups_, "entity", "entities") +
                            " in several groups: their elements keep the first");
  }
  if (partitioned_ > 0)
    raw_.messages.push_back("partitions of " + counted(partitioned_, "element", "elements") + " left out");
}

}  // namespace

MeshFile read_msh(std::string_view bytes, const std::string& name) {
  MshReader reader(bytes, name);
  RawMesh raw = reader.read();
  return finish_mesh(std::move(raw), FileFormat::msh, reader.encoding(), name);
}

}  // namespace isorelax
