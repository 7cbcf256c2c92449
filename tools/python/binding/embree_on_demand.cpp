// Embree, opened at the first ray: with its 44 MB `import sphparam` would take several times as
// long, and few programs cast rays. The names that the library calls are defined here, so that the
// module is not linked with Embree, and lead there.

#include <dlfcn.h>

#include <cstddef>
#include <stdexcept>
#include <string>

namespace {

void* embree() {
  static void* const library = [] {
    void* const opened = dlopen("libembree3.so.3", RTLD_NOW | RTLD_LOCAL);
    if (!opened) {
      throw std::runtime_error(std::string("Embree, which casts rays, cannot be opened: ") +
                               dlerror() + "; Debian has it in the package libembree3-3");
    }
    return opened;
  }();
  return library;
}

template <class Function>
Function* found(const char* name) {
  void* const symbol = dlsym(embree(), name);
  if (!symbol) throw std::runtime_error(std::string("this Embree has no ") + name);
  return reinterpret_cast<Function*>(symbol);
}

using Handle = void*;

}  // namespace

// Pointers and whole numbers as in rtcore.h, whose types do not matter here.
#define SPHPARAM_EMBREE(Result, name, parameters, arguments)      \
  extern "C" Result name parameters {                             \
    static auto* const embrees = found<Result parameters>(#name); \
    return embrees arguments;                                     \
  }

SPHPARAM_EMBREE(Handle, rtcNewDevice, (const char* settings), (settings))
SPHPARAM_EMBREE(int, rtcGetDeviceError, (Handle device), (device))
SPHPARAM_EMBREE(void, rtcReleaseDevice, (Handle device), (device))
SPHPARAM_EMBREE(Handle, rtcNewScene, (Handle device), (device))
SPHPARAM_EMBREE(void, rtcSetSceneFlags, (Handle scene, int flags), (scene, flags))
SPHPARAM_EMBREE(void, rtcCommitScene, (Handle scene), (scene))
SPHPARAM_EMBREE(void, rtcReleaseScene, (Handle scene), (scene))
SPHPARAM_EMBREE(Handle, rtcNewGeometry, (Handle device, int kind), (device, kind))
SPHPARAM_EMBREE(void*, rtcSetNewGeometryBuffer,
                (Handle geometry, int kind, unsigned slot, int format, std::size_t stride,
                 std::size_t count),
                (geometry, kind, slot, format, stride, count))
SPHPARAM_EMBREE(void, rtcCommitGeometry, (Handle geometry), (geometry))
SPHPARAM_EMBREE(unsigned, rtcAttachGeometry, (Handle scene, Handle geometry), (scene, geometry))
SPHPARAM_EMBREE(void, rtcReleaseGeometry, (Handle geometry), (geometry))
SPHPARAM_EMBREE(void, rtcIntersect1, (Handle scene, void* context, void* hit),
                (scene, context, hit))
SPHPARAM_EMBREE(void, rtcIntersect1M,
                (Handle scene, void* context, void* hits, unsigned count, std::size_t stride),
                (scene, context, hits, count, stride))
SPHPARAM_EMBREE(void, rtcOccluded1M,
                (Handle scene, void* context, void* rays, unsigned count, std::size_t stride),
                (scene, context, rays, count, stride))
SPHPARAM_EMBREE(bool, rtcPointQuery,
                (Handle scene, void* query, void* context, void* visit, void* data),
                (scene, query, context, visit, data))
