#include "render/gl_loader.h"

#include <glad/gl.h>

#include <string>

#include "mesh/error.h"

namespace isorelax::render {

void load_gl(GlLoader loader) {
  const int version = gladLoadGL(loader);
  if (version == 0) throw Error("no OpenGL context is current");
  if (GLAD_VERSION_MAJOR(version) * 10 + GLAD_VERSION_MINOR(version) < 33)
    throw Error("OpenGL 3.3 is needed, this context has " + std::to_string(GLAD_VERSION_MAJOR(version)) +
                "." + std::to_string(GLAD_VERSION_MINOR(version)));
}

}  // namespace isorelax::render
