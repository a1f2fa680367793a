#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "io/mesh_file.h"
#include "mesh/error.h"
#include "trace/position_delta.h"
#include "trace/trace_file.h"

namespace isorelax {
namespace {

/// What two parts with nothing in them take: each iteration has two, each TracePart, too.
constexpr std::size_t kLeastBytes = 2 * (4 + 3 * sizeof(std::uint64_t));

/// Takes numbers from the front of a part's content.
class Numbers {
 public:
  explicit Numbers(std::string_view bytes) : bytes_(bytes) {}

  /// False where the content ends before.
  template <typename T>
  bool take(T& value) {
    if (bytes_.size() < sizeof(T)) return false;
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_.remove_prefix(sizeof(T));
    return true;
  }
  [[nodiscard]] std::string_view rest() const { return bytes_; }

 private:
  std::string_view bytes_;
};

void get_words(const nlohmann::json& json, RunWords& words) {
  words.arguments = json.at("arguments").get<std::vector<std::string>>();
  for (const nlohmann::json& file : json.at("resources"))
    words.resources.push_back({file.at("path").get<std::string>(), file.at("hash").get<std::string>()});
}

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  Trace read() {
    if (bytes_.substr(0, kTraceMagic.size()) != kTraceMagic) fail(0, "is not a trace of isorelax");
    at_ = kTraceMagic.size();
    version_ = number<std::uint32_t>();
    if (version_ < kFirstTraceVersion || version_ > kTraceVersion) {
      fail(kTraceMagic.size(), "is of version " + std::to_string(version_) +
                                   "; this program reads versions " + std::to_string(kFirstTraceVersion) +
                                   " to " + std::to_string(kTraceVersion));
    }
    read_head();
    read_mesh();
    for (std::size_t k = 0; k < trace_.parts.size(); ++k)
      read_part(trace_.parts[k], k == 0 ? nullptr : &trace_.parts[k - 1]);
    for (TraceIteration& iteration : trace_.iterations) read_iteration(iteration);
    (void)part("DONE");
    if (at_ != bytes_.size()) fail(at_, "something follows the end of the trace");
    return std::move(trace_);
  }

 private:
  [[noreturn]] void fail(std::size_t place, const std::string& reason) const {
    throw InputError(name_, "byte " + std::to_string(place), reason);
  }

  template <typename T>
  T number() {
    if (bytes_.size() - at_ < sizeof(T)) fail(bytes_.size(), "the file ends in the middle of a part");
    T value;
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }

  /// A part as stored, its hash checked.
  std::string_view stored(std::string_view expected, std::uint64_t& size) {
    const std::size_t start = at_;
    if (at_ == bytes_.size()) fail(at_, "the file ends before its part " + std::string(expected));
    if (bytes_.substr(at_, expected.size()) != expected)
      fail(at_, "expected the part " + std::string(expected) + ": the file is damaged");
    at_ += expected.size();
    size = number<std::uint64_t>();
    const auto length = number<std::uint64_t>();
    if (length > bytes_.size() - at_)
      fail(start, "the part " + std::string(expected) + " goes on after the end of the file");
    const std::string_view packed = bytes_.substr(at_, length);
    at_ += length;
    const std::uint64_t computed = fnv1a(bytes_.substr(start, at_ - start));
    if (number<std::uint64_t>() != computed)
      fail(start, "the part " + std::string(expected) + " is damaged: its checksum does not fit");
    part_start_ = start;
    return packed;
  }

  std::string part(std::string_view expected) {
    std::uint64_t size = 0;
    const std::string_view packed = stored(expected, size);
    std::string content;
    if (!decompress(packed, size, content))
      fail(part_start_, "the part " + std::string(expected) + " cannot be unpacked");
    return content;
  }

  void read_head() {
    const nlohmann::json json = nlohmann::json::parse(part("HEAD"), nullptr, false);
    try {
      trace_.program = json.at("program").get<std::string>();
      trace_.input = json.at("input").get<std::string>();
      get_words(json, trace_);
      vertices_ = json.at("vertices").get<std::size_t>();
      triangles_ = json.at("triangles").get<std::size_t>();
      // Nothing that is bounded by this overflows where sizes are computed from it.
      constexpr std::size_t kMost = std::numeric_limits<Index>::max();
      if (vertices_ > kMost || triangles_ > kMost) fail(part_start_, "promises a mesh of too many elements");
      const auto iterations = json.at("iterations").get<std::size_t>();
      const auto parts = version_ > kFirstTraceVersion ? json.at("parts").get<std::size_t>() : 0;
      // Each takes bytes of its own: a lying count asks for no more memory than the file's size allows.
      if (iterations > bytes_.size() / kLeastBytes || parts > bytes_.size() / kLeastBytes)
        fail(part_start_, "promises more iterations than the file can hold");
      trace_.iterations.resize(iterations);
      trace_.parts.resize(parts);
      trace_.quality = {json.at("min_angle_deg").get<double>(), json.at("max_angle_deg").get<double>(),
                        json.at("mean_min_angle_deg").get<double>(), json.at("inverted").get<std::size_t>()};
      if (version_ > kFirstTraceVersion) trace_.interrupted = json.at("interrupted").get<bool>();
      trace_.stopped = json.at("stopped").get<std::string>();
      trace_.stopped_because = json.at("stopped_because").get<std::string>();
    } catch (const nlohmann::json::exception& error) {
      fail(part_start_, std::string("the head cannot be understood: ") + error.what());
    }
  }

