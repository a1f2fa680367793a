# One static library per layer. A layer sees the headers of the layers named in
# DEPENDS and of nothing else: each layer's headers stand in a staging folder of
# their own, so that an include across a forbidden boundary does not compile.

add_library(isorelax_build_flags INTERFACE)
target_compile_options(isorelax_build_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Wold-style-cast
  # Results are compared bit for bit between builds and thread counts: no contraction into fused operations.
  -ffp-contract=off
  # In a unity build every type of an anonymous namespace looks like one of a header.
  $<$<BOOL:${CMAKE_UNITY_BUILD}>:$<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>>
  # g++ 12 sees an overlap in "text" + std::string that is not there (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # The same bug by other names, silent where the headers of the standard library are not precompiled.
  "$<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${ISORELAX_PRECOMPILE}>>:-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread>"
  # Nobody reads errno after sqrt, nobody traps: without this, loops with a square root are not vectorised.
  -fno-math-errno -fno-trapping-math
  $<$<BOOL:${ISORELAX_WERROR}>:-Werror>)
if(ISORELAX_SANITIZE)
  target_compile_options(isorelax_build_flags INTERFACE
    -fsanitize=${ISORELAX_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
    # Null pointers and accesses outside of objects end at the address sanitizer too, and this processor reads at any
    # address: checking each access for them again makes a file take a third longer to compile.
    -fno-sanitize=null,alignment,object-size)
  target_link_options(isorelax_build_flags INTERFACE -fsanitize=${ISORELAX_SANITIZE})
endif()

# isorelax_precompile(TARGET KIND [HEADERS ...] [LIBRARIES ...]): with ISORELAX_PRECOMPILE, what most sources include is
# compiled once for all targets of a kind and not once per file. The preset debug does without it, and without compiling
# several sources together: there every file has to include what it uses.
function(isorelax_precompile target kind)
  if(NOT ISORELAX_PRECOMPILE)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "HEADERS;LIBRARIES" ${ARGN})
  set(shared isorelax_precompiled_${kind})
  if(NOT TARGET ${shared})
    file(WRITE ${CMAKE_BINARY_DIR}/precompiled/${kind}.cpp "")
    add_library(${shared} OBJECT ${CMAKE_BINARY_DIR}/precompiled/${kind}.cpp)
    target_link_libraries(${shared} PRIVATE isorelax_build_flags Eigen3::Eigen ${ARG_LIBRARIES})
    target_precompile_headers(${shared} PRIVATE
      <Eigen/Core> <Eigen/Geometry> <algorithm> <array> <charconv> <cmath> <cstdint> <filesystem> <functional>
      <limits> <memory> <optional> <span> <string> <string_view> <unordered_map> <vector> ${ARG_HEADERS})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${shared})
endfunction()

# isorelax_layer(NAME ROOM SOURCES... [DEPENDS targets...] [PRIVATE targets...])
# ROOM is the folder under core/ or app/; its headers are included as "ROOM/file.h".
function(isorelax_layer name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;PRIVATE" ${ARGN})
  set(target isorelax_${name})
  set(stage ${CMAKE_BINARY_DIR}/include/${name})
  file(MAKE_DIRECTORY ${stage})
  if(NOT EXISTS ${stage}/${name})
    file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${stage}/${name} SYMBOLIC)
  endif()
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(isorelax::${name} ALIAS ${target})
  target_include_directories(${target} PUBLIC ${stage})
  target_link_libraries(${target} PUBLIC ${ARG_DEPENDS} PRIVATE isorelax_build_flags ${ARG_PRIVATE})
  isorelax_precompile(${target} common)
endfunction()
