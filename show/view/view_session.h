#pragma once
/// A show in windows, with a person at the keyboard, from the first picture to the last.
///
/// The show plays on threads of its own (PlayingShow). This class does the work of the main thread: windows,
/// keys, the text over the walls, screenshots, the next group. It also reads a changed script again while the
/// show goes on.
///
/// Ownership  the reporter must outlive it.
/// Threads    main.
///
/// Size     more than 20 fields: each part of the session is one, in the order in which they need each other.

#include "pipeline/loop/picture_mailbox.h"
#include "pipeline/record/run_summary.h"
#include "show/base/reporter.h"
#include "show/display/budget_panel.h"
#include "show/player/script_watch.h"
#include "show/session/session_end.h"
#include "show/view/playing_show.h"
#include "show/view/show_reload.h"
#include "show/view/view_controls.h"
#include "show/view/view_hud.h"
#include "show/view/view_settings.h"
#include "show/view/view_windows.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <vector>

namespace stadion {

/// The results of a viewed show.
struct ViewReport {
  RunSummary summary{};
  Vec3 rig = Vec3::Zero();    ///< where the rig stands [m]
  std::uint64_t frames = 0;   ///< number of simulated frames
  std::uint64_t dropped = 0;  ///< ticks without a frame
  std::string lateFrames{};   ///< how many frames were late and why; empty if none was
};

class ViewSession {
public:
  /// Opens display, windows and show. Null, with the reason in the findings, if one of them cannot be.
  static std::unique_ptr<ViewSession> open(ViewSettings settings, Reporter& reporter, Diagnostics& findings);

  /// Plays until the viewer quits, the show ends, or `stop` is set.
  SessionEnd run(const std::atomic<bool>& stop);
  /// After run().
  const ViewReport& report() const { return report_; }

private:
  using Clock = std::chrono::steady_clock;

  /// Shows the reporter's lines in the window while the show plays.
  class HudReporter final : public Reporter {
  public:
    HudReporter(Reporter& to, ViewHud& hud) : to_(to), hud_(hud) {}
    void showIn(OperatorWeb* web) { web_ = web; }
    void say(const std::string& line) override {
      to_.say(line);
      hud_.say(line);
      if (OperatorWeb* web = web_) web->say(line);
    }
    void hint(const std::string& line) override { to_.hint(line); }
    void fault(const std::string& why) override { to_.fault(why); }
    void report(const Diagnostics& findings) override;

  private:
    Reporter& to_;
    ViewHud& hud_;
    std::atomic<OperatorWeb*> web_ = nullptr;
  };

  ViewSession(ViewSettings settings, Reporter& reporter)
      : settings_(std::move(settings)), reporter_(reporter),
        files_(settings_.session.show.script, settings_.session.show.assetRoots,
               settings_.session.show.types) {}
  bool openDrawing(Diagnostics& findings);
  ShowSurroundings surroundings(std::shared_ptr<ReusableResources> kept);

  void takeEvents();
  void take(std::size_t window, const WindowEvent& event);
  bool command(const WindowEvent& event);
  bool viewersCommand(Key key);
  bool operatorsCommand(Key key, bool shift);
  void step();
  void changeSpeed(double factor);
  void moveOverview();
  void pollPad();

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
  BudgetNumbers budgetNumbers() const;
  void takeScreenshot();
  void say(const std::string& line) { hudReporter_.say(line); }

  ViewSettings settings_;
  Reporter& reporter_;
  WallFile walls_;
  std::unique_ptr<ViewWindows> windows_;
  std::unique_ptr<ShowRenderer> renderer_;
  DeskVisitor visitor_;
  ViewControls controls_{visitor_};
  PictureMailbox mailbox_;
  ViewHud hud_;
  HudReporter hudReporter_{reporter_, hud_};
  std::unique_ptr<OperatorConsole> console_;
  OverviewPlace overview_;
  ScriptWatch files_;
  std::unique_ptr<OperatorWeb> web_;
  std::unique_ptr<PlayingShow> show_;
  std::unique_ptr<ShowReload> reload_;
  std::vector<EyePictures> pictures_;  ///< shown
  TimeSignature shown_;
  std::uint64_t unseen_ = 0;  ///< frames of this show that were played, but not shown
  Clock::time_point filesLookedAt_{}, hudDrawn_{}, padAsked_{};
  std::atomic<bool> ended_ = false;
  bool quit_ = false, stale_ = true;
  bool begins_ = true;  ///< nothing of this show has been shown yet
  bool over_ = false;   ///< the show has ended, and the one after it has errors
  /// Single frames were asked for: the first number that has not been told of.
  std::optional<std::uint64_t> steppedFrom_;
  SessionEnd end_ = SessionEnd::Played;
  ViewReport report_;
};

}  // namespace stadion
