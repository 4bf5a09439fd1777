#include "engine/build/lint.h"

#include "engine/scene/records.h"
#include "engine/script/file_path.h"
#include "engine/script/reporter.h"
#include "engine/script/suggestion.h"
#include "engine/text/glyphs.h"
#include "engine/text/text_mesh.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stadion {

namespace {

constexpr std::string_view kSoundEndings[] = {"wav", "aiff", "aif", "flac", "ogg"};
constexpr std::string_view kModelEndings[] = {"obj", "3ds", "gltf", "glb", "dae", "stl"};

/// What other nodes of the file do to each node.
struct Use {
  bool hooked = false;      // by an attribute or a message
  bool simulated = false;   // collidee of a dynamics node
  bool switchedOn = false;  // target of enable or toggle
  bool isParent = false;
  std::size_t levels = 0;  // children that an lod node chooses from
};

class Linter {
public:
  Linter(const Document& document, bool alone, Reporter& report)
      : document_(document), alone_(alone), report_(report), uses_(document.size()) {}

  void run() {
    for (const Declaration node : document_) noteUses(node);
    for (const Declaration node : document_) look(node);
    lookAtNumberOfLights();
  }

private:
  Use* useOf(const NodeReference& reference) {
    const bool here = reference.resolved() && reference.level == 0 && reference.inner().empty();
    return here ? &uses_[reference.declaration] : nullptr;
  }

  void noteUses(const Declaration& node) {
    for (const NodeReference& field : referencesIf(node, Attr::Hook))
      if (Use* use = useOf(field)) use->hooked = true;
    if (node.kind() == NodeKind::Dynamics)
      for (const NodeReference& body : node.references(Attr::Collidee))
        if (Use* use = useOf(body)) use->simulated = true;
    if (node.has(Attr::Parent))
      if (Use* use = useOf(*node.reference(Attr::Parent)))
        use->isParent = true, use->levels += lodLevelKinds().has(node.kind());
    for (const EventMessage& message : node.eventMessages()) {
      noteMessage(message);
      warnOfMissing(message.words, message.command);
    }
  }

  void noteMessage(const EventMessage& message) {
    if (Use* field = useOf(message.field); field != nullptr && message.verb == Verb::Hook)
      field->hooked = true;
    Use* use = useOf(message.target);
    if (use == nullptr) return;
    if (message.verb == Verb::Enable || message.verb == Verb::Toggle) use->switchedOn = true;
  }

  static std::vector<NodeReference> referencesIf(const Declaration& node, Attr attr) {
    return node.has(attr) ? node.references(attr) : std::vector<NodeReference>{};
  }

  void look(const Declaration& node) {
    switch (node.kind()) {
    case NodeKind::Lod: return lookAtLod(node);
    case NodeKind::Object: return lookAtModel(node);
    case NodeKind::DynObject: return lookAtBody(node);
    case NodeKind::Light: return lookAtLight(node);
    case NodeKind::Text: return warnOfMissing(node.text(Attr::Text), node.offset(Attr::Text));
    case NodeKind::ForceLinear:
    case NodeKind::ForceSpherical:
    case NodeKind::ForcePoint:
    case NodeKind::ForceVortex:
    case NodeKind::Medium: return lookAtField(node);
    case NodeKind::UserTrigger:
    case NodeKind::WandTrigger:
    case NodeKind::Timer: return lookAtSender(node);
    case NodeKind::Scene: return lookAtScene(node);
    case NodeKind::Path: return lookAtPath(node);
    case NodeKind::Sway: return lookAtSway(node);
    case NodeKind::Sound: return lookAtSound(node);
    case NodeKind::Collision:
    case NodeKind::Dynamics: return lookAtContacts(node);
    default: return;
    }
  }

  void lookAtLod(const Declaration& node) {
    const std::size_t ranges = node.distances(Attr::Ranges).size(), levels = uses_[node.index()].levels;
    if (levels < ranges)
      warn(node, Attr::Ranges,
           fmt::format("{} has {} ranges for {} of its children: beyond them nothing is drawn", called(node),
                       ranges, levels));
    if (levels > ranges + 1)
      warn(node, Attr::Ranges,
           fmt::format("{} has {} children for {} ranges; those after the {}th are never drawn", called(node),
                       levels, ranges, ranges + 1));
  }

  void lookAtModel(const Declaration& node) {
    const std::string ending = endingOf(node.text(Attr::File));
    if (std::find(std::begin(kModelEndings), std::end(kModelEndings), ending) == std::end(kModelEndings))
      warn(node, Attr::File,
           fmt::format("\"{}\" is not in a format that is read (.obj, .3ds, .gltf, .glb, .dae, .stl)",
                       node.text(Attr::File)));
  }

  void lookAtBody(const Declaration& node) {
    lookAtModel(node);
    if (node.has(Attr::Mass) && node.has(Attr::Density))
      warn(node, Attr::Density, "density has no effect, since mass is stated too");
    warnRepeated(node, Attr::Hook);
    if (alone_ && !uses_[node.index()].simulated)
      warn(node, Attr::Name,
           fmt::format("{} is collidee of no dynamics node and will never move", called(node)));
  }

