#pragma once
/// `dynobject`: an object that a dynamics node moves, or the visitor's hand while it is grabbed.
///
/// The node is passive. Its dynamics node takes the requests of this frame, carries them out at their exact
/// times, and moves the node by direct calls.
///
/// Events    onquarantine: its state would have become infinite or undefined; it stands still.
/// Commands  hook FIELD, unhook FIELD, grab [tracker], release, and those of a placed node (reset brings it
///           back to its place, with the velocity that its script gives it).

#include "dynamics/motion/arc_track.h"
#include "dynamics/nodes/shape_store.h"
#include "dynamics/world/world.h"

#include <optional>

namespace stadion {

/// The source of the velocity at a throw; the attribute `throw`.
enum class ThrowSource : std::uint8_t { Hand, Field, Both };

struct BodyAttributes {
  double density = 1000;       ///< [kg/m3]
  std::optional<double> mass;  ///< instead of the density [kg]
  /// Instead of the shape's filled with even matter: the centre of mass in the model's coordinates [m], and
  /// the moments about the longest, the middle and the shortest principal axis through it [kg m2].
  std::optional<Vec3> centre, inertia;
  Surface surface;
  double damping = 0;              ///< [1/s]
  std::optional<double> dragArea;  ///< instead of the shape's [m2]
  std::vector<std::string> hooks;  ///< names of force fields, as seen from its file
  Vec3 velocity = Vec3::Zero();    ///< at the start and after reset, in its parent [m/s]
  /// Angular velocity at the start and after reset, in its parent [rad/s].
  Vec3 angularVelocity = Vec3::Zero();
  ThrowSource throwSource = ThrowSource::Both;
  std::shared_ptr<const BodyFlight> flight;  ///< null: as a point
  double spin = 0;               ///< about its axis of symmetry, added when a hand lets go [rad/s]
  std::optional<Vec3> nose;      ///< the way its tip points, in the model, unit
  std::optional<double> sticks;  ///< up to this angle from straight on [rad]
  double tipDepth = 0;           ///< how far the tip goes in [m]
  bool simulated = true;         ///< false: no dynamics node takes it in, to see what a show costs without

  /// Returns the mass properties of a closed shape. A stated centre grows with the model's scale; mass and
  /// moments do not.
  MassProperties massOf(const FittedShape& fit) const;
};

extern const NodeType kDynObjectType;

class DynObjectNode : public ObjectNode {
public:
  /// Something asked of it, for an exact time.
  struct Request {
    enum class Kind : std::uint8_t { Hook, Unhook, Grab, Release, Reset };
    friend constexpr Kind lastOf(Kind) { return Kind::Reset; }
    Nanoseconds when = 0;
    Kind kind = Kind::Reset;
    NodeRef field;        ///< Hook, Unhook
    std::string tracker;  ///< Grab

    template <class Self, class Fields>
    static void fields(Self& r, Fields& f) {
      f("when", r.when), f("kind", r.kind), f("field", r.field), f("tracker", r.tracker);
    }
  };

  DynObjectNode(NodeRef self, std::string name, PlaceAttributes place, Appearance appearance,
                BodyAttributes body, SharedFit fit)
      : ObjectNode(kDynObjectType, self, std::move(name), std::move(place), std::move(appearance)),
        body_(std::move(body)), fit_(std::move(fit)) {}

  /// How its model collides at the scale that its script gives it; never null, closed.
  const SharedFit& fit() const { return fit_; }

  const BodyAttributes& body() const { return body_; }
  const std::vector<NodeRef>& hooked() const { return hooked_; }
  /// Returns the requests since the last call, in delivery order. The dynamics node calls this.
  std::vector<Request> takeRequests();
  /// The dynamics node that moves it, as which body, and where to say that something has been asked of it.
  struct Simulation {
    NodeRef dynamics;
    BodyId body = 0;
    std::vector<NodeRef>* asking = nullptr;
  };
  void setSimulation(const Simulation& simulation) { simulation_ = simulation; }
  BodyId bodyId() const { return simulation_.body; }
  NodeRef movedBy() const { return simulation_.dynamics; }  ///< invalid while no node simulates it
  /// Sets a copy of the simulated state, after each change. The state hash and snapshots ask this node, and a
  /// node that is no longer simulated keeps the copy.
  void setState(const BodyState& state) { state_ = state; }
  const BodyState& state() const { return state_; }

  /// Sets the path of the body in a frame; the dynamics node calls this for nodes that look at the body.
  /// arcsIn() returns null if the body has not moved, or if no node looked at it before.
  void setArcs(std::uint64_t frame, const ArcTrack& arcs) {
    arcs_ = arcs;
    arcsFrame_ = frame;
  }
  const ArcTrack* arcsIn(std::uint64_t frame) const {
    return frame == arcsFrame_ && !arcs_.empty() ? &arcs_ : nullptr;
  }

  bool isMovedFromOutside() const override {
    return simulation_.asking != nullptr || ObjectNode::isMovedFromOutside();
  }
  void hash(StateHash& h) const override;
  void state(StateFields& f) override;
  template <class Self, class Fields>
  static void fields(Self& self, Fields& f);

protected:
  void onEnter(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;

private:
  void ask(Request request);
  void restoreHooks(Nanoseconds when, Scene& scene);

  BodyAttributes body_;
  SharedFit fit_;
  std::vector<NodeRef> hooked_;
  std::vector<Request> requests_;
  Simulation simulation_;
  BodyState state_;
  ArcTrack arcs_;
  std::uint64_t arcsFrame_ = ~std::uint64_t{0};
};

}  // namespace stadion
