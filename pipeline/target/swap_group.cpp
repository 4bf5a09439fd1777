#include "pipeline/target/swap_group.h"

#include "engine/base/shared_library.h"
#include "pipeline/target/x_connection.h"

#include <fmt/format.h>

#include <sstream>
#include <utility>

namespace stadion {
namespace {

constexpr const char* kExtension = "GLX_NV_swap_group";

// Of GLX's header, which is not needed for anything else.
constexpr int kGlxStereo = 6, kGlxDoubleBuffer = 5, kGlxRenderType = 0x8011, kGlxRgbaBit = 1;

using AnyFunction = void();
using FindFunction = AnyFunction*(const unsigned char* name);

/// A function of the driver; null if the driver lacks it.
template <class Function>
Function* driverFunction(FindFunction* find, const char* name) {
  return reinterpret_cast<Function*>(find(reinterpret_cast<const unsigned char*>(name)));
}

bool hasWord(const std::string& words, std::string_view wanted) {
  std::istringstream in(words);
  for (std::string word; in >> word;)
    if (word == wanted) return true;
  return false;
}

std::string countText(std::uint32_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

Result<SwapGroupFunctions> SwapGroupFunctions::ofDisplay(void* display) {
  using Made = Result<SwapGroupFunctions>;
  if (!display) return Made::failure("swap groups need an X server");
  const auto x = SharedLibrary::open("libX11.so.6", "libx11-6");
  const auto gl = SharedLibrary::open("libGL.so.1", "libgl1");
  if (!x) return x.error();
  if (!gl) return gl.error();
  auto* screenOf = x.value().find<int(void*)>("XDefaultScreen");
  auto* extensionsOf = gl.value().find<const char*(void*, int)>("glXQueryExtensionsString");
  auto* find = gl.value().find<FindFunction>("glXGetProcAddressARB");
  if (!find) find = gl.value().find<FindFunction>("glXGetProcAddress");
  if (!screenOf || !extensionsOf || !find) return Made::failure("libGL.so.1 lacks functions of GLX 1.4");
  const int screen = screenOf(display);
  SwapGroupFunctions f;
  // Once the connection is lost, it must not be used any more.
  f.extensions = [=] {
    const char* all = extensionsOf(display, screen);
    return std::string(all ? all : "");
  };
  // A driver may give a pointer for any name: only the extension's name says whether it can be called.
  if (!hasWord(f.extensions(), kExtension)) return f;
  using Number = unsigned;
  if (auto* g = driverFunction<int(void*, int, Number*, Number*)>(find, "glXQueryMaxSwapGroupsNV"))
    f.most = [=](std::uint32_t& groups, std::uint32_t& barriers) {
      return !xConnectionLost() && g(display, screen, &groups, &barriers) != 0;
    };
  if (auto* g = driverFunction<int(void*, Drawable, Number)>(find, "glXJoinSwapGroupNV"))
    f.join = [=](Drawable window, std::uint32_t group) {
      return !xConnectionLost() && g(display, window, group) != 0;
    };
  if (auto* g = driverFunction<int(void*, Number, Number)>(find, "glXBindSwapBarrierNV"))
    f.bind = [=](std::uint32_t group, std::uint32_t barrier) {
      return !xConnectionLost() && g(display, group, barrier) != 0;
    };
  if (auto* g = driverFunction<int(void*, Drawable, Number*, Number*)>(find, "glXQuerySwapGroupNV"))
    f.query = [=](Drawable window, std::uint32_t& group, std::uint32_t& barrier) {
      return !xConnectionLost() && g(display, window, &group, &barrier) != 0;
    };
  if (auto* g = driverFunction<int(void*, int, Number*)>(find, "glXQueryFrameCountNV"))
    f.frameCount = [=](std::uint32_t& count) {
      return !xConnectionLost() && g(display, screen, &count) != 0;
    };
  return f;
}

std::string SwapGroupOffer::text() const {
  if (!extension) return "the display driver has no swap groups";
  return fmt::format("{}, {}, {}", kExtension, countText(groups, "group"), countText(barriers, "barrier"));
}

SwapGroupOffer swapGroupOffer(const SwapGroupFunctions& functions) {
  SwapGroupOffer offer;
  offer.extension = functions.extensions && hasWord(functions.extensions(), kExtension) && functions.most &&
                    functions.join && functions.bind;
  if (offer.extension && !functions.most(offer.groups, offer.barriers)) offer.groups = offer.barriers = 0;
  return offer;
}

Result<std::unique_ptr<SwapGroup>> SwapGroup::join(SwapGroupFunctions functions,
                                                   std::vector<SwapGroupFunctions::Drawable> windows,
                                                   bool barrier) {
  using Joined = Result<std::unique_ptr<SwapGroup>>;
  const SwapGroupOffer offer = swapGroupOffer(functions);
  if (!offer.extension) return Joined::failure(offer.text());
  if (offer.groups == 0)
    return Joined::failure("the display driver has no swap group left (" + offer.text() + ")");
  if (barrier && offer.barriers == 0)
    return Joined::failure("the display driver has no swap barrier (" + offer.text() + ")");
  std::unique_ptr<SwapGroup> made(new SwapGroup(std::move(functions)));
  for (const auto window : windows) {
    if (!made->functions_.join(window, kGroup))
      return Joined::failure(fmt::format("the display driver refuses a window in swap group {}", kGroup));
    made->joined_.push_back(window);
  }
  if (barrier && !made->functions_.bind(kGroup, kBarrier))
    return Joined::failure(fmt::format("the display driver refuses swap barrier {}", kBarrier));
  made->bound_ = barrier;
  // What the driver says that it did. Without that function, its word counts.
  for (const auto window : made->joined_) {
    std::uint32_t group = kGroup, bound = barrier ? kBarrier : 0;
    if (!made->functions_.query || !made->functions_.query(window, group, bound)) continue;
    if (group != kGroup || (barrier && bound != kBarrier))
      return Joined::failure(
          fmt::format("the display driver put a window into swap group {}, barrier {}", group, bound));
  }
  return made;
}

SwapGroup::~SwapGroup() {
  if (bound_) functions_.bind(kGroup, 0);
  for (auto window = joined_.rbegin(); window != joined_.rend(); ++window) functions_.join(*window, 0);
}

std::optional<std::uint32_t> SwapGroup::frameCount() const {
  std::uint32_t count = 0;
  if (!functions_.frameCount || !functions_.frameCount(count)) return {};
  return count;
}

std::optional<bool> offersQuadBuffer(void* display) {
  const auto x = SharedLibrary::open("libX11.so.6", "libx11-6");
  const auto gl = SharedLibrary::open("libGL.so.1", "libgl1");
  if (!display || !x || !gl) return {};
  auto* screenOf = x.value().find<int(void*)>("XDefaultScreen");
  auto* freeOf = x.value().find<int(void*)>("XFree");
  auto* choose = gl.value().find<void**(void*, int, const int*, int*)>("glXChooseFBConfig");
  if (!screenOf || !freeOf || !choose) return {};
  const int wanted[] = {kGlxRenderType, kGlxRgbaBit, kGlxDoubleBuffer, 1, kGlxStereo, 1, 0};
  int count = 0;
  void** const all = choose(display, screenOf(display), wanted, &count);
  if (all) freeOf(all);
  return count > 0;
}

}  // namespace stadion
