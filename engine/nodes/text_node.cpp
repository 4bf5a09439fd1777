#include "engine/nodes/text_node.h"

#include "engine/build/lint.h"
#include "engine/build/node_request.h"
#include "engine/core/node_registry.h"
#include "engine/core/shared_rows.h"
#include "engine/scene/scene.h"

#include <utility>

namespace stadion {

void TextNode::onEnter(Scene& scene) {
  PlacedNode::onEnter(scene);
  instance_ = scene.instances().add(placement(), kNoMesh, true, self());
  draw(scene);
}

void TextNode::onLeave(Scene& scene) {
  scene.instances().remove(instance_);
  scene.instances().releaseMesh(std::exchange(mesh_, kNoMesh));
  PlacedNode::onLeave(scene);
}

void TextNode::receive(const Message& m, FrameContext& frame) {
  PlacedNode::receive(m, frame);
  if (m.command == CommandId::Say) say(m.arguments.empty() ? "" : m.arguments[0], frame.scene);
  if (m.command == CommandId::Reset) say(declared_, frame.scene);
}

void TextNode::say(std::string words, Scene& scene) {
  if (words == words_) return;
  words_ = std::move(words);
  draw(scene);
}

bool TextNode::resume(Scene& scene) {
  if (!scene.instances().owns(instance_, self())) return false;
  draw(scene);
  return true;
}

void TextNode::draw(Scene& scene) {
  auto mesh = textMesh(words_, style_);
  const MeshId before = std::exchange(mesh_, mesh ? scene.instances().addMesh(std::move(mesh)) : kNoMesh);
  scene.instances().setMesh(instance_, mesh_);
  scene.instances().releaseMesh(before);
}

template <class Self, class Fields>
void TextNode::fields(Self& self, Fields& f) {
  PlacedNode::fields(self, f);
  f("words", self.words_);
  f.unhashed("instance", self.instance_);
}

void TextNode::hash(StateHash& h) const {
  hashFields(*this, h);
}

void TextNode::state(StateFields& f) {
  fields(*this, f);
}

namespace {

std::unique_ptr<Node> makeText(const NodeRequest& r) {
  const Declaration& d = r.declaration;
  TextStyle style;
  style.size = d.number("size");
  style.depth = d.number("depth");
  setColour(d.vec3("colour"), style.colour);
  if (d.has("background")) setColour(d.vec3("background"), style.background.emplace());
  style.align = d.choice<TextAlign>("align");
  style.lit = d.flag("lit");
  return std::make_unique<TextNode>(r.self, r.name, r.place, unescaped(d.text("text")), style);
}

void lintText(const Declaration& node, LintScope& scope) {
  scope.warnOfMissing(node.text("text"), node.offset("text"));
}

constexpr std::string_view kAligns[] = {"left", "centre", "right"};
constexpr AttributeSpec kTextRows[] = {
    {.name = "text", .kind = ValueKind::Words, .help = "what it says at the start"},
    {.name = "size",
     .kind = ValueKind::Number,
     .help = "height of a capital",
     .standard = "0.5",
     .unit = "m",
     .range = {0, 1000, true}},
    {.name = "colour",
     .kind = ValueKind::Colour,
     .help = "red, green, blue (sRGB)",
     .standard = "1, 1, 1",
     .range = kColourRange},
    {.name = "lit",
     .kind = ValueKind::Flag,
     .help = "whether light falls on it as on any surface; if not, it shows its colour in any light",
     .standard = "off"},
    {.name = "align",
     .kind = ValueKind::Choice,
     .help = "what of each line is at the node's place: its beginning, its middle or its end",
     .standard = "centre",
     .choices = kAligns},
    {.name = "depth",
     .kind = ValueKind::Number,
     .help = "how thick the letters are; 0 is flat",
     .standard = "0",
     .unit = "m",
     .range = {0, 1000}},
    {.name = "background",
     .kind = ValueKind::Colour,
     .help = "colour of a board behind the letters (sRGB); no board if not stated",
     .range = kColourRange},
};

constexpr CommandSpec kTextCommands[] = {
    {"say", ArgumentKind::Words, "say [WORDS]", "shows these words; \\n ends a line, \\, is a comma"}};

}  // namespace

constinit const NodeType kTextType{
    .name = "text",
    .help = "words in the scene, for a reader who looks along +Y",
    .attributes = kTextRows,
    .commands = kTextCommands,
    .traits = {Trait::Placed, Trait::Level},
    .make = makeText,
    .lint = lintText,
};

namespace node_types {

void addTextNode(NodeRegistrar& types) {
  types.add(kTextType);
}

}  // namespace node_types

}  // namespace stadion
