#pragma once
/// `sound`: something that is heard, from a place or from everywhere.
///
/// The show knows since when it plays and how long the file is; whether a device makes it heard changes
/// nothing in the show.
///
/// Events    finished, at the file's exact length after its start; a looping sound tells it at the end of
///           each pass.
/// Commands  enable (plays from the start, also if it plays already), disable, toggle, reset, and those of a
///           placed node. One that is hidden still plays.
/// It is not visited while it plays.

#include "engine/nodes/switch_state.h"
#include "engine/scene/placed_node.h"

namespace stadion {

extern const NodeType kSoundType;

class SoundNode : public PlacedNode {
public:
  struct Attributes {
    std::string file;        ///< below the asset roots
    Nanoseconds length = 0;  ///< length of the file
    double gain = 1, range = 0;
    bool loop = false;
  };

  SoundNode(NodeRef self, std::string name, PlaceAttributes place, Attributes a, bool on);

  void hash(StateHash& h) const override;
  void state(StateFields& f) override;
  template <class Self, class Fields>
  static void fields(Self& self, Fields& f);
  bool resume(Scene& scene) override;

protected:
  void onEnter(Scene& scene) override;
  void onLeave(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;
  void simulate(FrameContext& frame) override;

private:
  static constexpr Nanoseconds kShortestPass = 1'000'000;  ///< shortest pass of a loop [ns]

  void startAt(Nanoseconds when, Scene& scene);
  /// Lets the passes that end up to `time` count.
  void endPasses(Nanoseconds time);
  void publish(Scene& scene);
  void setSource(Scene& scene) const;

  Attributes attributes_;
  SwitchState switch_;
  Nanoseconds since_ = 0;  ///< start time
  Nanoseconds due_ = 0;    ///< when its present pass ends
  std::size_t handle_ = 0;
  bool heard_ = false;  ///< the sound was heard in the last published frame
};

}  // namespace stadion
