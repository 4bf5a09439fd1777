#include "pipeline/loop/frame_loop.h"

#include "engine/base/run_stopped.h"
#include "pipeline/loop/barrier.h"
#include "pipeline/loop/list_queue.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <new>
#include <thread>
#include <utility>
#include <vector>

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kAllWalls = ~std::size_t{0};

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Times one stage of one frame, and reports it to the probe if there is one.
class StageSpan {
public:
  StageSpan(DurationSeries& series, FrameProbe* probe, Span stage, std::uint64_t frame,
            std::uint32_t wall = kNoWall)
      : series_(series), scope_(std::in_place, probe, stage, frame, wall) {}
  ~StageSpan() {
    scope_.reset();
    if (!counts_) return;
    try {
      series_.add(millisecondsSince(start_));
    } catch (const std::bad_alloc&) {
      // One duration is lost. If memory is really short, other code will report it.
    }
  }
  /// Leaves out a stage that did not finish, because its duration means nothing.
  void leaveOut() { counts_ = false; }
  StageSpan(const StageSpan&) = delete;
  StageSpan& operator=(const StageSpan&) = delete;

private:
  DurationSeries& series_;
  std::optional<SpanScope> scope_;
  bool counts_ = true;
  Clock::time_point start_ = Clock::now();
};

std::uint32_t numberOf(std::size_t wall) {
  return static_cast<std::uint32_t>(wall);
}

/// "Cull of wall 2, frame 17"
std::string stageText(const char* what, std::size_t wall, std::uint64_t frame) {
  std::string text = what;
  if (wall != kAllWalls) text += " of wall " + std::to_string(wall + 1);
  if (frame != kNoFrame) text += ", frame " + std::to_string(frame);
  return text;
}

Reason reasonOf(const std::string& stage, const WrongWrite& wrong) {
  Reason why(stage + ": wrote to " + wrong.what, FailureKind::WrongWrite);
  why.node = wrong.node;
  return why;
}

}  // namespace

/// A pipelined run: what its threads share, and the work of each kind of thread.
class FrameLoop::Pipeline {
public:
  explicit Pipeline(FrameLoop& loop);
  /// Starts all threads and waits for their end.
  void run();

private:
  void app();                   ///< fills slots
  void cull(std::size_t wall);  ///< turns slots into lists
  void draw(std::size_t wall);  ///< draws lists, and shows each frame together with the other walls
  void drawThenClose(std::size_t wall);
  bool openTogether(std::size_t wall);
  bool warmUpTogether(std::size_t wall, DrawList& list);
  bool awaitWarmWalls();
  bool swapTogether(std::size_t wall, const FrameTicket& ticket);
  /// Ends all waiting if the run is broken: a failure in one thread must not leave the others waiting for it.
  void stopIfBroken();

  FrameLoop& loop_;
  const std::size_t walls_;
  FrameSlots slots_;
  std::deque<ListQueue> queues_;  ///< by wall
  Barrier swap_;
  // All walls and App wait here. No wall draws before all are ready, since they may share a rasteriser.
  // Meanwhile show time stands still.
  Barrier opened_, warm_;
  std::once_flag warming_;
  Clock::time_point warmUpBegan_{}, warmUpEnded_{};  ///< set before `warm_` opens
};

FrameLoop::FrameLoop(Stages& stages, const FrameLoopOptions& options, const std::atomic<bool>& stopRequested,
                     FrameProbe* probe)
    : stages_(stages), options_(options), stopRequested_(stopRequested), probe_(probe),
      pacer_(options.pace, options.rate, options.everyTick), clock_(options.rate, options.frameTimes),
      warmUps_(options.walls), times_(options.walls) {
  pacer_.startLate(std::chrono::nanoseconds(options.late));
  if (!options.after) return;
  clock_ = FrameClock(options.rate, *options.after, options.frameTimes);
  lastSignature_ = *options.after;
  lastSignature_.decisions = {};
  nextIndex_ = options.after->frame + 1;
  begun_ = true;  // the show may stand still at that frame
}

FrameLoopOutcome FrameLoop::run() {
  // The caller may be at the bottom of a thread, so exceptions must not leave.
  attempt("the frame loop", kAllWalls, kNoFrame, [&]() -> Failure {
    options_.mode == Mode::Sequential ? runSequential() : runPipelined();
    return kNoFailure;
  });
  outcome_.missedTicks = pacer_.missed();
  outcome_.stopped = stopped_;
  return std::move(outcome_);  // copying it may need memory
}