  void lookAtLight(const Declaration& node) {
    const std::string_view type = node.text(Attr::Type);
    if (node.has(Attr::Intensity) && node.number(Attr::Intensity) == 0)
      warn(node, Attr::Intensity, "a light of intensity 0 lights nothing");
    if (node.has(Attr::Angle) && type != "spot")
      warn(node, Attr::Angle, "angle has no effect: only a spot light has one");
    if (node.has(Attr::Range) && type == "directional")
      warn(node, Attr::Range, "range has no effect: a directional light reaches everywhere");
    if (node.has(Attr::Shadows) && type != "directional")
      warn(node, Attr::Shadows, "shadows has no effect: only a directional light casts them");
    if (node.has(Attr::Direction) && type == "point")
      warn(node, Attr::Direction, "direction has no effect: a point light shines all around");
    warnNeverOn(node);
  }

  void warnOfMissing(std::string_view words, std::uint32_t where) {
    for (const char32_t c : missingFrom(unescaped(words)))
      report_.warning(where, fmt::format("the letters of the show have no U+{:04X}; a box stands for it",
                                         static_cast<std::uint32_t>(c)));
  }

  void lookAtNumberOfLights() {
    std::size_t on = 0;
    for (const Declaration node : document_) {
      if (node.kind() != NodeKind::Light || !node.flag(Attr::InitState) || ++on != kMostLights + 1) continue;
      std::size_t all = 0;
      for (const Declaration light : document_)
        all += light.kind() == NodeKind::Light && light.flag(Attr::InitState);
      warn(node, Attr::Type,
           fmt::format("{} lights are on at the start, but only {} shine at a time: those that are brightest "
                       "where the visitor is",
                       all, kMostLights));
    }
  }

  void lookAtField(const Declaration& node) {
    const Use& use = uses_[node.index()];
    const bool linear = node.kind() == NodeKind::ForceLinear;
    if (node.kind() == NodeKind::Medium) {
      if (node.number(Attr::Density) == 0 && node.number(Attr::Viscosity) == 0)
        warn(node, Attr::Density, "this medium holds nothing back: its density and viscosity are 0");
    } else if (linear ? node.has(Attr::Direction) && node.vec3(Attr::Direction).isZero(0)
                      : node.number(Attr::Strength) == 0) {
      warn(node, linear ? Attr::Direction : Attr::Strength, "this field exerts no force");
    }
    if (node.has(Attr::Tracker) && !node.has(Attr::StrengthAxis))
      warn(node, Attr::Tracker, "the tracker has no effect without strengthaxis");
    if (node.name().empty() || (alone_ && !use.hooked))
      warn(node, Attr::Name, fmt::format("{} is never hooked to a body", called(node)));
    warnNeverOn(node);
  }

  void lookAtSender(const Declaration& node) {
    if (node.has(Attr::EventMessage)) return warnNeverOn(node);
    warn(node, Attr::Name, fmt::format("{} has no eventmessage and so no effect", called(node)));
  }

  void lookAtScene(const Declaration& node) {
    if (endingOf(node.text(Attr::File)) != "evs")
      warn(node, Attr::File, fmt::format("\"{}\" does not look like a script (.evs)", node.text(Attr::File)));
    if (!node.flag(Attr::InitState) && node.name().empty())
      warn(node, Attr::InitState,
           "this scene is not loaded at the start, and without a name it never can be");
  }

  void lookAtTargets(const Declaration& node) {
    if (!node.has(Attr::Target) && (node.name().empty() || (alone_ && !uses_[node.index()].isParent)))
      warn(node, Attr::Name,
           fmt::format("{} moves nothing: it has no target, and no node has it as parent", called(node)));
    for (const NodeReference& target : referencesIf(node, Attr::Target)) {
      const Use* use = useOf(target);
      if (use && use->simulated)
        report_.warning(target.where,
                        fmt::format("\"{}\" is moved by a dynamics node, never by this {}; make it an object",
                                    target.name, nameOf(node.kind())));
    }
  }

  void lookAtPath(const Declaration& node) {
    lookAtTargets(node);
    lookAtTurns(node);
    warnNeverOn(node);
  }

  void lookAtSway(const Declaration& node) {
    lookAtTargets(node);
    warnRepeated(node, Attr::Target);
    const Vec3 amplitude = node.vec3(Attr::Amplitude), frequency = node.vec3(Attr::Frequency);
    if (amplitude.isZero(0) && node.vec3(Attr::AngularVelocity).isZero(0))
      warn(node, Attr::Amplitude,
           fmt::format("{} moves nothing: its amplitude and angularvelocity are 0", called(node)));
    for (int i = 0; i < 3; ++i)
      if (amplitude[i] != 0 && frequency[i] == 0)
        warn(node, Attr::Frequency,
             fmt::format("along {} it does not go to and fro: its frequency there is 0", "xyz"[i]));
    warnNeverOn(node);
  }

