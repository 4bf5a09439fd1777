#include "show/player/show_check.h"

#include "dynamics/motion/body_flight.h"
#include "dynamics/nodes/body_maker.h"
#include "dynamics/nodes/collision_node.h"
#include "dynamics/nodes/dyn_object_node.h"
#include "engine/asset/sound_file.h"
#include "engine/base/run_stopped.h"
#include "engine/build/lint.h"
#include "engine/build/model_options.h"
#include "engine/input/input_log.h"
#include "engine/script/script.h"
#include "show/player/player.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <set>

namespace stadion {
namespace {

constexpr double kDeepestStart = 1e-3;  // [m]
constexpr std::size_t kDeepestNesting = 16;

/// Checks a file and the sub-scenes below it.
class ShowChecker {
public:
  ShowChecker(const std::string& file, const std::vector<std::string>& roots, SharedTypes types,
              bool withAssets, const std::atomic<bool>* giveUp, std::shared_ptr<const ScriptTexts> texts,
              Diagnostics& findings)
      : types_(std::move(types)), roots_(AssetRoots::ofScript(file)), withAssets_(withAssets),
        giveUp_(giveUp), findings_(findings) {
    AssetRoots forImporter = AssetRoots::ofScript(file);
    for (const std::string& r : roots)
      if (!roots_.add(r) || !forImporter.add(r))
        findings.error({}, "--asset-root: cannot open the folder " + r);
    texts_ = texts ? std::move(texts) : ScriptTexts::read(file, roots_, *types_);
    ImportLimits limits;
    limits.giveUp = giveUp;
    importer_ = std::make_unique<Importer>(Importer::installedProgram(), std::move(forImporter), limits);
    services_.set(DynamicsServices({}, &roots_));
    readLogBeside(file);
  }

  void check() { checkFile(texts_->show(), {}); }

private:
  void checkFile(Result<SourceText> source, std::vector<const Document*> enclosing) {
    if (!source) return findings_.add(source.error());
    Diagnostics own;
    Document document = parseScript(std::move(source.value()), *types_, own);
    std::map<std::string, std::unique_ptr<Document>> inner;
    RelatedDocuments around;
    around.enclosing = enclosing;
    around.subScene = [&](Declaration scene) { return subScene(scene, inner); };
    resolveNames(document, around, own);
    bool alone = enclosing.empty();
    for (const Declaration d : document) alone &= !d.is(Trait::Encloses);
    if (!own.hasErrors() && withAssets_) {
      lint(document, alone, own);
      lintLatencies(document, fromSeconds(1 / ShowOptions{}.rate), own);
      lintTrackers(document, trackers_, log_, own);
      buildOnce(document, own);
    }
    findings_.append(own);
    if (enclosing.size() >= kDeepestNesting || (giveUp_ && *giveUp_)) return;
    enclosing.insert(enclosing.begin(), &document);
    for (const Declaration d : document) {
      // One whose file name was refused has been told already.
      if (!d.is(Trait::Encloses) || d.text("file").empty()) continue;
      auto below = readBelow(d);
      const bool circle =
          below && std::any_of(enclosing.begin(), enclosing.end(), [&](const Document* outer) {
            std::error_code unknown;
            return std::filesystem::equivalent(outer->file(), below.value().file(), unknown);
          });
      if (circle)
        findings_.error(d.where("file"), "this scene loads itself, and that one again, without end",
                        d.excerpt("file"));
      else if (seen_.insert(std::string(d.text("file"))).second)
        checkFile(std::move(below), enclosing);
    }
  }

  /// The devices that a run would hear of.
  void readLogBeside(const std::string& file) {
    const std::filesystem::path beside = std::filesystem::path(file).replace_extension(".input");
    std::error_code none;
    if (!std::filesystem::exists(beside, none)) return;
    Diagnostics ignored;  // a run tells what is wrong with it
    const auto log = loadInputLog(beside.string(), ignored);
    if (!log) return;
    log_ = beside.string();
    for (const InputTrack& track : log->tracks) trackers_.push_back(track.name);
  }