template <class Wait>
auto FrameLoop::timedWait(Span what, std::uint64_t frame, std::size_t wall, const Wait& wait) {
  const SpanScope span(probe_, what, frame, numberOf(wall));
  return wait();
}

// Runs one frame after the other, one stage after the other.
void FrameLoop::runSequential() {
  std::vector<DrawList> lists(options_.walls);
  bool well = true, warm = false;
  for (std::size_t wall = 0; well && wall < options_.walls; ++wall) well = openStage(wall);

  while (well) {
    std::optional<FrameOrder> order;
    well = attempt("App", kAllWalls, nextIndex_, [&]() -> Failure {
      order = nextOrder();
      return kNoFailure;
    });
    if (!order) break;
    auto ticket = appStage(*order, 0);
    well = ticket.has_value();
    for (std::size_t wall = 0; well && wall < options_.walls; ++wall)
      well = cullStage(wall, 0, *ticket, lists[wall]);
    if (well && ticket->drawn && !std::exchange(warm, true)) {
      const Clock::time_point began = Clock::now();
      for (std::size_t wall = 0; well && wall < options_.walls; ++wall) well = warmUpStage(wall, lists[wall]);
      const auto took = Clock::now() - began;
      for (DrawList& list : lists) list.ticket.delay(took);
      ticket->delay(took);
      warmedUp(took);
    }
    for (std::size_t wall = 0; well && wall < options_.walls; ++wall) well = drawStage(wall, lists[wall]);
    well = well && swapStage(*ticket);
  }

  for (std::size_t wall = 0; wall < options_.walls; ++wall) closeStage(wall);
}

// Overlaps the same stages: App fills slots, Cull turns slots into lists, Draw draws lists, all walls swap
// together.
void FrameLoop::runPipelined() {
  Pipeline(*this).run();
}

// No host may skip frames that all hosts show together.
FrameLoop::Pipeline::Pipeline(FrameLoop& loop)
    : loop_(loop), walls_(loop.options_.walls),
      slots_(walls_, loop.options_.orders ? Delivery::Every : loop.options_.delivery), swap_(walls_),
      opened_(walls_ + 1), warm_(walls_ + 1) {
  while (queues_.size() < walls_) queues_.emplace_back(loop.options_.drawBeginsEarly && !loop.options_.watch);
}

void FrameLoop::Pipeline::app() {
  bool isWarm = walls_ == 0;
  if (!isWarm && !opened_.arrive([] {})) return;
  while (const auto order = loop_.nextOrder()) {
    slots_.limitInFlight(loop_.mostInFlight(), loop_.wallsLeft());
    const auto slot =
        loop_.timedWait(Span::ForSlot, kNoFrame, kAllWalls, [&] { return slots_.beginWrite(); });
    if (!slot) return;
    const auto ticket = loop_.appStage(*order, *slot);
    if (!ticket) break;
    slots_.endWrite(*slot, *ticket);
    if (ticket->drawn && !std::exchange(isWarm, true) && !awaitWarmWalls()) break;
  }
  slots_.finish();
}

// A wall leases a slot only once it has an empty list. So the walls of a room never lease more than the two
// frames after the one shown last, and App finds the third slot at once. If every
// frame is drawn, App waits for it.
void FrameLoop::Pipeline::cull(std::size_t wall) {
  const auto nextLease = [&] { return slots_.lease(wall); };
  const auto emptyList = [&] { return queues_[wall].takeEmpty(); };
  while (DrawList* list = loop_.timedWait(Span::ForList, kNoFrame, wall, emptyList)) {
    const auto lease = loop_.timedWait(Span::ForFrame, kNoFrame, wall, nextLease);
    if (!lease) break;
    if (!loop_.cullStage(wall, lease->slot, lease->ticket, *list)) return;
    list->filling->finish(!slots_.release(*lease));
  }
  queues_[wall].finish();
}