  void lookAtSound(const Declaration& node) {
    const std::string ending = endingOf(node.text(Attr::File));
    if (std::find(std::begin(kSoundEndings), std::end(kSoundEndings), ending) == std::end(kSoundEndings))
      warn(node, Attr::File,
           fmt::format("\"{}\" is not in a format that is read (.wav, .aiff, .flac, .ogg)",
                       node.text(Attr::File)));
    if (node.number(Attr::Gain) == 0) warn(node, Attr::Gain, "a sound of gain 0 is never heard");
    warnNeverOn(node);
  }

  /// From key to key a path turns the shorter way round.
  void lookAtTurns(const Declaration& node) {
    const auto keys = node.keys();
    for (std::size_t i = 1; i < keys.size(); ++i) {
      const double turn = (keys[i].orientation - keys[i - 1].orientation).cwiseAbs().maxCoeff();
      if (turn < 180) continue;
      warn(node, Attr::Key,
           fmt::format(
               "from {} s to {} s the keys turn by {:g} degrees, but a path turns the shorter way from "
               "key to key: put keys between them, less than 180 degrees apart",
               keys[i - 1].time, keys[i].time, turn));
      return;
    }
  }

  void lookAtContacts(const Declaration& node) {
    const auto collidees = node.references(Attr::Collidee);
    if (collidees.empty())
      warn(node, Attr::Name, fmt::format("{} has no collidee and so no effect", called(node)));
    warnRepeated(node, Attr::Collider);
    warnNeverOn(node);
  }

  void warnNeverOn(const Declaration& node) {
    if (node.flag(Attr::InitState)) return;
    if (node.name().empty() || (alone_ && !uses_[node.index()].switchedOn))
      warn(node, Attr::InitState, fmt::format("{} is off at the start and nothing enables it", called(node)));
  }

  void warnRepeated(const Declaration& node, Attr attr) {
    std::unordered_set<std::string_view> names;
    for (const NodeReference& reference : node.references(attr))
      if (!names.insert(reference.name).second)
        report_.warning(reference.where,
                        fmt::format("{} \"{}\" is given twice", nameOf(attr), reference.name));
  }

  static std::string called(const Declaration& node) {
    return node.name().empty() ? fmt::format("this {}", nameOf(node.kind()))
                               : fmt::format("the {} \"{}\"", nameOf(node.kind()), node.name());
  }

  void warn(const Declaration& node, Attr attr, std::string message) {
    report_.warning(node.offset(attr), std::move(message));
  }

  const Document& document_;
  bool alone_;
  Reporter& report_;
  std::vector<Use> uses_;
};

}  // namespace

void lint(const Document& document, bool alone, Diagnostics& findings) {
  Reporter report(document.source(), findings);
  Linter(document, alone, report).run();
}

void lintLatencies(const Document& document, Nanoseconds step, Diagnostics& findings) {
  // Said of the first one alone: at a low rate it may be all of them.
  std::optional<EventMessage> first;
  std::size_t count = 0;
  for (const Declaration node : document)
    for (const EventMessage& m : node.eventMessages()) {
      if (m.latency == 0 || m.delay + m.latency >= step) continue;
      if (count++ == 0) first = m;
    }
  if (!first) return;
  const std::string others = count == 1 ? "" : fmt::format("; so are {} more in this file", count - 1);
  Reporter(document.source(), findings)
      .warning(first->where,
               fmt::format("the latency of {:g} s is shorter than a frame ({:.4f} s at {:g} Hz), so that "
                           "the command waits for the next frame; state {:.3f} or more{}",
                           toSeconds(first->latency), toSeconds(step), 1 / toSeconds(step),
                           std::ceil(1e3 * toSeconds(step - first->delay)) / 1e3, others));
}

void lintTrackers(const Document& document, const std::vector<std::string>& known, const std::string& log,
                  Diagnostics& findings) {
  static const std::vector<std::string> kUsual = {"head", "wand", "foot"};
  Reporter report(document.source(), findings);
  const auto among = [](const std::vector<std::string>& names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
  };
  const auto look = [&](std::string_view name, std::uint32_t where) {
    if (name.empty() || among(kUsual, name) || among(known, name)) return;
    std::vector<std::string> near = known;
    near.insert(near.end(), kUsual.begin(), kUsual.end());
    const std::string meant = didYouMean(name, near);
    if (!log.empty())
      report.warning(where,
                     fmt::format("no device is called \"{}\": {} has {}{}", name, log,
                                 known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", ")), meant));
    else if (!meant.empty())
      report.warning(where, fmt::format("\"{}\" is no usual name of a device{}", name, meant));
  };
  for (const Declaration node : document) {
    if (node.has(Attr::Tracker)) look(node.text(Attr::Tracker), node.offset(Attr::Tracker));
    for (const EventMessage& m : node.eventMessages()) look(m.tracker, m.command);
  }
}

}  // namespace stadion
