#pragma once
/// `text`: words in the scene, such as a score board's.
///
/// Commands  say WORDS, reset, and those of a placed node. What it says is part of the show's state.
/// A change of the words makes a new mesh. Two nodes with the same words and style share one mesh.

#include "engine/published/records.h"
#include "engine/scene/placed_node.h"
#include "engine/text/text_mesh.h"

namespace stadion {

extern const NodeType kTextType;

class TextNode : public PlacedNode {
public:
  TextNode(NodeRef self, std::string name, PlaceAttributes place, std::string words, const TextStyle& style)
      : PlacedNode(kTextType, self, std::move(name), std::move(place)), declared_(words),
        words_(std::move(words)), style_(style) {}

  const std::string& words() const { return words_; }
  void hash(StateHash& h) const override;
  void state(StateFields& f) override;
  template <class Self, class Fields>
  static void fields(Self& self, Fields& f);
  bool resume(Scene& scene) override;

protected:
  void onEnter(Scene& scene) override;
  void onLeave(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;

private:
  void say(std::string words, Scene& scene);
  void draw(Scene& scene);

  std::string declared_, words_;  ///< UTF-8, lines separated by line feeds
  TextStyle style_;
  InstanceId instance_ = 0;
  MeshId mesh_ = kNoMesh;
};

}  // namespace stadion