  Result<SourceText> readBelow(const Declaration& scene) const {
    auto source = texts_->part(std::string(scene.text("file")));
    if (source || !source.error().where.file.empty()) return source;
    Diagnostic d = source.error();
    d.where = scene.where("file");
    d.excerpt = scene.excerpt("file");
    return d;
  }

  /// Its names alone; its mistakes are found in its own turn.
  const Document* subScene(const Declaration& scene,
                           std::map<std::string, std::unique_ptr<Document>>& inner) const {
    const std::string file(scene.text("file"));
    if (const auto known = inner.find(file); known != inner.end()) return known->second.get();
    auto source = readBelow(scene);
    if (!source) return nullptr;
    Diagnostics ignored;
    auto& document = inner[file];
    document = std::make_unique<Document>(parseScript(std::move(source.value()), *types_, ignored));
    return document.get();
  }

  void buildOnce(const Document& document, Diagnostics& findings) {
    const BuildInput input{document,
                           1,
                           {},
                           Affine::Identity(),
                           {},
                           services_,
                           [&](const Declaration& d) { return importMesh(d, findings); },
                           meshes_,
                           [&](const Declaration& d) { return readSoundOf(d, findings); }};
    if (const Built built = buildLoad(input, findings); built.load)
      noteEvenMatter(*built.load, document, findings);
  }

  /// How a body flies hangs on where its matter is, which its model does not show.
  static void noteEvenMatter(const LoadedScene& load, const Document& document, Diagnostics& findings) {
    for (const Declaration d : document) {
      if (d.kind() != "dynobject" || d.has("centre") || d.has("inertia")) continue;
      const auto* node = dynamic_cast<const DynObjectNode*>(load.nodes[d.index()].get());
      if (!node || !node->body().flight || !leansOnMatter(node->body().flight->model)) continue;
      const MassProperties mass = node->body().massOf(*node->fit());
      const Vec3 c = mass.centre.cwiseQuotient(node->fit()->scale);
      Vec3 i = mass.inertia;
      std::sort(i.begin(), i.end());
      findings.note(d.where("flight"),
                    fmt::format("\"{}\" flies as if matter filled its model evenly: centre=\"{:.4f}, {:.4f}, "
                                "{:.4f}\", inertia=\"{:.4g}, {:.4g}, {:.4g}\"; state them if it is otherwise",
                                d.name(), c.x(), c.y(), c.z(), i.x(), i.y(), i.z()));
    }
  }

  /// The air turns it about its centre of mass.
  static bool leansOnMatter(const FlightModel& model) {
    return !std::holds_alternative<BallisticFlight>(model) && !std::holds_alternative<SportsBall>(model);
  }

  MeshId importMesh(const Declaration& d, Diagnostics& findings) {
    const ImportOptions options = importOptionsOf(d);
    const std::string file(d.text("file"));
    // A hundred objects with the same file: one import, and one word about it.
    const auto key =
        std::tuple(file, options.unit.value_or(0), static_cast<int>(options.up.value_or(UpAxis::Z)),
                   options.up.has_value(), options.form, textOf(options.nodes));
    if (const auto known = imported_.find(key); known != imported_.end()) return known->second;
    Diagnostics notes;
    const Attr blamed = blamedFor(d);
    auto mesh = importer_->load(file, options, d.where(blamed), &notes);
    if (options.nodes.part.empty()) findings.append(notes);  // once for the file
    if (!mesh) {
      Diagnostic wrong = mesh.error();
      wrong.excerpt = d.excerpt(blamed);
      findings.add(wrong);
    }
    return imported_[key] = meshes_.add(mesh ? std::move(mesh.value()) : standIn(file));
  }

  Nanoseconds readSoundOf(const Declaration& d, Diagnostics& findings) const {
    const auto read = [&]() -> Result<SoundInfo> {
      auto found = roots_.open(std::string(d.text("file")));
      if (!found) return found.error();
      return readSoundInfo(found.value().file.get(), found.value().path);
    };
    const auto info = read();
    if (!info) {
      Diagnostic wrong = info.error();
      wrong.where = d.where("file");
      wrong.excerpt = d.excerpt("file");
      findings.add(wrong);
      return kSilentStandIn;
    }
    if (info.value().channels == 2 && d.has("range"))
      findings.note(d.where("file"), "\"" + std::string(d.text("file")) +
                                         "\" has two channels; heard from a place they are mixed into one");
    return info.value().length();
  }

