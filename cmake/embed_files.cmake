# Run by isorelax_embed at build time: writes OUTPUT from FILES.
set(arrays "")
set(rows "")
set(number 0)
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
  string(APPEND arrays "constexpr unsigned char kFile${number}[] = {${bytes}};\n")
  string(APPEND rows
         "    {\"${name}\", {reinterpret_cast<const char*>(kFile${number}), sizeof kFile${number}}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE "${OUTPUT}" "// Generated at build time: the files themselves are in the source tree.
#include \"${HEADER}\"

#include <stdexcept>
#include <string>
#include <utility>

namespace ${NAMESPACE} {
namespace {
${arrays}
const std::pair<std::string_view, std::string_view> kFiles[] = {
${rows}};
}  // namespace

std::string_view embedded_file(std::string_view name) {
  for (const auto& [key, bytes] : kFiles)
    if (key == name) return bytes;
  throw std::logic_error(\"no embedded file \" + std::string(name));
}
}  // namespace ${NAMESPACE}
")
