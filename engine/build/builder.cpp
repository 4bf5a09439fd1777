#include "engine/build/builder.h"

#include "engine/build/clip_commands.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "engine/script/object_parts.h"
#include "engine/text/text_mesh.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

namespace stadion {
namespace {

PlaceAttributes statedPlaceOf(const Declaration& d) {
  PlaceAttributes place;
  if (!d.takes("position")) return place;
  const Vec3 turn = d.vec3("orientation") * kDegree;
  const Vec3 scale = d.takes("scale") ? d.vec3("scale") : Vec3::Ones();
  place.X_PN.linear() = det::fromEuler(turn.x(), turn.y(), turn.z()).toRotationMatrix() * scale.asDiagonal();
  place.X_PN.translation() = d.vec3("position");
  return place;
}

/// The words of a text. Colours have nothing but numbers.
std::vector<std::string> wordsOf(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; (at = text.find_first_not_of(" \t+", at)) != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(" \t", at), text.size());
    words.emplace_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

Paint paintOf(const Declaration& d) {
  Paint paint;
  if (d.has("tint")) paint.tint = d.vec3("tint");
  if (d.has("emit")) paint.emit = d.vec3("emit");
  if (d.has("opacity")) paint.opacity = d.number("opacity");
  return paint;
}

Notification notificationOf(const EventMessage& m, const NodeRegistry& types) {
  const ArgumentKind argument = types.command(m.commandId)->argument;
  Notification n;
  n.event = m.event;
  n.command = m.commandId;
  n.delay = m.delay + m.latency;
  n.target = std::string(m.target.name);
  if (argument == ArgumentKind::PartAndTracker)
    n.arguments = {std::string(kAttachPartNames[static_cast<std::size_t>(m.part)])};
  if (!m.field.name.empty()) n.arguments.push_back(std::string(m.field.name));
  if (argument == ArgumentKind::Words) n.arguments.push_back(unescaped(m.words));
  if (argument == ArgumentKind::Colour || argument == ArgumentKind::Share || argument == ArgumentKind::Faded)
    n.arguments = wordsOf(m.words);
  if (!m.tracker.empty()) n.arguments.push_back(std::string(m.tracker));
  return n;
}

/// Decides which objects are static, and in which order nodes enter.
class Layout {
public:
  explicit Layout(const Document& document) : document_(document) {
    const std::uint32_t size = document.size();
    parent_.assign(size, kNone);
    mentioned_.assign(size, false);
    hasChild_.assign(size, false);
    for (std::uint32_t i = 0; i < size; ++i) look(document[i]);
  }

  bool isStatic(std::uint32_t i) const {
    if (document_[i].kind() != "object" || mentioned_[i] || hasChild_[i]) return false;
    if (!paintOf(document_[i]).isNeutral()) return false;  // chunks have no paint
    for (std::uint32_t up = parent_[i]; up != kNone; up = parent_[up])
      if (mayMove(up)) return false;
    return true;
  }
  std::uint32_t parent(std::uint32_t i) const { return parent_[i]; }
  /// Levels whose parent it is, in the order of the file.
  std::vector<std::uint32_t> childrenOf(std::uint32_t node) const {
    std::vector<std::uint32_t> children;
    for (std::uint32_t i = 0; i < parent_.size(); ++i)
      if (parent_[i] == node && document_[i].is(Trait::Level)) children.push_back(i);
    return children;
  }

  /// Parents before children, otherwise as in the file.
  std::vector<std::uint32_t> enterOrder() const {
    std::vector<std::uint32_t> order, chain;
    std::vector<bool> entered(parent_.size(), false);
    for (std::uint32_t i = 0; i < parent_.size(); ++i) {
      chain.clear();
      for (std::uint32_t at = i; at != kNone && !entered[at]; at = parent_[at]) {
        chain.push_back(at);
        entered[at] = true;
      }
      order.insert(order.end(), chain.rbegin(), chain.rend());
    }
    return order;
  }

  static constexpr std::uint32_t kNone = NodeReference::kNone;

private:
  void look(const Declaration& d) {
    if (d.is(Trait::Placed))
      if (const auto p = d.reference("parent"); p && p->resolved() && p->level == 0) {
        parent_[d.index()] = p->declaration;
        hasChild_[p->declaration] = true;
      }
    // A force field is carried by what it is attached to.
    if (d.takes("attach"))
      if (const auto carrier = d.reference("attach"); carrier && carrier->resolved() && carrier->level == 0)
        parent_[d.index()] = carrier->declaration;
    for (const Attr attr : d.type().actsBy())
      for (const NodeReference& r : d.references(attr)) mention(r);
    for (const EventMessage& m : d.eventMessages()) {
      mention(m.target);
      mention(m.field);
    }
  }

