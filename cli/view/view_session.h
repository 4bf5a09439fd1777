#pragma once
/// A show in windows, and somebody at the keyboard: what `stadion view` does from its first picture to its
/// last.
///
/// The show plays on threads of its own (PlayingShow); this is the main thread's part: windows, keys, the
/// text over the walls, screenshots, the next group, and reading a changed script again beside the show that
/// goes on.
///
/// Threads  main.

#include "cli/view/view_hud.h"
#include "cli/view/view_options.h"
#include "cli/view/view_windows.h"
#include "pipeline/loop/picture_mailbox.h"
#include "show/base/script_watch.h"
#include "show/view/playing_show.h"
#include "show/view/show_reload.h"
#include "show/view/view_controls.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <vector>

namespace stadion {

class ViewSession {
public:
  /// Opens display, windows and show. Null, with the reason in the findings, if one of them cannot be.
  static std::unique_ptr<ViewSession> open(ViewOptions options, Diagnostics& findings);

  /// Until somebody quits, the show ends, or `stop` is set. Returns the exit code.
  int run(const std::atomic<bool>& stop);

private:
  using Clock = std::chrono::steady_clock;

  explicit ViewSession(ViewOptions options)
      : options_(std::move(options)), files_(options_.run.show.script, options_.run.show.assetRoots) {}
  bool openDrawing(Diagnostics& findings);
  ShowSurroundings surroundings(std::shared_ptr<KeptParts> kept);

  void takeEvents();
  void take(std::size_t window, const WindowEvent& event);
  bool command(const WindowEvent& event);
  bool viewersCommand(Key key);
  bool operatorsCommand(Key key, bool shift);
  void step();
  void changeSpeed(double factor);
  void moveOverview();
  void pollPad();

  int displayLost(const std::string& why);

  void takePictures();
  void begin(const std::optional<ShowPlace>& place);
  void afterTheEnd();
  void nextGroup();
  void putInPlace(std::unique_ptr<PlayingShow> show);
  void watchFiles();
  void beginReload(const std::string& why);
  void finishReload();
  void finishRecord();
  void endShow();

  void tellOfStep();
  void updateHud();
  HudFigures figures() const;
  void takeScreenshot();
  void say(const std::string& line);

  ViewOptions options_;
  WallFile walls_;
  std::unique_ptr<ViewWindows> windows_;
  std::unique_ptr<GlProvider> provider_;
  DeskVisitor visitor_;
  ViewControls controls_{visitor_};
  PictureMailbox mailbox_;
  ViewHud hud_;
  std::unique_ptr<LiveDesk> desk_;
  OverviewPlace overview_;
  ScriptWatch files_;
  std::unique_ptr<PlayingShow> show_;
  std::unique_ptr<ShowReload> reload_;
  std::vector<EyePictures> pictures_;  ///< shown
  TimeSignature shown_;
  std::uint64_t unseen_ = 0;  ///< frames of this show that were played, but not shown
  Clock::time_point filesLookedAt_{}, hudDrawn_{}, padAsked_{};
  std::atomic<bool> ended_ = false;
  bool quit_ = false, stale_ = true;
  bool begins_ = true;  ///< nothing of this show has been shown yet
  bool over_ = false;   ///< it has ended, and the one after it has errors
  /// Single frames were asked for: the first number that has not been told of.
  std::optional<std::uint64_t> steppedFrom_;
  int code_ = 0;
};

}  // namespace stadion
