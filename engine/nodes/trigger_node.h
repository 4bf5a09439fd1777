#pragma once
/// A region that notices visitors: `usertrigger` watches the head, `wandtrigger` the wand and its buttons.
///
/// Events    enter, exit; wandtrigger also button1..button4, pressed inside, and button1up..button4up, when
///           a button is let go after its reported press, inside or not. A visitor who is inside when the
///           trigger first looks (or is enabled) enters it then. Each event carries the exact time of the
///           crossing, also of one that is entered and left within a frame; a button that of its press or
///           release. Between the corners of its way (frames, records of a log) the visitor moves straight; a
///           device that was lost and found has jumped and crosses nothing in between. One that is lost lets
///           go of its buttons. A trigger that is disabled tells nothing more of the buttons that are down.
/// Frames    the region is in the node's own coordinates and moves with its parent.
/// Commands  enable, disable, toggle, reset, and those of a placed node.

#include "engine/input/input_sample.h"
#include "engine/nodes/switch_state.h"
#include "engine/scene/placed_node.h"

namespace stadion {

/// A sphere, or a box with its edges along the axes.
struct Region {
  enum class Form : std::uint8_t { Sphere, Box } form = Form::Sphere;
  Vec3 centre = Vec3::Zero();    ///< [m]
  double radius = 1;             ///< [m]
  Vec3 halfSize = Vec3::Ones();  ///< [m]

  bool contains(const Vec3& p) const;
  /// Which part of the line a + s (b - a) is inside, s from `in` to `out`; nothing if it misses or only
  /// touches the region, or a is b.
  struct Chord {
    double in, out;
  };
  std::optional<Chord> chord(const Vec3& a, const Vec3& b) const;
  /// The first s in [0, 1] at which a + s (b - a) crosses the boundary; expects that exactly one end is
  /// inside.
  double crossing(const Vec3& a, const Vec3& b) const;
};

extern const NodeType kUserTriggerType;

extern const NodeType kWandTriggerType;

class TriggerNode : public PlacedNode {
public:
  TriggerNode(const NodeType& type, NodeRef self, std::string name, PlaceAttributes place,
              const Region& region, std::string tracker, bool on)
      : PlacedNode(type, self, std::move(name), std::move(place)), region_(region),
        tracker_(std::move(tracker)), switch_(on) {}

  Rank rank() const override { return Rank::Sensing; }
  bool busy() const override { return switch_.on() || PlacedNode::busy(); }
  void hash(StateHash& h) const override;
  void state(StateFields& f) override;
  template <class Self, class Fields>
  static void fields(Self& self, Fields& f);

protected:
  void onEnter(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;
  void simulate(FrameContext& frame) override;

private:
  /// Returns where the visitor was since the last look and is at the frame's end, in the rig; empty without
  /// a visitor.
  const PoseTrack& wayInRig(const FrameContext& frame);
  /// Follows the visitor up to `until`, which lies in this frame.
  void followVisitor(FrameContext& frame, Nanoseconds until);
  const std::vector<Nanoseconds>& stopsOf(const PoseTrack& way, const TrackerSample* t, Nanoseconds start,
                                          Nanoseconds until);
  Vec3 inNode(const Vec3& p_R, Nanoseconds time, const Affine& X_NR, const FrameContext& frame) const;
  /// The first look: it counts as entering if the visitor is inside.
  void beginLooking(const Vec3& p_N, Nanoseconds time, const TrackerSample* t, const FrameContext& frame);
  void goTo(const Vec3& p, bool jumped, Nanoseconds time);
  /// The buttons that were down when it began to look.
  std::uint32_t heldBefore(const TrackerSample& t, Nanoseconds time, const FrameContext& frame) const;
  void watchButtons(const TrackerSample& t, Nanoseconds time, bool atEnd);
  /// A device that is lost goes nowhere and presses nothing, but what it held down is let go.
  void watchLost(const TrackerSample& t, const FrameContext& frame, Nanoseconds until);
  void raiseReleases(std::uint32_t down, Nanoseconds time);

  Region region_;
  std::string tracker_;  ///< "head" for a usertrigger
  SwitchState switch_;
  bool inside_ = false;
  bool looked_ = false;       ///< the members below are valid
  Nanoseconds seen_ = 0;      ///< show time of the last look; while not looked_, from when on to look [ns]
  Vec3 last_ = Vec3::Zero();  ///< visitor in the node's coordinates
  Vec3 p_RV_ = Vec3::Zero();  ///< visitor in the rig
  Affine X_NR_ = Affine::Identity();  ///< rig to node at the end of the frame before
  std::uint32_t buttons_ = 0;
  std::uint32_t pressed_ = 0;       ///< buttons of `buttons_` whose press was reported
  PoseTrack way_;                   ///< wayInRig()'s answer
  std::vector<Nanoseconds> stops_;  ///< stopsOf()'s answer
};

}  // namespace stadion