  void mention(const NodeReference& r) {
    if (r.resolved() && r.level == 0) mentioned_[r.declaration] = true;
  }

  bool mayMove(std::uint32_t i) const { return mentioned_[i] || document_[i].is(Trait::Moves); }

  const Document& document_;
  std::vector<std::uint32_t> parent_;
  std::vector<bool> mentioned_, hasChild_;
};

class Builder {
public:
  Builder(const BuildInput& input, Diagnostics& findings)
      : input_(input), findings_(findings), layout_(input.document),
        resolve_([this](const NodeReference& r) { return resolve(r); }),
        model_([this](const NodeReference& r) { return modelOf(r); }) {}

  Built build() {
    built_.load = std::make_unique<LoadedScene>();
    LoadedScene& load = *built_.load;
    load.number = input_.number;
    load.file = input_.document.file();
    load.owner = input_.owner;
    load.X_WO = input_.X_WO;
    load.nodes.resize(input_.document.size());
    load.lines.reserve(input_.document.size());
    std::size_t statics = 0;
    for (std::uint32_t i = 0; i < input_.document.size(); ++i) statics += layout_.isStatic(i);
    load.statics.reserve(statics);
    built_.staticRecords.reserve(statics);
    for (const Declaration d : input_.document) {
      load.lines.push_back(d.line());
      addTerms(d);
      const std::string* name = nullptr;
      if (!d.name().empty()) name = &load.names.emplace(std::string(d.name()), d.index()).first->first;
      if (layout_.isStatic(d.index()))
        addStatic(d, name);
      else
        addNode(d);
    }
    for (const Declaration d : input_.document) {
      noteFading(d);
      checkClips(d);
    }
    for (const std::uint32_t i : layout_.enterOrder())
      if (load.nodes[i]) load.enterOrder.push_back(i);
    for (const StaticObject& s : load.statics)
      for (std::uint32_t up = layout_.parent(s.position); up != Layout::kNone; up = layout_.parent(up))
        if (auto* placed = dynamic_cast<PlacedNode*>(load.nodes[up].get())) placed->carryStatics();
    return std::move(built_);
  }

private:
  NodeRef resolve(const NodeReference& r) const {
    if (!r.resolved() || !r.inner().empty()) return {};
    if (r.level == 0) return {input_.number, r.declaration};
    if (r.level > input_.surroundings.size()) return {};
    return {input_.surroundings[r.level - 1], r.declaration};
  }

  NodeRef parentOf(const Declaration& d) const {
    if (!d.is(Trait::Placed)) return {};
    const auto p = d.reference("parent");
    return p ? resolve(*p) : NodeRef{};
  }

  Appearance appearanceOf(const Declaration& d) const {
    Appearance a;
    if (!d.is(Trait::Model) && !d.is(Trait::Figure)) return a;
    a.mesh = input_.meshes(d);
    if (input_.store.find(a.mesh)->indices.empty()) a.mesh = kNoMesh;  // all of it is in parts
    a.drawn = d.flag("draw");
    a.paint = paintOf(d);
    if (d.is(Trait::Figure)) return a;
    a.shape = std::string(d.text("shape"));
    a.tolerance = d.number("tolerance");
    return a;
  }

  /// Notes the models that the declaration makes transparent: its own, and targets of its messages in this file.
  void noteFading(const Declaration& d) {
    const auto note = [&](const Declaration& model, double opacity) {
      if (!(opacity > 0 && opacity < double{PaintRecord::kOpaque})) return;
      const MeshId mesh = appearanceOf(model).mesh;
      if (mesh != kNoMesh && std::ranges::find(built_.fading, mesh) == built_.fading.end())
        built_.fading.push_back(mesh);
    };
    if (d.has("opacity")) note(d, d.number("opacity"));
    for (const EventMessage& m : d.eventMessages()) {
      if (m.commandId != commandNamed("opacity") || !m.target.resolved() || m.target.level != 0 ||
          !m.target.inner().empty())
        continue;
      const std::vector<std::string> words = wordsOf(m.words);
      if (words.size() == 1)
        note(input_.document[m.target.declaration], std::strtod(words[0].c_str(), nullptr));
    }
  }

