# Files that travel inside the program.
#
#   isorelax_embed(TARGET HEADER NAMESPACE FILES...)
#
# adds to TARGET a generated source with one constant per file, as raw bytes, found by name:
#   std::string_view NAMESPACE::embedded_file("viridis.txt")
# HEADER declares that function. No path of the build machine ends up in the program.
function(isorelax_embed target header namespace)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${target}_embedded.cpp)
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_files.cmake)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} "-DOUTPUT=${output}" "-DHEADER=${header}" "-DNAMESPACE=${namespace}"
            "-DFILES=${ARGN}" -P ${script}
    DEPENDS ${ARGN} ${script}
    COMMENT "Embedding files into ${target}"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
