#pragma once
/// Lets the driver swap the windows of a host together, or those of several hosts: GLX_NV_swap_group.
///
/// The windows of a *group* swap when a swap was asked for all of them. The groups that are bound to a *barrier*
/// swap when all are ready, also on other hosts, if their cards are joined for that (NVIDIA's Quadro Sync). The
/// program's own barrier comes first in any case: no wall is shown before all walls of the frame are drawn.
///
/// This code follows the specification of the extension, and tests of it call a table of functions of their own.
/// It has met no hardware.
///
/// Ownership  leaves barrier and group when it is destroyed. Display and windows must outlive it.
/// Threads    one at a time; the thread that owns the windows.
/// Errors     join() says why there is no group; what was joined before is left again.
/// Sources    GLX_NV_swap_group, revision 1.0, 2008.

#include "engine/base/diagnostic.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

/// Functions of GLX. A test has its own.
struct SwapGroupFunctions {
  using Drawable = unsigned long;  ///< a GLXDrawable

  std::function<std::string()> extensions;  ///< names, with blanks between them
  std::function<bool(std::uint32_t& groups, std::uint32_t& barriers)> most;  ///< glXQueryMaxSwapGroupsNV
  std::function<bool(Drawable window, std::uint32_t group)> join;            ///< group 0 leaves it
  std::function<bool(std::uint32_t group, std::uint32_t barrier)> bind;      ///< barrier 0 leaves it
  std::function<bool(Drawable window, std::uint32_t& group, std::uint32_t& barrier)> query;
  std::function<bool(std::uint32_t& count)> frameCount;  ///< pictures that the display has shown

  /// Those of a screen of an X server. `display` is Xlib's Display. Functions that the driver lacks are empty.
  static Result<SwapGroupFunctions> ofDisplay(void* display);
};

/// What a driver offers.
struct SwapGroupOffer {
  bool extension = false;
  std::uint32_t groups = 0, barriers = 0;  ///< how many it has

  /// Such as "GLX_NV_swap_group, 1 group, 1 barrier".
  std::string text() const;
};
SwapGroupOffer swapGroupOffer(const SwapGroupFunctions& functions);

/// What the user wants of the driver.
enum class SwapSync {
  Auto,     ///< a group, if there are several windows and the driver offers it
  Off,      ///< nothing: windows swap one directly after the other
  Barrier,  ///< a group and a barrier; without them the run does not begin
};

class SwapGroup {
public:
  static constexpr std::uint32_t kGroup = 1, kBarrier = 1;

  /// Joins the windows, and binds the group to the barrier if `barrier`. Expects at least one window.
  static Result<std::unique_ptr<SwapGroup>>
  join(SwapGroupFunctions functions, std::vector<SwapGroupFunctions::Drawable> windows, bool barrier);
  ~SwapGroup();
  SwapGroup(const SwapGroup&) = delete;
  SwapGroup& operator=(const SwapGroup&) = delete;

  bool hasBarrier() const { return bound_; }
  /// Returns the number of pictures that the display has shown; nothing if the driver does not count.
  std::optional<std::uint32_t> frameCount() const;

private:
  SwapGroup(SwapGroupFunctions functions) : functions_(std::move(functions)) {}

  SwapGroupFunctions functions_;
  std::vector<SwapGroupFunctions::Drawable> joined_;
  bool bound_ = false;
};

/// Whether a screen has a back buffer for each eye (frame-sequential stereo). `display` is Xlib's Display.
/// Nothing: there is no GLX.
std::optional<bool> offersQuadBuffer(void* display);

}  // namespace stadion