  /// Warns of messages that ask a figure of this file for what its clips cannot do.
  void checkClips(const Declaration& sender) {
    for (const EventMessage& m : sender.eventMessages()) {
      if (!m.target.resolved() || m.target.level != 0 || !m.target.inner().empty()) continue;
      const Declaration target = input_.document[m.target.declaration];
      const MeshId mesh = target.is(Trait::Figure) ? appearanceOf(target).mesh : kNoMesh;
      const auto skeleton = mesh == kNoMesh ? nullptr : input_.store.find(mesh)->skeleton;
      const std::string fault = skeleton ? faultOfClips(m, *skeleton) : std::string();
      if (fault.empty()) continue;
      const SourceText& source = input_.document.source();
      findings_.warning(source.position(m.command), fmt::format("\"{}\": {}", target.name(), fault),
                        source.excerpt(m.command));
    }
  }

  Nanoseconds soundLengthOf(const Declaration& d) const { return d.is(Trait::Sound) ? input_.sounds(d) : 0; }

  std::vector<NodeRef> childrenOf(const Declaration& d) const {
    std::vector<NodeRef> children;
    if (d.kind() == "lod")
      for (const std::uint32_t child : layout_.childrenOf(d.index()))
        children.push_back({input_.number, child});
    return children;
  }

  void addTerms(const Declaration& d) {
    if (!d.has("budget") && !d.has("onoverrun")) return;
    NodeTerms terms;
    terms.budget = d.optionalNumber("budget").value_or(0);
    terms.gives = d.choices<DegradationStep>("onoverrun");
    terms.priority = d.number("priority");
    built_.load->terms[d.index()] = std::move(terms);
  }

  /// Where a part is in its model; everything else is where its declaration puts it.
  Affine placeInModel(const Declaration& d) const {
    return partOf(d).empty() ? Affine::Identity() : input_.store.find(input_.meshes(d))->place;
  }

  PlaceAttributes placeOf(const Declaration& d) const {
    PlaceAttributes place = statedPlaceOf(d);
    if (partOf(d).empty()) return place;
    place.X_PN = place.X_PN * placeInModel(d);
    // A part of a part: "hall/roof/lamp" below "hall/roof".
    const std::uint32_t up = layout_.parent(d.index());
    if (up != Layout::kNone && isPartByUse(d) && isPartByUse(input_.document[up]))
      place.X_PN = placeInModel(input_.document[up]).inverse(Eigen::Isometry) * place.X_PN;
    return place;
  }

  Affine worldPlaceOf(const Declaration& d) const {
    Affine X = placeOf(d).X_PN;
    for (std::uint32_t up = layout_.parent(d.index()); up != Layout::kNone; up = layout_.parent(up))
      X = placeOf(input_.document[up]).X_PN * X;
    return input_.X_WO * X;
  }

  std::optional<PlacedModel> modelOf(const NodeReference& r) const {
    if (!r.resolved() || !r.inner().empty() || r.level != 0) return std::nullopt;
    const Declaration d = input_.document[r.declaration];
    const Appearance a = appearanceOf(d);
    if (a.mesh == kNoMesh) return std::nullopt;
    return PlacedModel{input_.store.find(a.mesh), a, worldPlaceOf(d)};
  }

  void addStatic(const Declaration& d, const std::string* name) {
    const Affine X = worldPlaceOf(d);
    const Appearance a = appearanceOf(d);
    built_.load->staticType = &d.type().type();
    built_.load->statics.push_back({d.index(), parentOf(d)});
    if (name) built_.load->staticNames.emplace_back(d.index(), name);
    built_.staticRecords.push_back(
        makeInstance(X, *input_.store.find(a.mesh), a.mesh, a.drawn, {input_.number, d.index()}));
  }

  void addNode(const Declaration& d) {
    PlaceAttributes place = placeOf(d);
    place.parent = parentOf(d);
    const Appearance a = appearanceOf(d);
    const NodeRequest request{d,
                              {input_.number, d.index()},
                              std::string(d.name()),
                              place,
                              a,
                              a.mesh == kNoMesh ? nullptr : input_.store.find(a.mesh),
                              resolve_,
                              model_,
                              findings_,
                              input_.services,
                              soundLengthOf(d),
                              d.is(Trait::Surroundings) && d.has("file") ? input_.meshes(d) : kNoMesh,
                              childrenOf(d)};
    std::unique_ptr<Node> node = request.type().make(request);
    if (!node) return;
    for (const EventMessage& m : d.eventMessages())
      node->addNotification(notificationOf(m, input_.document.types()));
    built_.load->nodes[d.index()] = std::move(node);
  }

  const BuildInput& input_;
  Diagnostics& findings_;
  Layout layout_;
  std::function<NodeRef(const NodeReference&)> resolve_;
  std::function<std::optional<PlacedModel>(const NodeReference&)> model_;
  Built built_;
};

}  // namespace

Built buildLoad(const BuildInput& input, Diagnostics& findings) {
  return Builder(input, findings).build();
}

}  // namespace stadion
