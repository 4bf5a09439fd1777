#pragma once
/// Puts the spans of each frame together and judges it when it has been shown.
///
/// Threads    SpanReader's.
/// Ownership  borrows the names, which must outlive it.

#include "profiling/record/frame_facts.h"
#include "profiling/record/frame_log.h"
#include "profiling/record/node_names.h"

#include <functional>
#include <map>

namespace stadion {

class FrameJudge final : public SpanReader {
public:
  using Shown = std::function<void(const FrameFacts&)>;
  /// `rate` in frames a second: 0 = frames are not paced, none is late. `shown` gets each frame, in the order
  /// in which they were shown. `sequential`: the stages' times add up.
  FrameJudge(double rate, std::size_t walls, const NodeNames& names, Shown shown, bool sequential = false)
      : budget_(rate > 0 ? static_cast<float>(1e3 / rate) : 0), walls_(walls), names_(names),
        shown_(std::move(shown)), sequential_(sequential) {}

  using SpanReader::take;
  void take(std::size_t track, const SpanRecord& record) override;
  void take(const CountRecord& count) override;
  void take(const SharedSpan& shared) override;

private:
  /// A frame that has not been shown yet.
  struct Open {
    explicit Open(std::size_t walls)
        : facts(walls), cull(facts.cull.size()), draw(cull.size()), shadows(cull.size()) {}

    FrameFacts facts;
    ProfileClock::time_point app;  ///< when these began
    std::vector<ProfileClock::time_point> cull, draw;
    std::vector<bool> shadows;  ///< took most of the wall's Draw
  };
  /// Events in a thread since its last stage.
  struct Pending {
    StageFacts under;  ///< within the stage that is under way
    float tick = 0, slot = 0;
    float rest = 0;     ///< Draw, which had begun, waited for the rest of its list
    float shadows = 0;  ///< Draw: their maps
  };
  Open& frame(std::uint64_t number);
  void takePassedOver(Open& open) const;
  void takeApp(Open& open, const SpanRecord& record, const StageFacts& stage, const Pending& before);
  void place(Open& open, const SpanRecord& swap);
  std::string title(NodeRef node) const;
  NodeRef mostExpensiveCulled(std::uint32_t wall) const;
  static void takeNode(FrameFacts& facts, const SpanRecord& record);
  void show(const SpanRecord& swap, const StageFacts& stage);

  float budget_;  ///< [ms]
  std::size_t walls_;
  const NodeNames& names_;
  Shown shown_;
  bool sequential_;
  std::uint64_t sampledUntil_ = 0;  ///< frames before it include the cost of sampling
  std::map<std::uint64_t, Open> open_;
  std::map<std::size_t, Pending> pending_;    ///< by track
  ProfileClock::time_point lastApp_{};        ///< time at which the last App stage began
  std::map<std::uint32_t, NodeRef> largest_;  ///< by wall: the known node with the most to draw
  struct Culled {
    double ms = 0;
    NodeRef node;
  };
  std::map<std::pair<std::uint32_t, Span>, Culled> culled_;  ///< likewise, for culling: by wall and part of
                                                             ///< Cull
  ProfileClock::time_point lastShown_{};
};

}  // namespace stadion
