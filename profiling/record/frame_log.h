#pragma once
/// Records what frames are spent on: a probe that writes each thread's spans into a buffer of its own,
/// without locks, and a thread that collects them.
///
/// What recording takes is measured beforehand and taken off: the figures are those of a show that nobody
/// watches.
///
/// Of drawing and of what nodes share, samples are taken, every `sampleEvery` frames, or in the next one that
/// is drawn, so that recording costs little: the stages' times are exact, a node's share of Cull and Draw is
/// that of the frames sampled.
///
/// Where App visits very many nodes, so are its frames: in most of them a node's visit is only recorded if it
/// took kDear, and what is in none of these is told of the frames that are recorded as a whole (SpanRecord).
/// Of nodes that are watched (NodeAccounts) the shorter visits are added up, by account and frame; and only
/// they are drawn alone, unless all is to be explained.
///
/// Threads    the probe's functions on the threads that do the work; the readers' on one thread of the log's
///            own, and on finish()'s once that has ended.
/// Ownership  the readers must outlive it.

#include "profiling/record/node_accounts.h"
#include "profiling/record/span_track.h"

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace stadion {

/// A span's time that is to be shared among nodes.
struct SharedSpan {
  Span what = Span::Test;
  std::uint64_t frame = 0;
  std::uint32_t wall = kNoWall;
  double ms = 0;
  std::vector<NodeRef> among;
  std::uint64_t round = 0;  ///< after so many frames it is told again
};

/// What visits that were not recorded took in one frame, of all nodes on that holder's account.
struct ShortVisits {
  std::uint64_t frame = 0;
  NodeRef holder;
  double ms = 0;
};

/// Whoever wants to know. Threads  one at a time.
class SpanReader {
public:
  virtual ~SpanReader() = default;
  /// `track` numbers the threads from 0, in the order in which they came. Spans of one thread come in the
  /// order of their ends, those of different threads nearly so.
  virtual void take(std::size_t track, const SpanRecord& record) = 0;
  virtual void take(const CountRecord&) {}
  virtual void take(const ShortVisits&) {}
  virtual void take(const SharedSpan&) {}
  virtual void take(const DrawnAlone&, const std::vector<NodeShare>&) {}
  /// All that there is at the moment has been handed on.
  virtual void caughtUp() {}
};

struct FrameLogOptions {
  bool samples = true;  ///< shares and drawing too; drawing: as setSamples() says
  bool shares = false;  ///< shares without it, too
  bool whole = true;    ///< of drawing: also what there is to be explained
  std::uint64_t sampleEvery = 16;
  std::uint64_t from = 4;  ///< frames before it are not recorded: what is touched for the first time is slow
};

class FrameLog final : public FrameProbe {
public:
  FrameLog(std::vector<SpanReader*> readers, FrameLogOptions options = {});
  ~FrameLog() override;

  void began(Span what, std::uint64_t frame, std::uint32_t wall) override;
  void began(Span what, NodeRef node) override;
  void ended(Span what) override;
  void counted(Count what, std::uint64_t amount, NodeRef node) override;
  bool wantsShares(std::uint64_t frame, std::uint32_t wall) const override;
  void shared(Span what, std::uint64_t frame, std::uint32_t wall, std::span<const NodeRef> among) override;
  DrawSample drawSample(std::uint64_t frame, std::uint32_t wall) override;
  bool wantsAlone(std::span<const NodeRef> owners) const override;
  std::size_t nextBatch(std::uint32_t wall, std::uint32_t eye, std::size_t batches) override;
  void drewAlone(const DrawnAlone& drawn, std::span<const NodeShare> nodes) override;

  /// Whether drawing is sampled from now on. Any thread.
  void setSamples(bool on) { samples_ = on; }
  /// Who is watched from now on; null: nobody. On App's thread.
  void watch(std::shared_ptr<const NodeAccounts> accounts);

  /// Hands on what is left. After the last frame.
  void finish();
  const SpanOverhead& overhead() const { return overhead_; }
  /// Records that were lost because collecting could not keep up.
  std::uint64_t lost() const;

private:
  static constexpr std::size_t kShortVisits = 1 << 12;

  struct Alone {
    DrawnAlone drawn;
    std::vector<NodeShare> nodes;
  };
  /// Of a wall's eye.
  struct Turn {
    std::size_t next = 0;     ///< batch
    std::uint64_t round = 0;  ///< [frames]
  };

  /// When a wall's drawing is sampled.
  struct Due {
    std::uint64_t frame = 0;  ///< from this one on, in the next that is drawn
    bool some = false;        ///< its eyes have been drawn alone, in the next one some batches are
  };

  void measureOverhead();
  void measureLightOverhead();
  SpanTrack& track();
  void beginApp(SpanTrack& track, std::uint64_t frame);
  void beganInVisit(Span what, NodeRef node);
  void endedVisit();
  void tellShortVisits();
  std::uint64_t sampleEvery(std::uint32_t wall) const;
  void collect();
  void collectSafely() noexcept;

  std::vector<SpanReader*> readers_;
  FrameLogOptions options_;
  SpanOverhead overhead_;
  std::uint64_t number_;  ///< of this log, among all there were: what threads remember of one is no other's
  std::atomic<std::uint64_t> appFrame_ = kNoFrame;
  std::atomic<bool> light_ = false;  ///< App's frame is not recorded as a whole
  std::atomic<bool> crew_ = false;   ///< nodes simulate side by side, on App's thread and on others
  std::uint64_t nextWhole_ = 0;      ///< App's own
  bool called_ = false;              ///< App's own: it is known whom the frame visits
  std::uint64_t dearTicks_ = 0;      ///< kDear
  std::uint64_t lightTicks_ = 0;     ///< what recording a visit takes in a light frame
  double nanosecondsATick_ = 1;
  std::vector<std::uint64_t> shortTicks_;  ///< App's own, by account: of visits that were not recorded
  RecordRing<ShortVisits> shortVisits_{kShortVisits};
  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<SpanTrack>> tracks_;
  std::vector<SharedSpan> shared_;
  std::vector<Alone> alone_;
  /// Written by App, with the lock; App itself, and who helps it, reads it without.
  std::shared_ptr<const NodeAccounts> accounts_;
  std::vector<Turn> turns_;                            ///< by wall and eye
  std::map<std::uint32_t, std::uint64_t> nextShares_;  ///< frames, by wall
  std::map<std::uint32_t, Due> nextDrawn_;             ///< by wall
  std::set<std::uint32_t> crowded_;                    ///< walls of very many nodes
  std::atomic<bool> samples_;
  std::atomic<std::uint64_t> notCollected_ = 0;  ///< times, for want of memory
  std::atomic<bool> done_ = false;
  std::thread collector_;
};

}  // namespace stadion
