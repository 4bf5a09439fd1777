#pragma once
/// Records what each stage of each wall and each node of App costs in each frame, for comparisons. It
/// measures the processor time of the thread that does the work, so waiting and interruptions do not count.
///
/// If instructions are counted, those between two calls belong to a row. Callgrind writes them under "row N",
/// where N is the index in rows(). With a counter of instructions, rows() contains them.
///
/// Threads  called on the threads that do the work; read it when the run is over.
/// Errors   none.

#include "engine/core/frame_probe.h"
#include "profiling/regression/spans/planted_delay.h"
#include "profiling/regression/spans/span_record.h"
#include "profiling/regression/spans/turns.h"

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

namespace stadion::regression {

struct SpanTimesOptions {
  std::optional<PlantedDelay> planted{};
  Turns* turns = nullptr;          ///< null: frames do not wait for turns
  bool countInstructions = false;  ///< from the third frame on; the first ones build what the others use
  /// Instructions of the calling thread so far; null: callgrind counts them.
  std::function<std::uint64_t()> instructions{};
};

class SpanTimes final : public FrameProbe {
public:
  explicit SpanTimes(SpanTimesOptions options) : options_(std::move(options)) {}

  void began(Span what, std::uint64_t frame, std::uint32_t wall) override;
  void began(Span what, NodeRef node) override;
  void ended(Span what) override;

  /// The delay that was planted in each frame [ns].
  const std::vector<std::uint64_t>& planted() const { return planted_; }

  /// The costs as rows; `nameNode` fills in path, file and line. Stages and the most expensive nodes have
  /// their single frames.
  std::vector<SpanRow> rows(const std::vector<std::string>& walls,
                            const std::function<void(NodeRef, SpanRow&)>& nameNode) const;

private:
  using Clock = std::chrono::steady_clock;
  struct Key {
    Span stage = Span::App;
    std::uint32_t wall = 0;
    NodeRef node;
    auto operator<=>(const Key&) const = default;
  };
  /// The processor time [ns] and real time of a frame.
  struct OfFrame {
    std::uint64_t frame = 0, processor = 0;
    Clock::duration elapsed{};
  };
  struct Cost {
    std::size_t row = 0;
    std::uint64_t began = 0, now = 0, total = 0;  ///< [ns]; `now`: of this frame
    Clock::time_point beganAt{};
    Clock::duration elapsed{}, elapsedTotal{};  ///< `elapsed`: of this frame
    std::vector<OfFrame> frames;
  };
  /// The current work of a thread.
  struct Open {
    Key stage;
    std::uint64_t frame = 0;
    NodeRef node;
  };

  void plantIn(std::uint64_t frame);
  bool isPlanted(const Key& stage) const;
  void stageEnded(const Open& open);
  void frameEnded(std::uint64_t frame);
  void nodeEnded(NodeRef node);
  void begin(const Key& key);
  Cost& end(const Key& key);
  void closeFrame(std::uint64_t frame);
  void boundary(const Cost* cost);

  SpanTimesOptions options_;
  std::mutex mutex_;  ///< guards the members below
  std::map<std::thread::id, Open> open_;
  std::map<Key, Cost> costs_;
  std::vector<Cost*> touched_;  ///< nodes visited in this frame
  Cost* stage_ = nullptr;       ///< under way, if one thread does all work
  bool counting_ = false;
  std::uint64_t counted_ = 0;                 ///< at the last boundary
  std::map<std::size_t, double> executed_{};  ///< by row
  std::uint64_t appFrame_ = kNoFrame, plantedFrame_ = kNoFrame;
  std::vector<std::uint64_t> planted_;
  Clock::time_point frameEndedAt_{};  ///< end of the previous frame; moved by later waiting
  std::vector<std::pair<std::uint64_t, Clock::duration>> wholeFrames_;
};

}  // namespace stadion::regression