void FrameLoop::Pipeline::draw(std::size_t wall) {
  if (!openTogether(wall)) return;
  const auto next = [&] { return queues_[wall].takeHanded(); };
  bool isWarm = false;
  while (DrawList* list = loop_.timedWait(Span::ForDraw, kNoFrame, wall, next)) {
    if (list->ticket.drawn && !std::exchange(isWarm, true) && !warmUpTogether(wall, *list)) return;
    if (!list->filling->isVoid() && !loop_.drawStage(wall, *list)) return;
    if (list->filling->isCutShort()) return;
    slots_.noteDrawn();
    if (!swapTogether(wall, list->ticket)) return;
    queues_[wall].giveEmpty(list);
  }
}

bool FrameLoop::Pipeline::openTogether(std::size_t wall) {
  if (loop_.openStage(wall)) return opened_.arrive([] {});
  loop_.broken_ = true;  // stops the run even without a failure: App and the other walls would wait
  return false;
}

bool FrameLoop::Pipeline::warmUpTogether(std::size_t wall, DrawList& list) {
  std::call_once(warming_, [&] { warmUpBegan_ = Clock::now(); });
  if (list.filling->isWhole() && !loop_.warmUpStage(wall, list)) return false;
  const auto end = [&] { warmUpEnded_ = Clock::now(); };
  if (!loop_.timedWait(Span::ForWalls, kNoFrame, wall, [&] { return warm_.arrive(end); })) return false;
  list.ticket.delay(warmUpEnded_ - warmUpBegan_);  // equal on all walls, since it is one frame
  return true;
}

// App's side of warmUpTogether().
bool FrameLoop::Pipeline::awaitWarmWalls() {
  const Clock::time_point began = Clock::now();
  const auto end = [&] { warmUpEnded_ = Clock::now(); };
  if (!loop_.timedWait(Span::ForSlot, kNoFrame, kAllWalls, [&] { return warm_.arrive(end); })) return false;
  loop_.warmedUp(Clock::now() - began);
  return true;
}

bool FrameLoop::Pipeline::swapTogether(std::size_t wall, const FrameTicket& ticket) {
  bool shown = true;
  const auto show = [&] {
    shown = loop_.swapStage(ticket);
    slots_.noteShown();
  };
  const auto arrive = [&] { return swap_.arrive(show); };
  return loop_.timedWait(Span::ForWalls, ticket.signature.frame, wall, arrive) && shown;
}

void FrameLoop::Pipeline::run() {
  std::vector<std::thread> threads;
  const auto start = [&](const char* what, std::size_t wall, std::function<void()> work) {
    threads.emplace_back([this, what, wall, work = std::move(work)] {
      loop_.attempt(what, wall, kNoFrame, [&]() -> Failure {
        work();
        return kNoFailure;
      });
      stopIfBroken();
    });
  };
  threads.reserve(1 + 2 * walls_);
  loop_.attempt("starting the threads", kAllWalls, kNoFrame, [&]() -> Failure {
    for (std::size_t wall = 0; wall < walls_; ++wall) {
      start("Cull", wall, [this, wall] { cull(wall); });
      start("Draw", wall, [this, wall] { drawThenClose(wall); });
    }
    start("App", kAllWalls, [this] { app(); });
    return kNoFailure;
  });
  stopIfBroken();
  for (std::thread& t : threads) t.join();
}

void FrameLoop::Pipeline::drawThenClose(std::size_t wall) {
  loop_.attempt("Draw", wall, kNoFrame, [&]() -> Failure {
    draw(wall);
    return kNoFailure;
  });
  stopIfBroken();
  loop_.closeStage(wall);
}

void FrameLoop::Pipeline::stopIfBroken() {
  if (!loop_.broken_) return;
  slots_.stop();
  for (ListQueue& q : queues_) q.stop();
  swap_.stop();
  opened_.stop();
  warm_.stop();
}

std::optional<FrameOrder> FrameLoop::nextOrder() {
  if (nextIndex_ == 0 && stopRequested_) stopped_ = ended_ = true;
  if (ended_ || broken_) return std::nullopt;
  if (options_.orders && !options_.orders->leads()) return leadersOrder();
  const std::uint64_t ticks = timedWait(Span::ForTick, nextIndex_, kAllWalls, [&] { return pacer_.wait(); });
  if (!takeCommands()) return std::nullopt;
  const double speed = options_.playback && begun_ ? options_.playback->takeFrame(lastSignature_.time) : 1;
  // A continued show that is past its last frame ends once this frame has been shown.
  if (speed == 0 || isPastEnd()) return issue({lastSignature_, {}, standstill()});
  // A single step is one tick, however long the last frame took.
  const bool single = options_.playback && options_.playback->paused();
  TimeSignature now = signatureAfter(single ? 1 : ticks, speed);
  if (options_.end > 0 && now.time > options_.end) return std::nullopt;
  now.decisions = decisionsFor(now.frame);
  ++nextIndex_;
  begun_ = true;
  lastSignature_ = now;
  return issue({now});
}

