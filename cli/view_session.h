#pragma once
/// A show in windows, and somebody at the keyboard: what `stadion view` does from its first picture to its
/// last.
///
/// The show plays on threads of its own (PlayingShow); this is the main thread's part: windows, keys, the
/// text over the walls, screenshots, and reading a changed script again beside the show that goes on.
///
/// Threads  main.

#include "cli/playing_show.h"
#include "cli/script_watch.h"
#include "cli/show_windows.h"
#include "cli/view_controls.h"
#include "cli/view_hud.h"
#include "cli/view_options.h"
#include "pipeline/output/picture_mailbox.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

namespace stadion {

class ViewSession {
public:
  /// Opens display, windows and show. Null, with the reason in the findings, if one of them cannot be.
  static std::unique_ptr<ViewSession> open(ViewOptions options, Diagnostics& findings);
  ~ViewSession();

  /// Until somebody quits, the show ends, or `stop` is set. Returns the exit code.
  int run(const std::atomic<bool>& stop);

private:
  using Clock = std::chrono::steady_clock;
  /// A show that has been read again.
  struct Reload {
    std::thread thread;
    std::atomic<bool> done = false;
    std::unique_ptr<PlayingShow> show;  ///< null if it has errors
    Diagnostics findings;
  };

  explicit ViewSession(ViewOptions options)
      : options_(std::move(options)), files_(options_.run.show.script, options_.run.show.assetRoots) {}
  bool openWindows(Diagnostics& findings);
  bool openDrawing(Diagnostics& findings);
  ShowSurroundings surroundings();

  void takeEvents();
  void take(std::size_t window, const WindowEvent& event);
  bool command(Key key);
  void begin(const std::optional<ShowPlace>& place);
  void setPaused(bool paused);
  void changeSpeed(double factor);
  void moveOverview();
  void pollPad();

  void watchFiles();
  void beginReload(const char* why);
  void finishReload();
  void endShow();

  std::vector<WindowPane> panesOf(std::size_t window) const;
  std::vector<std::size_t> wallsOf(std::size_t window) const;
  std::size_t overviewIndex() const { return walls_.walls.size(); }
  void show(bool fresh);
  void updateHud();
  HudFigures figures() const;
  void takeScreenshot();
  void say(const std::string& line);

  ViewOptions options_;
  WallFile walls_;
  std::unique_ptr<WindowSystem> system_;
  std::vector<std::unique_ptr<ShowWindow>> windows_;
  std::vector<SheetPlace> sizes_;  ///< of the walls' pictures
  std::unique_ptr<GlProvider> provider_;
  DeskVisitor visitor_;
  ViewControls controls_{visitor_};
  Playback playback_;
  PictureMailbox mailbox_;
  ViewHud hud_;
  OverviewPlace overview_;
  ScriptWatch files_;
  std::unique_ptr<PlayingShow> show_;
  std::unique_ptr<Reload> reload_;
  std::vector<EyePictures> pictures_;  ///< shown
  TimeSignature shown_;
  Clock::time_point filesLookedAt_{}, hudDrawn_{}, padAsked_{};
  std::atomic<bool> ended_ = false;
  bool quit_ = false, stale_ = true;
  bool begins_ = true;                        ///< nothing of this show has been shown yet
  bool pausedByUser_ = false;                 ///< before it began
  std::optional<std::uint64_t> steppedFrom_;  ///< a single frame was asked for: the first number it can have
  int shots_ = 0;
  int code_ = 0;
};

}  // namespace stadion
