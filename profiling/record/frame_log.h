#pragma once
/// Records the costs of frames: a probe writes each thread's spans into a buffer of its own, without locks,
/// and a thread collects them.
///
/// The cost of recording is measured beforehand and subtracted: the figures are those of a show without a
/// probe.
///
/// Recording must cost little, so drawing and shared costs are sampled. A sample is taken every `sampleEvery`
/// frames, or in the next one that is drawn. The stages' times are exact; a node's share of Cull and Draw
/// comes from the samples.
///
/// If App visits very many nodes, most of its frames are light. In a light frame a node's visit is recorded
/// only if it took kExpensive. The other visits are known from the frames that are recorded as a whole
/// (SpanRecord). For watched nodes (NodeAccounts), short visits are added up by account and frame. Only
/// watched nodes are drawn alone, unless all costs must be explained.
///
/// Threads    the probe's functions on the threads that do the work; the readers' on one thread of the log's
///            own, and on finish()'s once that has ended.
/// Ownership  the readers must outlive it.
///
/// Size       more than 20 fields: those of the probe on each thread, and those that the collector takes over
///            from them under one mutex.

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
  std::uint64_t round = 0;  ///< the next one comes after this many frames
};

/// The unrecorded visits of one frame: their time, for all nodes on that holder's account.
struct ShortVisits {
  std::uint64_t frame = 0;
  NodeRef holder;
  double ms = 0;
};

/// Receives the records.
///
/// Threads  one at a time.
class SpanReader {
public:
  virtual ~SpanReader() = default;
  /// `track` numbers the threads from 0, in the order in which they appeared. Spans of one thread come in the
  /// order of their ends, those of different threads nearly so.
  virtual void take(std::size_t track, const SpanRecord& record) = 0;
  virtual void take(const CountRecord&) {}
  virtual void take(const ShortVisits&) {}
  virtual void take(const SharedSpan&) {}
  virtual void take(const IsolatedDrawTime&, const std::vector<NodeShare>&) {}
  /// True if the reader also takes the frames before FrameLogOptions::from.
  virtual bool takesFirstFrames() const { return false; }
  /// Called when all present records have been passed on.
  virtual void caughtUp() {}
};

/// Nodes that share a span; above this number, shares are sampled less often.
constexpr std::uint64_t kManyShares = 500;

struct FrameLogOptions {
  bool samples = true;  ///< shares and drawing too; drawing: as setSamples() says
  bool shares = false;  ///< shares even without drawing
  bool whole = true;    ///< samples of drawing also measure the totals to be explained
  std::uint64_t sampleEvery = 16;
  /// Drawing of walls with more than kManyShares nodes is sampled so much less often.
  std::uint64_t crowdedEvery = 4;
  std::uint64_t from = 4;  ///< first frame for readers of costs: first use of data is slow
};

class FrameLog final : public FrameProbe {
public:
  FrameLog(std::vector<SpanReader*> readers, FrameLogOptions options = {});
  ~FrameLog() override;

  void began(Span what, std::uint64_t frame, std::uint32_t wall) override;
  void began(Span what, NodeRef node) override;
  void ended(Span what) override;
  void counted(Count what, std::uint64_t amount, NodeRef node) override;
  bool wantsSpansOfVisits() const override { return !light_.load(std::memory_order_relaxed); }
  void visited(NodeRef node) override;
  bool wantsShares(std::uint64_t frame, std::uint32_t wall) const override;
  void shared(Span what, std::uint64_t frame, std::uint32_t wall, std::span<const NodeRef> among) override;
  DrawSample drawSample(std::uint64_t frame, std::uint32_t wall) override;
  bool wantsAlone(std::span<const NodeRef> owners) const override;
  std::size_t nextBatch(std::uint32_t wall, std::uint32_t eye, std::size_t batches) override;
  void drewAlone(const IsolatedDrawTime& drawn, std::span<const NodeShare> nodes) override;

  /// Turns sampling of drawing on or off. Any thread.
  void setSamples(bool on) { samples_ = on; }
  /// Sets the nodes to watch; null: none. On App's thread.
  void watch(std::shared_ptr<const NodeAccounts> accounts);

  /// Passes on the remaining records. Call it after the last frame.
  void finish();
  const SpanOverhead& overhead() const { return overhead_; }
  /// Returns the number of records that were lost because collecting could not keep up.
  std::uint64_t lost() const;

private:
  static constexpr std::size_t kShortVisits = 1 << 12;

  struct Alone {
    IsolatedDrawTime drawn;
    std::vector<NodeShare> nodes;
  };
  /// The sampling state of a wall's eye.
  struct Turn {
    std::size_t next = 0;     ///< batch
    std::uint64_t round = 0;  ///< [frames]
  };

  /// The next sample of a wall's drawing.
  struct Due {
    std::uint64_t frame = 0;  ///< the next drawn frame from this one on
    bool some = false;        ///< the eyes have been drawn alone; the next sample draws some batches alone
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
  template <class... What>
  void tell(std::uint64_t frame, const What&... what);
  void collectSafely() noexcept;

  std::vector<SpanReader*> readers_;
  FrameLogOptions options_;
  SpanOverhead overhead_;
  std::uint64_t number_;  ///< number of this log in the process: threads must not confuse the tracks of two
                          ///< logs
  std::atomic<std::uint64_t> appFrame_ = kNoFrame;
  std::atomic<bool> light_ = false;       ///< App's frame is not recorded as a whole
  std::atomic<bool> inParallel_ = false;  ///< nodes simulate in parallel, on App's thread and on others
  std::uint64_t nextWhole_ = 0;           ///< used by App only
  bool called_ = false;                   ///< used by App only: the nodes to visit in this frame are known
  std::uint64_t expensiveTicks_ = 0;      ///< kExpensive
  std::uint64_t lightTicks_ = 0;          ///< cost of recording a visit in a light frame
  double nanosecondsATick_ = 1;
  std::vector<std::uint64_t> shortTicks_;  ///< used by App only, by account: of visits that were not recorded
  RecordRing<ShortVisits> shortVisits_{kShortVisits};
  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<SpanTrack>> tracks_;
  std::vector<SharedSpan> shared_;
  std::vector<Alone> alone_;
  /// App writes it with the lock; App and the worker pool read it without.
  std::shared_ptr<const NodeAccounts> accounts_;
  std::vector<Turn> turns_;                            ///< by wall and eye
  std::map<std::uint32_t, std::uint64_t> nextShares_;  ///< frames, by wall
  std::map<std::uint32_t, Due> nextDrawn_;             ///< by wall
  std::set<std::uint32_t> crowded_;                    ///< walls with very many nodes
  std::atomic<bool> samples_;
  std::atomic<std::uint64_t> notCollected_ = 0;  ///< number of times, for lack of memory
  std::atomic<bool> done_ = false;
  std::thread collector_;
};

}  // namespace stadion
