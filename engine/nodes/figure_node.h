#pragma once
/// `figure`: a model with bones that plays clips.
///
/// Events    finished, when a clip that does not repeat has ended; looped, at the end of each pass of one that
///           repeats. Both at the exact time.
/// Commands  play [CLIP [fade SECONDS] [speed FACTOR] [from SECONDS] [once|loop]], pause, stop, pose CLIP SECONDS,
///           reset, and those of a placed node.
/// Times     nodes that watch a bone get its motion inside the frame as curves between the clips' keys, of 2 ms
///           at most (pose_track.h).
/// It is not visited while nothing moves it.

#include "engine/figure/clip_player.h"
#include "engine/figure/figure_pose.h"
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

class FigureNode : public ObjectNode {
public:
  /// What it plays from the start; nothing: it stands at rest.
  using Beginning = std::optional<ClipPlayer::Start>;

  /// `skeleton`: that of its mesh; null: it has none, and plays nothing.
  FigureNode(NodeRef self, std::string name, PlaceAttributes place, Appearance appearance,
             std::shared_ptr<const Skeleton> skeleton, ClipPlayer::Start standard, Beginning beginning);

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
  void traceCarried(FrameContext& frame);
  FigureRecord playedAt(Nanoseconds time) const;

  struct Carried {
    NodeRef node;
    std::uint32_t bone = 0;
  };

  std::shared_ptr<const Skeleton> skeleton_;
  ClipPlayer::Start standard_;  ///< speed, loop and fade if a command does not state them
  Beginning beginning_;
  ClipPlayer player_;
  /// What it played in this frame before a command changed it.
  struct Past {
    Nanoseconds until = 0;
    ClipPlayer player;
  };
  std::vector<Past> past_;
  FigureRecords::Number number_ = 0;
  bool moves_ = false;
  std::vector<Carried> carried_;  ///< nodes that bones carry; each says so itself, also after a restart
  FigurePose pose_;               ///< placeCarried()'s and traceCarried()'s own
};

}  // namespace stadion
