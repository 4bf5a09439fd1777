#include "bench/flight/show_flights.h"

#include "dynamics/nodes/body_maker.h"
#include "dynamics/nodes/dynamics_nodes.h"

#include "bench/flight/exact_table.h"
#include "dynamics/nodes/dyn_object_node.h"
#include "engine/asset/import.h"
#include "engine/nodes/engine_nodes.h"
#include "engine/scene/scene.h"
#include "engine/script/script.h"
#include "pipeline/load/loader.h"
#include "pipeline/state/scene_state.h"

#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <optional>

namespace stadion::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kRate = 60;                // [Hz]
constexpr double kLongest = 20;          // [s]
constexpr double kWater = 1000;          // [kg/m3], the reference for a medium's density
constexpr const char* kTable = "t.csv";  // beside the script

/// A folder that is deleted with this object.
class ScratchFolder {
public:
  ScratchFolder() {
    std::error_code none;  // without a folder, writing the script fails with a message
    std::string form = (fs::temp_directory_path(none) / "stadion-flights-XXXXXX").string();
    if (const char* made = mkdtemp(form.data())) path_ = made;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

std::string words(const Vec3& v) {
  return fmt::format("\"{:.17g}, {:.17g}, {:.17g}\"", v.x(), v.y(), v.z());
}

/// Angles about X, Y and Z, one after the other, in degrees.
Vec3 anglesOf(const Quat& q) {
  const Mat3 r = q.normalized().toRotationMatrix();
  return Vec3(std::atan2(r(2, 1), r(2, 2)), std::asin(std::clamp(-r(2, 0), -1.0, 1.0)),
              std::atan2(r(1, 0), r(0, 0))) /
         kDegree;
}

std::string scriptOf(const ShowRung& rung, const std::vector<Throw>& throws) {
  std::string text =
      fmt::format("forcelinear( name=gravity, direction=\"0, 0, -{}\", unit=m/s2 )\n", kGravity);
  for (std::size_t i = 0; i < throws.size(); ++i) {
    const RigidFlight& s = throws[i].start;
    text += fmt::format("medium( name=air{}, density={}, wind={} )\n", i, kDensity / kWater,
                        words(throws[i].wind));
    text += fmt::format("dynobject( name=body{}, {}, position={}, orientation={}, velocity={}, "
                        "angularvelocity={}, hook=gravity, hook=air{} )\ndynamics( collidee=body{} )\n",
                        i, rung.attributes, words(s.p), words(anglesOf(s.q)), words(s.v),
                        words(s.q * s.w / kDegree), i, i);
  }
  return text;
}

/// A script, loaded and ready to be played.
class OpenedShow {
public:
  OpenedShow(const fs::path& script, const fs::path& assets) {
    AssetRoots forImporter = AssetRoots::ofScript(script);
    roots_ = AssetRoots::ofScript(script);
    roots_.add(assets);
    forImporter.add(assets);
    addEngineNodes(types_);
    addDynamicsNodes(types_);
    services_.set(DynamicsServices({}, &roots_));
    importer_ = std::make_unique<Importer>(Importer::installedProgram(), std::move(forImporter));
    loader_ =
        std::make_unique<Loader>(LoaderParts{meshes_, state_.arena(), *importer_, roots_, types_, services_,
                                             [this](const Diagnostics& d) { findings_.append(d); }});
    scene_ = std::make_unique<Scene>(*loader_, meshes_);
    opened_ = scene_->open(script);
  }
  bool opened() const { return opened_; }
  /// Returns the script's error. A show continues with a stand-in for a missing model; a bench does not.
  std::optional<Diagnostic> fault() const {
    for (const Diagnostic& d : findings_.all())
      if (d.severity != Severity::Note) return d;
    return std::nullopt;
  }
  Scene& scene() { return *scene_; }

private:
  Diagnostics findings_;
  NodeRegistry types_;
  NodeServices services_;
  MeshStore meshes_;
  SceneState state_;
  AssetRoots roots_;
  std::unique_ptr<Importer> importer_;
  std::unique_ptr<Loader> loader_;
  std::unique_ptr<Scene> scene_;
  bool opened_ = false;
};

RigidFlight motionOf(Scene& scene, std::size_t i) {
  const auto* node =
      dynamic_cast<DynObjectNode*>(scene.find(scene.tree().resolve(fmt::format("body{}", i), {1, 0})));
  if (!node) return {Vec3::Constant(NAN), Vec3::Zero(), Quat::Identity(), Vec3::Zero()};
  const BodyState& s = node->state();
  RigidFlight f;
  f.p = s.p;
  f.v = s.v;
  f.q = s.pose.q;
  f.w = s.pose.q.conjugate() * s.omega;
  return f;
}

/// Returns every body in every frame, until the last of them has landed.
std::vector<std::vector<RigidFlight>> play(Scene& scene, std::size_t count) {
  std::vector<std::vector<RigidFlight>> motions(count);
  ChangeSet changes;
  bool aloft = true;
  for (std::uint64_t frame = 0; aloft && static_cast<double>(frame) <= kLongest * kRate; ++frame) {
    changes.clear();
    scene.advance(signatureAt(frame, kRate), {}, changes, nullptr);
    aloft = false;
    for (std::size_t i = 0; i < count; ++i) {
      motions[i].push_back(motionOf(scene, i));
      aloft = aloft || motions[i].back().p.z() > 0;
    }
  }
  return motions;
}

Diagnostic inFile(const fs::path& file, std::string what) {
  Diagnostic wrong;
  wrong.where.file = file.string();
  wrong.message = std::move(what);
  return wrong;
}

}  // namespace

Result<ShowFlights> ShowFlights::ofOlympia(const fs::path& repository) {
  ShowFlights show;
  show.assets_ = repository / "assets";
  NodeRegistry types;
  addEngineNodes(types);
  addDynamicsNodes(types);
  for (const auto& [name, body] :
       {std::pair("javelin", &show.javelin_), std::pair("discus", &show.discus_)}) {
    const fs::path file = repository / fmt::format("scripts/olympia/game_{}.evs", name);
    auto source = SourceText::read(file.string());
    if (!source) return source.error();
    Diagnostics findings;
    const Document document = parseScript(std::move(source.value()), types, findings);
    const auto found = document.find(name);
    if (!found || found->kind() != "dynobject")
      return inFile(file, fmt::format("has no dynobject \"{}\"", name));
    const Declaration& d = *found;
    body->model = fmt::format("file={}, mass={}", d.text("file"), d.optionalNumber("mass").value_or(1));
    if (d.has("nose")) body->model += ", nose=" + words(d.vec3("nose"));
    if (d.has("centre")) body->matter += ", centre=" + words(d.vec3("centre"));
    if (d.has("inertia")) body->matter += ", inertia=" + words(d.vec3("inertia"));
    body->flight = fmt::format(", flight={}", d.text("flight"));
    if (d.has("coefficients")) body->flight += fmt::format(", coefficients=\"{}\"", d.text("coefficients"));
  }
  return show;
}

std::vector<ShowRung> ShowFlights::rungsOf(Thing thing) const {
  if (thing == Thing::Ball) return {};
  const bool javelin = thing == Thing::Javelin;
  const Body& body = javelin ? javelin_ : discus_;
  const std::string word = javelin ? "rod" : "plate", true_ = body.model + body.matter;
  std::vector<ShowRung> rungs{
      {thing, word + " in a show", true_ + body.flight},
      {thing, word + " from mesh in a show", true_ + ", flight=" + word},
      {thing, "table in a show", true_ + ", flight=table, flighttable=" + kTable},
      {thing, word + ", even matter", body.model + ", flight=" + word, false},
  };
  return rungs;
}

Result<std::vector<Trajectory>> ShowFlights::fly(const ShowRung& rung,
                                                 const std::vector<Throw>& throws) const {
  const ScratchFolder folder;
  const fs::path script = folder.path() / "flights.evs";
  std::ofstream(script) << scriptOf(rung, throws);
  std::ofstream(folder.path() / kTable) << textOf(exactTable(rung.thing));
  OpenedShow show(script, assets_);
  if (const auto fault = show.fault()) return *fault;
  if (!show.opened()) return inFile(script, "cannot be played");
  const auto motions = play(show.scene(), throws.size());
  std::vector<Trajectory> flights;
  for (std::size_t i = 0; i < throws.size(); ++i) {
    std::size_t frame = 0;
    flights.push_back(flyBy(throws[i], kRate, [&](RigidFlight& now) {
      if (frame + 1 < motions[i].size()) ++frame;
      now = motions[i][frame];
    }));
  }
  return flights;
}

}  // namespace stadion::bench
