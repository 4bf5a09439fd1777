/// A plugin with one node type: `spring` follows another node as if a spring pulled it there.
///
///     spring( name=tail, target=head, frequency=1.5 )
///     object( file=tail.obj, parent=tail )
///
/// The spring is critically damped and solved exactly over each frame, so that it does not depend on the
/// frame rate while its target stands still.

#include <stadion/engine/build/lint.h>
#include <stadion/engine/build/plugin.h>
#include <stadion/engine/core/shared_rows.h>
#include <stadion/engine/maths/functions.h>
#include <stadion/engine/nodes/switch_state.h>

namespace {

using namespace stadion;

extern const NodeType kSpringType;

class SpringNode : public PlacedNode {
public:
  SpringNode(NodeRef self, std::string name, PlaceAttributes place, NodeRef target, double frequency, bool on)
      : PlacedNode(kSpringType, self, std::move(name), std::move(place)), target_(target),
        rate_(2 * 3.14159265358979323846 * frequency), switch_(on) {}

  /// After what moves by itself (Rank::Motion). Without it, a PlacedNode has Rank::Attachment, and the spring
  /// would see where its target was a frame ago.
  Rank rank() const override { return Rank::Sensing; }
  bool busy() const override { return switch_.on() || PlacedNode::busy(); }
  void hash(StateHash& h) const override { hashFields(*this, h); }
  void state(StateFields& f) override { fields(*this, f); }
  template <class Self, class Fields>
  static void fields(Self& self, Fields& f) {
    PlacedNode::fields(self, f);
    f("switch", self.switch_), f("velocity", self.velocity_);
  }

protected:
  void receive(const Message& m, FrameContext& frame) override {
    PlacedNode::receive(m, frame);
    if (m.command == commandNamed("kick")) velocity_.z() += 2;
    if (switch_.apply(m) && m.command == CommandId::Reset) velocity_.setZero();
  }

  void simulate(FrameContext& frame) override {
    PlacedNode::simulate(frame);
    Node* node = frame.scene.find(target_);
    const PlacedNode* target = node ? node->placed() : nullptr;
    if (!switch_.on() || target == nullptr || frame.rested) return;
    const double t = toSeconds(frame.now.step), decay = det::exp(-rate_ * t);
    Affine X_WN = frame.scene.placements().world(placement());
    const Vec3 goal = frame.scene.placements().world(target->placement()).translation();
    const Vec3 offset = X_WN.translation() - goal, push = velocity_ + rate_ * offset;
    X_WN.translation() = goal + decay * (offset + t * push);
    velocity_ = decay * (velocity_ - rate_ * t * push);
    place(frame.scene, X_WN);
  }

private:
  NodeRef target_;
  double rate_;  ///< [rad/s]
  SwitchState switch_;
  Vec3 velocity_ = Vec3::Zero();  ///< in World [m/s]
};

std::unique_ptr<Node> makeSpring(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  return std::make_unique<SpringNode>(r.self, r.name, r.place, r.resolve(*d.reference("target")),
                                      d.number("frequency"), d.flag("initstate"));
}

void lintSpring(const Declaration& d, LintScope& scope) {
  if (d.reference("target")->name == d.name())
    scope.warn(d, "target", "this spring pulls itself and never moves");
  scope.warnNeverOn(d);
}

constexpr AttributeSpec kAttributes[] = {
    {.name = "target",
     .kind = ValueKind::Reference,
     .help = "the node that it follows",
     .required = true,
     .targets = kPlacedOrRig,
     .acts = true},
    {.name = "frequency",
     .kind = ValueKind::Number,
     .help = "how fast it follows",
     .standard = "1",
     .unit = "Hz",
     .range = {0.01, 100}},
    kInitStateRow,
};

constexpr CommandSpec kCommands[] = {{"kick", ArgumentKind::None, "kick", "pushes it upwards with 2 m/s"}};

constinit const NodeType kSpringType{
    .name = "spring",
    .help = "follows another node as if a spring pulled it there",
    .attributes = kAttributes,
    .commands = kCommands,
    .traits = {Trait::Placed, Trait::Switched, Trait::Parent, Trait::Level, Trait::Moves},
    .make = makeSpring,
    .lint = lintSpring,
};

}  // namespace

extern "C" const Plugin* stadion_plugin() {
  static const Plugin kPlugin{
      .name = "spring", .version = "1.0", .addTo = [](NodeRegistrar& types) { types.add(kSpringType); }};
  return &kPlugin;
}
