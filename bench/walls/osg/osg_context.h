#pragma once
/// OpenGL contexts without a window for osg_walls, by EGL or OSMesa. Without both, this file declares nothing.

#include <osg/GraphicsContext>
#include <osg/State>

#include <cstdio>
#include <cstdlib>
#include <vector>

#ifdef WITH_EGL
#include <EGL/egl.h>
#include <EGL/eglext.h>
#endif
#ifdef WITH_OSMESA
#include <GL/osmesa.h>
// OSG resolves extension entry points through this symbol.
extern "C" __attribute__((visibility("default"))) void (*glXGetProcAddressARB(const unsigned char* n))(void) {
  return (void (*)(void))OSMesaGetProcAddress((const char*)n);
}
extern "C" __attribute__((visibility("default"))) void (*glXGetProcAddress(const unsigned char* n))(void) {
  return (void (*)(void))OSMesaGetProcAddress((const char*)n);
}
#endif

#if defined(WITH_EGL) || defined(WITH_OSMESA)
class HeadlessContext : public osg::GraphicsContext {
public:
  HeadlessContext(Traits* tr, HeadlessContext* sh) : _share(sh) {
    _traits = tr;
    setState(new osg::State);
    getState()->setGraphicsContext(this);
    if (sh) {
      getState()->setContextID(sh->getState()->getContextID());
      incrementContextIDUsageCount(getState()->getContextID());
    } else
      getState()->setContextID(createNewContextID());
  }
  bool valid() const override { return true; }
  bool isRealizedImplementation() const override { return _real; }
  bool releaseContextImplementation() override;
  bool makeCurrentImplementation() override;
  bool realizeImplementation() override;
  void closeImplementation() override {}
  bool makeContextCurrentImplementation(GraphicsContext*) override { return makeCurrentImplementation(); }
  void bindPBufferToTextureImplementation(GLenum) override {}
  void swapBuffersImplementation() override {}

private:
  HeadlessContext* _share;
  bool _real = false;
#ifdef WITH_EGL
  static EGLDisplay display() {
    static EGLDisplay d = [] {
      auto get = (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
      EGLDisplay dd = get ? get(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr) : EGL_NO_DISPLAY;
      EGLint a, b;
      if (!eglInitialize(dd, &a, &b)) {
        std::fprintf(stderr, "eglInitialize failed\n");
        std::exit(2);
      }
      return dd;
    }();
    return d;
  }
  EGLContext _ctx = EGL_NO_CONTEXT;
  EGLSurface _surf = EGL_NO_SURFACE;
#else
  OSMesaContext _ctx = nullptr;
  std::vector<unsigned char> _buf;
#endif
};
#ifdef WITH_EGL
bool HeadlessContext::realizeImplementation() {
  eglBindAPI(EGL_OPENGL_API);
  const EGLint ca[] = {EGL_SURFACE_TYPE,
                       EGL_PBUFFER_BIT,
                       EGL_RENDERABLE_TYPE,
                       EGL_OPENGL_BIT,
                       EGL_RED_SIZE,
                       8,
                       EGL_GREEN_SIZE,
                       8,
                       EGL_BLUE_SIZE,
                       8,
                       EGL_ALPHA_SIZE,
                       8,
                       EGL_DEPTH_SIZE,
                       24,
                       EGL_NONE};
  EGLConfig cfg;
  EGLint nc = 0;
  eglChooseConfig(display(), ca, &cfg, 1, &nc);
  const EGLint sa[] = {EGL_WIDTH, _traits->width, EGL_HEIGHT, _traits->height, EGL_NONE};
  _surf = eglCreatePbufferSurface(display(), cfg, sa);
  _ctx = eglCreateContext(display(), cfg, _share ? _share->_ctx : EGL_NO_CONTEXT, nullptr);
  _real = _ctx != EGL_NO_CONTEXT && _surf != EGL_NO_SURFACE;
  if (!_real) std::fprintf(stderr, "EGL context failed %x\n", eglGetError());
  return _real;
}
bool HeadlessContext::makeCurrentImplementation() {
  eglBindAPI(EGL_OPENGL_API);
  return eglMakeCurrent(display(), _surf, _surf, _ctx);
}
bool HeadlessContext::releaseContextImplementation() {
  return eglMakeCurrent(display(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}
#else
bool HeadlessContext::realizeImplementation() {
  const int a[] = {
      OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 24, OSMESA_PROFILE, OSMESA_COMPAT_PROFILE, 0};
  _ctx = OSMesaCreateContextAttribs(a, _share ? _share->_ctx : nullptr);
  _buf.resize(size_t(4) * _traits->width * _traits->height);
  return _real = _ctx != nullptr;
}
bool HeadlessContext::makeCurrentImplementation() {
  return OSMesaMakeCurrent(_ctx, _buf.data(), GL_UNSIGNED_BYTE, _traits->width, _traits->height);
}
bool HeadlessContext::releaseContextImplementation() {
  return OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
}
#endif
#endif