  SharedTypes types_;
  AssetRoots roots_;
  std::shared_ptr<const ScriptTexts> texts_;
  bool withAssets_;
  const std::atomic<bool>* giveUp_;
  std::unique_ptr<Importer> importer_;
  NodeServices services_;
  MeshStore meshes_;
  std::map<std::tuple<std::string, double, int, bool, ModelForm, std::string>, MeshId> imported_;
  std::set<std::string> seen_;
  std::vector<std::string> trackers_;
  std::string log_;
  Diagnostics& findings_;
};

/// What stands for each object in collisions, and bodies that stick in something when the show begins.
void lookAtCollisions(const std::string& file, const std::vector<std::string>& roots, SharedTypes types,
                      const std::atomic<bool>* giveUp, std::shared_ptr<const ScriptTexts> texts,
                      Diagnostics& findings) {
  ShowOptions options;
  options.texts = std::move(texts);
  options.script = file;
  options.types = std::move(types);
  options.input = "none";
  options.assetRoots = roots;
  Diagnostics told;
  auto player = options.complete(told) ? Player::create(
                                             options, told, [](const Diagnostics&) {}, giveUp)
                                       : nullptr;
  if (!player) return;
  ChangeSet changes;
  player->scene().advance(signatureAt(0, player->rate()), {}, changes, nullptr);
  struct Alike {
    const ObjectNode* first;
    std::size_t count;
  };
  std::map<const FittedShape*, Alike> alike;
  std::set<NodeRef> seen;
  player->scene().tree().forEachNode([&](const Node& node) {
    const auto* collision = dynamic_cast<const CollisionNode*>(&node);
    const LoadedScene* load = player->scene().tree().load(node.self().load);
    if (!collision || !load) return;
    for (const auto& [ref, fit] : collision->participants()) {
      const auto* object = dynamic_cast<const ObjectNode*>(player->scene().find(ref));
      if (!object || !fit || !seen.insert(ref).second) continue;
      const auto [at, isNew] = alike.try_emplace(fit, Alike{object, 0});
      ++at->second.count;
      if (ref < at->second.first->self()) at->second.first = object;
    }
    for (const CollisionNode::Overlap& o : collision->overlaps(kDeepestStart)) {
      char depth[32];
      std::snprintf(depth, sizeof depth, "%.1f mm", 1000 * o.depth);
      findings.warning({load->file, load->lines[node.self().position], 1},
                       "\"" + o.a + "\" and \"" + o.b + "\" overlap by " + depth +
                           " at the start; move one of them");
    }
  });
  for (const auto& [fit, objects] : alike) {
    const NodeRef ref = objects.first->self();
    const LoadedScene& from = *player->scene().tree().load(ref.load);
    std::string text = "\"" + objects.first->name() + "\" " + fit->choice.remark;
    if (objects.count > 1)
      text += "; " + std::to_string(objects.count - 1) + " more of this model do the same";
    findings.note({from.file, from.lines[ref.position], 1}, text);
  }
}

}  // namespace

Diagnostics checkShow(const std::string& file, const std::vector<std::string>& assetRoots, SharedTypes types,
                      const std::atomic<bool>* giveUp, std::shared_ptr<const ScriptTexts> texts) {
  Diagnostics findings;
  ShowChecker(file, assetRoots, types, true, giveUp, texts, findings).check();
  if (!findings.hasErrors()) try {
      lookAtCollisions(file, assetRoots, types, giveUp, texts, findings);
    } catch (const RunStopped&) {
      // given up
    }
  return sorted(findings);
}

Diagnostics checkScripts(const std::string& file, const std::vector<std::string>& assetRoots,
                         SharedTypes types, std::shared_ptr<const ScriptTexts> texts) {
  Diagnostics findings;
  ShowChecker(file, assetRoots, std::move(types), false, nullptr, std::move(texts), findings).check();
  return sorted(findings);
}

}  // namespace stadion
