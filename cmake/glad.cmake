# The OpenGL loader, generated while configuring. Only targets that link isorelax::glad can include <glad/gl.h>.
find_program(ISORELAX_GLAD glad)
if(NOT ISORELAX_GLAD)
  message(FATAL_ERROR "The OpenGL loader generator 'glad' was not found: install the package python3-glad.")
endif()
set(glad_dir ${PROJECT_BINARY_DIR}/glad)
if(NOT EXISTS ${glad_dir}/src/gl.c)
  execute_process(
    COMMAND ${ISORELAX_GLAD} --quiet --reproducible --api gl:core=3.3 --extensions GL_KHR_debug
            --out-path ${glad_dir} c
    RESULT_VARIABLE glad_status ERROR_VARIABLE glad_error OUTPUT_QUIET)
  if(glad_status OR NOT EXISTS ${glad_dir}/src/gl.c)
    file(REMOVE_RECURSE ${glad_dir})
    message(FATAL_ERROR "glad could not generate the OpenGL loader: ${glad_error}")
  endif()
endif()
add_library(isorelax_glad STATIC ${glad_dir}/src/gl.c)
add_library(isorelax::glad ALIAS isorelax_glad)
target_include_directories(isorelax_glad SYSTEM PUBLIC ${glad_dir}/include)
