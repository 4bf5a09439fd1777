#pragma once
/// `measure`: the distance of a throw, taken where and when the body first touches something.
///
/// Every throw has a result. A throw that touches nothing ends as a foul: when its body comes to rest or is
/// quarantined, or after the node's duration. The node is not visited meanwhile; the simulation wakes it.
///
/// Events    measured (with its figure), foul; won, lost or drawn against another measure, once both have a
///           result. They carry the exact time of the touch.
/// Commands  start: from now on the body's next impact counts; reset: forgets the result; those of a placed
///           node.
/// Frames    the node's X axis is the line of the throw, +Y goes downfield. Its scale does not count.
/// Units     metres; results are compared and reported in whole centimetres, rounded down, as in athletics.

#include "engine/core/measure_from.h"
#include "engine/scene/impact.h"
#include "engine/scene/placed_node.h"

#include <optional>

namespace stadion {

struct ThrowMeasureAttributes {
  std::string body;     ///< body whose throws are measured, as seen from its file
  std::string ground;   ///< only what touches this counts; empty = anything
  std::string text;     ///< the text node that shows the result; empty = none
  std::string against;  ///< the measure to compare with; empty = none
  std::string label;    ///< name of the result in texts
  MeasureFrom from = MeasureFrom::Line;
  Nanoseconds duration = 60'000'000'000;  ///< a throw without an impact by then is a foul
  double cosHalfSector = -1;              ///< a throw outside the sector about +Y is a foul; -1 = no sector
};

struct MeasureResult {
  double metres = 0;
  bool foul = false;
  Nanoseconds when = 0;
  /// Returns the value for comparisons: a foul is less than any distance.
  int centimetres() const;

  template <class Self, class Fields>
  static void fields(Self& self, Fields& f) {
    f("metres", self.metres), f("foul", self.foul), f("when", self.when);
  }
};

extern const NodeType kMeasureType;

class ThrowMeasureNode : public PlacedNode {
public:
  using Result = MeasureResult;

  ThrowMeasureNode(NodeRef self, std::string name, PlaceAttributes place, ThrowMeasureAttributes attributes)
      : PlacedNode(kMeasureType, self, std::move(name), std::move(place)),
        attributes_(std::move(attributes)) {}

  const std::optional<Result>& result() const { return result_; }

  Rank rank() const override { return Rank::Outcome; }
  bool busy() const override { return (result_ && !compared_) || PlacedNode::busy(); }
  void hash(StateHash& h) const override;
  void state(StateFields& f) override;
  template <class Self, class Fields>
  static void fields(Self& self, Fields& f);
  /// Measures take their results side by side, and compare them afterwards.
  bool awaits(const Node& earlier, const Scene&) const override { return earlier.kind() != "measure"; }

protected:
  void onLeave(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;
  void simulate(FrameContext& frame) override;
  void afterSimulation(FrameContext& frame) override;

private:
  void start(Nanoseconds when, Scene& scene);
  void stop(Scene& scene);
  std::optional<Result> ended(const Scene& scene, Nanoseconds now) const;
  Result resultOf(const Impact& impact, const Scene& scene) const;
  void compare(const ThrowMeasureNode& other, FrameContext& frame);
  std::string told() const;
  std::string called() const;
  void write(const std::string& words, Nanoseconds when, Scene& scene) const;

  ThrowMeasureAttributes attributes_;
  NodeRef body_;             ///< while it waits for its impact
  Nanoseconds started_ = 0;  ///< impacts before that do not count
  std::optional<Result> result_;
  bool written_ = false;   ///< the result has been shown
  bool compared_ = false;  ///< the result has been compared, or there is nothing to compare it with
};

}  // namespace stadion