  void read_mesh() {
    const std::string content = part("MESH");
    if (content.size() != vertices_ * sizeof(Vec3) + triangles_ * sizeof(Triangle))
      fail(part_start_, "the mesh has another size than the head says");
    trace_.positions.resize(vertices_);
    trace_.triangles.resize(triangles_);
    for (Index v = 0; v < vertices_; ++v)
      std::memcpy(trace_.positions[v].data(), content.data() + v * sizeof(Vec3), sizeof(Vec3));
    for (const Vec3& x : trace_.positions) {
      if (!x.allFinite()) fail(part_start_, "a position of the mesh is not finite");
    }
    std::memcpy(trace_.triangles.data(), content.data() + vertices_ * sizeof(Vec3),
                triangles_ * sizeof(Triangle));
    for (const Triangle& t : trace_.triangles) {
      for (const Index v : t) {
        if (v >= vertices_) fail(part_start_, "a triangle names a vertex that is not there");
      }
    }
  }

  void read_part(TracePart& read, const TracePart* before) {
    const std::string content = part("PART");
    Numbers numbers(content);
    std::uint64_t done = 0, flags = 0, still = 0, near = 0;
    if (!numbers.take(done) || !numbers.take(read.exponent) || !numbers.take(read.holds.distance) ||
        !numbers.take(flags) || !numbers.take(still) ||
        (version_ == kVersionOfKeptVertices && !numbers.take(near)))
      fail(part_start_, "a part of the run lacks numbers");
    if (before == nullptr ? done != 0 : done <= before->done || done > trace_.iterations.size())
      fail(part_start_, "the parts of the run are not in order");
    if (!std::isfinite(read.exponent) || !(read.exponent >= 1) || !(read.holds.distance >= 0) ||
        flags >
            (kTracePartPolish | kTracePartFromBase | kTracePartWords | kTracePartOnFits | kTracePartApart))
      fail(part_start_, "a part of the run has numbers that cannot be");
    read.done = done;
    read.kind = (flags & kTracePartPolish) != 0 ? PartKind::polish : PartKind::solver;
    read.from_base = (flags & kTracePartFromBase) != 0;
    read.holds.on_fits = (flags & kTracePartOnFits) != 0;
    read.holds.apart = (flags & kTracePartApart) != 0;
    read_held(numbers, still, read.holds.still);
    std::vector<Index> kept_near;
    read_held(numbers, near, kept_near);
    if (version_ == kVersionOfKeptVertices && kept_near.empty())
      read.holds.distance = SurfaceHolds{}.distance;
    if ((flags & kTracePartWords) != 0) {
      read_words(numbers.rest(), read);
    } else if (!numbers.rest().empty()) {
      fail(part_start_, "something follows the numbers of a part of the run");
    }
    std::uint64_t size = 0;
    read.base = stored("BASE", size);
    if (size != (read.base.empty() ? 0 : vertices_ * sizeof(Vec3)))
      fail(part_start_, "the positions of a part of the run are those of another mesh");
  }

  void read_held(Numbers& numbers, std::uint64_t count, std::vector<Index>& held) {
    if (count > numbers.rest().size() / sizeof(Index))
      fail(part_start_, "a part of the run lacks held vertices");
    held.resize(count);
    for (Index& v : held) {
      if (!numbers.take(v) || v >= vertices_) fail(part_start_, "a held vertex of the run is not there");
    }
  }

  void read_words(std::string_view text, TracePart& read) {
    const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
    try {
      get_words(json, read.words.emplace());
    } catch (const nlohmann::json::exception& error) {
      fail(part_start_, std::string("the words of a part cannot be understood: ") + error.what());
    }
  }

  void read_iteration(TraceIteration& iteration) {
    const std::string numbers = part("STEP");
    std::size_t at = 0;
    visit_numbers(iteration, [&](std::string_view, auto& value) {
      if (std::is_same_v<decltype(value), StepKind&> && version_ < kFirstVersionOfKinds) return;
      if (numbers.size() - at < sizeof(value)) fail(part_start_, "an iteration lacks numbers");
      std::memcpy(&value, numbers.data() + at, sizeof(value));
      at += sizeof(value);
    });
    if (static_cast<std::size_t>(iteration.kind) >= kStepKinds)
      fail(part_start_, "an iteration is of a kind that is not known");
    std::uint64_t size = 0;
    iteration.delta = stored("MOVE", size);
    if (size != vertices_ * sizeof(Vec3)) fail(part_start_, "the moves are those of another mesh");
  }

  std::string_view bytes_;
  const std::string& name_;
  std::uint32_t version_ = 0;
  std::size_t at_ = 0;
  std::size_t part_start_ = 0;
  std::size_t vertices_ = 0;
  std::size_t triangles_ = 0;
  Trace trace_;
};

}  // namespace

Trace parse_trace(std::string_view bytes, const std::string& name) {
  return Reader(bytes, name).read();
}

bool is_trace(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, kTraceMagic.size()> letters{};
  file.read(letters.data(), letters.size());
  return file && std::string_view(letters.data(), letters.size()) == kTraceMagic;
}

Trace read_trace(const std::filesystem::path& path) {
  return parse_trace(read_bytes(path), path.string());
}

}  // namespace isorelax