Standstill FrameLoop::standstill() const {
  const bool waits = options_.controls && options_.controls->state().waiting;
  return waits ? Standstill::Waiting : Standstill::Paused;
}

// Returns the frame to be shown, and whether it is the last. On the leader, also sends it to all hosts.
FrameOrder FrameLoop::issue(FrameOrder order) {
  if (options_.controls) order.presentation = options_.controls->state().presentation;
  // A waiting show plays its first frame, and a paused one each single step. Then time stands still again.
  const bool stands =
      order.still != Standstill::None || (options_.controls && options_.controls->state().still());
  if (stands) order.standsAfter = standstill();
  if (!options_.orders) return order;
  order.last = noneFollows();
  options_.orders->issue(order);
  return order;
}

// Returns the leader's order.
std::optional<FrameOrder> FrameLoop::leadersOrder() {
  auto order = timedWait(Span::ForTick, nextIndex_, kAllWalls, [&] { return options_.orders->next(); });
  if (!order) {
    if (stopRequested_) stopped_ = true;
    return std::nullopt;
  }
  nextIndex_ = order->signature.frame + 1;
  return order;
}

// Returns the decision of the log, or in a live run of the decider, which measures time.
FrameDecisions FrameLoop::decisionsFor(std::uint64_t frame) {
  FrameDecisions decisions = options_.decider ? options_.decider->decide(frame) : FrameDecisions{};
  const auto [first, last] = options_.degradation.equal_range(frame);
  for (auto at = first; at != last; ++at) decisions.add(at->second);
  return decisions;
}

// Applies the operator's commands to the whole coming frame. Returns false if no frame follows.
bool FrameLoop::takeCommands() {
  if (!options_.controls) return true;
  options_.controls->beginFrame(nextIndex_);
  const OperatorState& state = options_.controls->state();
  outcome_.nextGroup = state.nextGroup;
  ending_ = ending_ || state.end;
  return !state.nextGroup;
}

std::size_t FrameLoop::mostInFlight() const {
  const bool commanded = options_.controls && options_.controls->state().mostInFlight > 0;
  return commanded ? static_cast<std::size_t>(options_.controls->state().mostInFlight)
                   : options_.mostInFlight;
}

// Returns the number of walls that may still draw the oldest frame when one frame more begins: processors are
// idle then. It is at most half of the walls, since a frame that begins too early is old when it is shown.
std::size_t FrameLoop::wallsLeft() const {
  const std::size_t processors = std::max(1u, std::thread::hardware_concurrency());
  return std::min(options_.walls / 2, processors - 1);
}

// If every frame counts, time advances by frames. If the newest counts, it advances by the clock's ticks.
TimeSignature FrameLoop::signatureAfter(std::uint64_t ticks, double speed) {
  const std::uint64_t counted = options_.delivery == Delivery::Latest ? ticks : 1;
  if (speed == 1) return clock_.next(counted);
  return clock_.nextAfter(fromSeconds(speed * static_cast<double>(counted) / options_.rate));
}

// Returns true if no frame follows. Asked once a frame on the App thread: after App, so that the last frame
// is known before it is drawn, or on the leader of a cluster when it sends the order, before App.
bool FrameLoop::noneFollows() {
  if (stopRequested_) stopped_ = true;
  return stopped_ || ending_ || isPastEnd();
}

/// Returns true if the show has been played to its end.
bool FrameLoop::isPastEnd() const {
  return (options_.frames != 0 && nextIndex_ >= options_.frames) ||
         (options_.end > 0 && clock_.timeOfNext() > options_.end);
}

