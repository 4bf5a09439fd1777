#pragma once
/// `figure`: a model with bones that plays clips.
///
/// Events    finished, when a clip that does not repeat has ended; looped, at the end of each pass of one that
///           repeats; marker NAME, when a clip passes a marker. All at the exact time. A clip posts them until
///           another replaces it: from the beginning of a cross-fade on, the new one does. Layers post markers alone.
/// Commands  play [CLIP [fade SECONDS] [speed FACTOR] [from SECONDS] [once|loop]], layer CLIP with the same
///           options and [weight SHARE], unlayer [CLIP] [fade SECONDS], pause, stop, pose CLIP SECONDS, reset, and
///           those of a placed node.
/// Root      with a root bone, clips move the node along the ground (root_motion.h), except while a tracker moves
///           it. A reset brings it back.
/// Times     nodes that watch a bone get its motion inside the frame as curves between the clips' keys, of 2 ms
///           at most (pose_track.h).
/// It is not visited while nothing moves it.

#include "engine/figure/clip_markers.h"
#include "engine/figure/clip_player.h"
#include "engine/figure/figure_pose.h"
#include "engine/figure/root_motion.h"
#include "engine/figure/skeleton.h"
#include "engine/scene/figure_records.h"
#include "engine/scene/object_node.h"
#include "engine/scene/scene.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

extern const NodeType kFigureType;

/// What only some figures have.
struct FigureExtras {
  ClipMarkers markers{};
  std::vector<Event> markerEvents{};     ///< by marker
  std::optional<std::uint32_t> root{};   ///< bone that moves the node
  Sphere rootReach{}, rootAddedReach{};  ///< likewise, as the skeleton's reaches
};

class FigureNode : public ObjectNode {
public:
  /// What it plays from the start; nothing: it stands at rest.
  using Beginning = std::optional<ClipPlayer::Start>;

  /// `skeleton`: that of its mesh; null: it has none, and plays nothing.
  FigureNode(NodeRef self, std::string name, PlaceAttributes place, Appearance appearance,
             std::shared_ptr<const Skeleton> skeleton, ClipPlayer::Start standard, Beginning beginning,
             FigureExtras extras = {});

  /// From now on the node goes with a bone. Its place in the bone's coordinates is its home (attributes()).
  void carry(NodeRef node, std::uint32_t bone);
  void letGo(NodeRef node);
  /// Puts the nodes that bones carry where these are now.
  void placeCarried(Scene& scene) { placeCarried(scene.now(), scene); }

  Rank rank() const override { return Rank::Motion; }
  bool busy() const override { return ObjectNode::busy() || moves_; }
  void hash(StateHash& h) const override;
  void state(StateFields& f) override;
  template <class Self, class Fields>
  static void fields(Self& whole, Fields& f);
  bool resume(Scene& scene) override;

protected:
  void onEnter(Scene& scene) override;
  void onLeave(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;
  void simulate(FrameContext& frame) override;

private:
  void begin(Nanoseconds when);
  void play(std::string_view words, Nanoseconds when, Scene& scene);
  void pose(std::string_view words, Nanoseconds when, Scene& scene);
  void endClips(Nanoseconds time);
  void show(Nanoseconds time, Scene& scene);
  PlacedNode* carriedNode(NodeRef node, Scene& scene) const;
  void placeCarried(Nanoseconds time, Scene& scene);
  void layer(const Message& m, Nanoseconds when, Scene& scene);
  void change(const Message& m, Nanoseconds when, Scene& scene);
  void settleRoot(Nanoseconds when);
  void takeRootFrom(Nanoseconds when, Scene& scene);
  bool movesByRoot() const { return path_ && !isMovedFromOutside(); }
  void placeByRoot(Nanoseconds time, Scene& scene);
  void fitReach(bool added, Scene& scene);

  struct Carried {
    NodeRef node;
    std::uint32_t bone = 0;
  };
  /// What it plays, and where its root bone has moved it.
  struct Playing {
    ClipPlayer player;
    RootMotion root;
  };
  /// A node whose motion within the frame is reported: its bone; nothing: the figure itself.
  struct Watched {
    PlacedNode* node = nullptr;
    std::optional<std::uint32_t> bone;
  };
  std::vector<Watched> watchedNodes(Scene& scene);
  std::vector<Nanoseconds> turnsWithin(Nanoseconds from, Nanoseconds to) const;
  std::vector<Pose> posesAt(Nanoseconds time, const std::vector<Watched>& watched, Scene& scene);
  std::vector<Pose> posesAt(const QuarterTime& quarter, const std::vector<Watched>& watched, Scene& scene);
  void traceCarried(FrameContext& frame);
  const Playing& playingAt(Nanoseconds time) const;
  FigureRecord recordOf(const ClipPlayer& player, Nanoseconds time) const;
  Affine localAt(const Playing& playing, Nanoseconds time) const;

  std::shared_ptr<const Skeleton> skeleton_;
  ClipPlayer::Start standard_;  ///< speed, loop and fade if a command does not state them
  Beginning beginning_;
  FigureExtras extras_;
  std::optional<RootPath> path_;  ///< of the root bone
  Playing now_;
  /// What it played in this frame before a command changed it.
  struct Past {
    Nanoseconds until = 0;
    Playing playing;
  };
  std::vector<Past> past_;
  Nanoseconds ownSince_ = 0;  ///< when the root bone began to move it: a tracker did before
  FigureRecords::Number number_ = 0;
  bool moves_ = false;
  bool hasAddedReach_ = false;    ///< its instance has the sphere for added layers
  std::vector<Carried> carried_;  ///< nodes that bones carry; each says so itself, also after a restart
  FigurePose pose_;               ///< placeCarried()'s and traceCarried()'s own
};

}  // namespace stadion
