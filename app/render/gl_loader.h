#pragma once

namespace isorelax::render {

/// Finds an OpenGL function of the current context by its name: glfwGetProcAddress, OSMesaGetProcAddress, ...
using GlProc = void (*)();
using GlLoader = GlProc (*)(const char* name);

/// Points the OpenGL functions (they are global) at the context that is current in this thread.
/// To be called after every change to a context that another library made.
/// Throws Error when the context is older than OpenGL 3.3.
void load_gl(GlLoader loader);

}  // namespace isorelax::render