/// Runs a piece of work. If it fails or throws, keeps the reason and returns false.
template <class Work>
bool FrameLoop::attempt(const char* what, std::size_t wall, std::uint64_t frame, const Work& work) {
  try {
    Failure f = work();
    return !f || fail(std::move(*f));
  } catch (const RunStopped&) {
    stopped_ = true;
    return false;
  } catch (const std::bad_alloc&) {
    return fail(what, wall, frame, "out of memory");
  } catch (const std::exception& e) {
    return fail(what, wall, frame, e.what());
  } catch (...) {
    return fail(what, wall, frame, "an unknown exception");
  }
}

/// Runs a stage as attempt() does. With --guard, it also fails if it writes to the published scene.
template <class Work>
bool FrameLoop::attemptGuarded(const char* what, std::size_t wall, std::uint64_t frame, const Work& work) {
  if (!options_.watch) return attempt(what, wall, frame, work);
  return attempt(what, wall, frame, [&]() -> Failure {
    const WriteGuard::Stage stage;
    Failure f = work();
    const auto wrong = f ? std::nullopt : options_.watch->inScene(stage);
    return wrong ? Failure(reasonOf(stageText(what, wall, frame), *wrong)) : std::move(f);
  });
}

bool FrameLoop::fail(const char* what, std::size_t wall, std::uint64_t frame, const char* why) noexcept {
  try {
    return fail(Reason(stageText(what, wall, frame) + ": " + why));
  } catch (...) {
    return fail(Reason("out of memory"));  // not even enough memory for a message
  }
}

/// Returns true if a frame is so late that it is not drawn. Of such frames in a row, one a second is drawn.
bool FrameLoop::leavesUndrawn(const FrameTicket& ticket) {
  const bool late = (options_.everyTick || pacer_.catchesUp()) && options_.mode == Mode::Sequential &&
                    !options_.orders && !ticket.last && pacer_.behind();
  undrawnInARow_ = late && static_cast<double>(undrawnInARow_) < options_.rate ? undrawnInARow_ + 1 : 0;
  return undrawnInARow_ > 0;
}

std::optional<FrameTicket> FrameLoop::appStage(const FrameOrder& order, std::size_t slot) {
  const TimeSignature& now = order.signature;
  FrameTicket ticket{now, Clock::now()};
  ticket.presentation = order.presentation;
  if (order.still != Standstill::None) {
    const auto still = [&]() -> Failure {
      stages_.still(now, slot);
      return kNoFailure;
    };
    if (!attemptGuarded("App", kAllWalls, now.frame, still)) return std::nullopt;
    ticket.last = ended_ = options_.orders ? order.last : noneFollows();
    ticket.drawn = order.drawn;
    ticket.posed = stages_.headMeasured().value_or(ticket.began);
    return ticket;
  }
  {
    const StageSpan span(times_.app, probe_, Span::App, now.frame);
    const auto app = [&]() -> Failure {
      stages_.app(now, slot);
      return kNoFailure;
    };
    if (!attemptGuarded("App", kAllWalls, now.frame, app)) return std::nullopt;
  }
  ++outcome_.framesSimulated;
  ticket.posed = stages_.headMeasured().value_or(ticket.began);
  ticket.last = ended_ = options_.orders ? order.last : noneFollows();
  ticket.drawn = order.drawn && stages_.wantsDrawn(ticket) && !leavesUndrawn(ticket);
  return ticket;
}

bool FrameLoop::cullStage(std::size_t wall, std::size_t slot, const FrameTicket& ticket, DrawList& list) {
  const std::uint64_t frame = ticket.signature.frame;
  bool well = true;
  list.ticket = ticket;
  if (ticket.drawn) {
    const StageSpan span(times_.cull[wall], probe_, Span::Cull, frame, numberOf(wall));
    const auto cull = [&]() -> Failure {
      stages_.cull(wall, slot, list);
      return kNoFailure;
    };
    well = attemptGuarded("Cull", wall, frame, cull);
  }
  return well;
}

bool FrameLoop::openStage(std::size_t wall) {
  const Clock::time_point began = Clock::now();
  const bool well = attempt("opening", wall, kNoFrame, [&] { return stages_.openWall(wall); });
  warmUps_[wall] += millisecondsSince(began);
  return well;
}

