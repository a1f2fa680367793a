#include <GL/osmesa.h>

#include <array>

#include "mesh/error.h"
#include "render/offscreen_contexts.h"

namespace isorelax::render {
namespace {

class OsmesaContext final : public OffscreenContext {
 public:
  OsmesaContext() {
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              3,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              3,
                              0};
    context_ = OSMesaCreateContextAttribs(attributes, nullptr);
    if (context_ == nullptr)
      throw Error("OSMesa gives no OpenGL 3.3 core context (is libosmesa6 whole? or use the context egl)");
  }
  ~OsmesaContext() override { OSMesaDestroyContext(context_); }

  void make_current() override {
    if (OSMesaMakeCurrent(context_, surface_.data(), GL_UNSIGNED_BYTE, kSurfaceSide, kSurfaceSide) ==
        GL_FALSE)
      throw Error("the OSMesa context cannot be made current");
    load_gl(loader());
  }
  [[nodiscard]] GlLoader loader() const override {
    return [](const char* name) { return OSMesaGetProcAddress(name); };
  }

 private:
  // OSMesa wants a surface of its own; the pictures are drawn elsewhere.
  static constexpr int kSurfaceSide = 4;
  std::array<unsigned char, 4 * kSurfaceSide * kSurfaceSide> surface_{};
  OSMesaContext context_ = nullptr;
};

}  // namespace

std::unique_ptr<OffscreenContext> create_osmesa_context() {
  return std::make_unique<OsmesaContext>();
}

}  // namespace isorelax::render
