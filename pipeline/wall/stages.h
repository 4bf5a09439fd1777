#pragma once
/// The stages App, Cull and Draw of a frame, with what goes before and after them, as the frame loop calls
/// them.
///
/// The loop decides on which thread they run, and when; the stages do not know whether they are overlapped.
///
/// Threads  app(), still() and wantsDrawn() on the App thread; cull(w) on wall w's Cull thread; openWall,
///          warmUp, latch, draw and closeWall(w) on wall w's Draw thread; swap() on the Draw thread that
///          arrives last, while the others wait. In sequential mode all on one thread.
/// Errors   a stage that cannot go on returns a reason; the loop stops every thread and hands the reason on.
///          What a stage throws (it should not: memory may run out) becomes such a reason, with the stage's
///          name and frame. RunStopped ends the run: from App before this frame, from Draw at once.

#include "engine/base/diagnostic.h"
#include "engine/base/time_signature.h"
#include "pipeline/draw_list/draw_list.h"
#include "pipeline/frame/frame_ticket.h"

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace stadion {

/// The origin of a failure.
enum class FailureKind {
  Fault,       ///< in Stadion or OpenGL
  Refusal,     ///< the user can mend it: a full disk, a picture that is too large
  WrongWrite,  ///< a stage wrote what it may only read (FrameLoopOptions::watch)
};

/// Why a stage could not go on.
struct Reason {
  Reason(std::string what) : message(std::move(what)) {}
  Reason(const char* what) : message(what) {}
  Reason(std::string what, FailureKind whose) : message(std::move(what)), kind(whose) {}
  /// Makes the reason from a finding: its file comes first.
  explicit Reason(const Diagnostic& d, FailureKind whose = FailureKind::Fault)
      : message(d.where.file.empty() ? d.message : d.where.file + ": " + d.message), kind(whose) {}

  std::string message;
  FailureKind kind = FailureKind::Fault;
  NodeRef node{};  ///< the node that it is about; invalid: none
};

/// The result of a step that can fail: why it failed, or kNoFailure.
using Failure = std::optional<Reason>;
inline constexpr std::nullopt_t kNoFailure = std::nullopt;

class Stages {
public:
  virtual ~Stages() = default;

  /// Advances the show to the signature's time and publishes it into `slot`.
  virtual void app(const TimeSignature& now, std::size_t slot) = 0;
  /// The show is paused after frame `now`: publishes the scene once more. A scene that was restored during
  /// the pause has not been published yet.
  virtual void still(const TimeSignature& now, std::size_t slot) {
    (void)now;
    (void)slot;
  }
  /// Returns true if this frame is needed; else it is neither culled nor drawn. Asked after app().
  virtual bool wantsDrawn(const FrameTicket&) const { return true; }
  /// Fills `list` with what wall `wall` shows of the frame in `slot`, in all its views.
  virtual void cull(std::size_t wall, std::size_t slot, DrawList& list) = 0;

  /// When the head's pose was measured that app() or still() has just taken. If that is not known, the start
  /// of the frame counts. On the App thread.
  virtual std::optional<std::chrono::steady_clock::time_point> headMeasured() const { return {}; }
  /// Returns the measurement time of the head pose in the picture that the wall shows, asked while all are
  /// swapped. Nothing: that of the frame counts.
  virtual std::optional<std::chrono::steady_clock::time_point> posed(std::size_t wall) const {
    (void)wall;
    return {};
  }

  /// Just before draw(): a newer head may take the place of the list's.
  virtual void latch(std::size_t wall, DrawList& list) {
    (void)wall;
    (void)list;
  }

  virtual Failure openWall(std::size_t wall) = 0;
  /// Compiles the shaders and uploads the meshes that lists such as this one need. Nothing of it is shown or
  /// counted, and no state of the show changes. Called once, before the wall's first draw(), with that list,
  /// which is complete.
  virtual Failure warmUp(std::size_t wall, const DrawList& list) {
    (void)wall;
    (void)list;
    return kNoFailure;
  }
  /// Cull may still be filling the list (ListFilling).
  virtual Failure draw(std::size_t wall, const DrawList& list) = 0;
  virtual void closeWall(std::size_t wall) = 0;

  /// All walls have drawn this frame (if it is drawn), in all views: show it.
  virtual Failure swap(const TimeSignature& now) = 0;
};

}  // namespace stadion