// Runs before a wall draws for the first time, so that its first frame takes no longer than others.
bool FrameLoop::warmUpStage(std::size_t wall, const DrawList& list) {
  const Clock::time_point began = Clock::now();
  const std::uint64_t frame = list.ticket.signature.frame;
  const bool well = attemptGuarded("warming up", wall, frame, [&] { return stages_.warmUp(wall, list); });
  warmUps_[wall] += millisecondsSince(began);
  if (!well) broken_ = true;
  return well;
}

/// Show time stood still meanwhile. A show that continues after a crash has to catch up with this time, too.
void FrameLoop::warmedUp(Clock::duration took) {
  if (!options_.after) pacer_.hold(took);
  // One entry per wall, for walls drawn one after the other or at once.
  for (const double ms : warmUps_)
    times_.warmUp = options_.mode == Mode::Sequential ? times_.warmUp + ms : std::max(times_.warmUp, ms);
}

void FrameLoop::closeStage(std::size_t wall) {
  attempt("closing", wall, kNoFrame, [&]() -> Failure {
    stages_.closeWall(wall);
    return kNoFailure;
  });
}

bool FrameLoop::drawStage(std::size_t wall, DrawList& list) {
  if (!list.ticket.drawn) return true;
  const std::uint64_t frame = list.ticket.signature.frame;
  StageSpan span(times_.draw[wall], probe_, Span::Draw, frame, numberOf(wall));
  if (attemptGuarded("Draw", wall, frame, [&] { return drawWall(wall, list); })) return true;
  span.leaveOut();
  broken_ = true;  // stops the run even without a failure: the other walls would wait for this one
  return false;
}

Failure FrameLoop::drawWall(std::size_t wall, DrawList& list) {
  stages_.latch(wall, list);
  if (!options_.watch) return stages_.draw(wall, list);
  options_.watch->keep(wall, list);
  if (Failure f = stages_.draw(wall, list)) return f;
  const auto wrong = options_.watch->inList(wall, list);
  if (!wrong) return kNoFailure;
  return reasonOf(stageText("Draw", wall, list.ticket.signature.frame), *wrong);
}

bool FrameLoop::swapStage(const FrameTicket& ticket) {
  const TimeSignature& now = ticket.signature;
  if (options_.orders && !options_.orders->mayShow(now)) {
    if (stopRequested_) stopped_ = true;
    broken_ = true;  // no thread waits for this frame any longer
    return false;
  }
  {
    const StageSpan span(times_.swap, probe_, Span::Swap, now.frame);
    if (!attempt("Swap", kAllWalls, now.frame, [&] { return stages_.swap(now); })) return false;
  }
  ++outcome_.framesShown;
  countTicksWithoutFrame(ticket);
  if (ticket.drawn) noteShown(ticket);
  lastDrawn_ = ticket.drawn;
  return true;
}

void FrameLoop::noteShown(const FrameTicket& ticket) {
  const Clock::time_point shown = Clock::now();
  const auto since = [&](Clock::time_point then) {
    return std::chrono::duration<double, std::milli>(shown - then).count();
  };
  ++outcome_.framesDrawn;
  if (lastDrawn_) times_.period.add(since(lastSwap_));
  lastSwap_ = shown;
  for (std::size_t wall = 0; wall < times_.latency.size(); ++wall)
    times_.latency[wall].add(since(stages_.posed(wall).value_or(ticket.posed)));
}

/// Counts the ticks since the frame shown before. Frames that began before the first one was shown do not
/// count: the driver was not ready.
void FrameLoop::countTicksWithoutFrame(const FrameTicket& ticket) {
  if (outcome_.framesShown == 1) ready_ = Clock::now();
  if (ticket.began < ready_) return;
  const TimeSignature& now = ticket.signature;
  if (lastShown_) {
    const auto ticks = std::llround(toSeconds(now.time - *lastShown_) * options_.rate);
    const auto passed = static_cast<std::uint64_t>(std::max(ticks, 1LL) - 1);
    outcome_.ticksWithoutFrame += passed;
    outcome_.mostTicksWithoutFrame = std::max(outcome_.mostTicksWithoutFrame, passed);
  }
  lastShown_ = now.time;
}

bool FrameLoop::fail(Reason why) {
  const std::lock_guard lock(failureMutex_);
  if (!outcome_.failure) outcome_.failure = std::move(why);
  broken_ = true;
  return false;
}

}  // namespace stadion
