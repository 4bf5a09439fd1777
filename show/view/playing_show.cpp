#include "show/view/playing_show.h"

#include "pipeline/projection/projection.h"
#include "show/player/write_watching.h"
#include "show/recording/governor_options.h"
#include "show/recording/last_frames.h"

#include <cmath>

namespace stadion {
namespace {

/// The scene nodes of the show's own file, and which of them have their file loaded.
std::map<std::string, bool> subScenes(const Scene& scene) {
  std::map<std::string, bool> known;
  std::set<std::uint32_t> loads;
  scene.tree().forEachNode([&](const Node& node) {
    const NodeRef ref = node.self();
    const LoadedScene* load = scene.tree().load(ref.load);
    if (load && !load->owner.valid() && node.kind() == "scene" && !node.name().empty())
      known.try_emplace(node.name(), false);
    loads.insert(ref.load);
  });
  for (const std::uint32_t number : loads) {
    const LoadedScene* load = scene.tree().load(number);
    const LoadedScene* outer = load ? scene.tree().load(load->owner.load) : nullptr;
    if (!outer || outer->owner.valid() || load->owner.position >= outer->nodes.size()) continue;
    if (const Node* owner = outer->nodes[load->owner.position].get()) known[owner->name()] = true;
  }
  return known;
}

}  // namespace

std::unique_ptr<PlayingShow> PlayingShow::open(const ShowSurroundings& around, Diagnostics& findings) {
  std::unique_ptr<PlayingShow> show(new PlayingShow(around));
  ShowOptions played = around.settings.show;
  played.texts = around.texts;
  show->player_ = Player::create(played, findings, around.reporter.reportFunction(),
                                 show->around_.stopping.get(), &around.kept->models);
  if (!show->player_) return nullptr;
  Player& player = *show->player_;
  if (around.visitor) player.takeInputFrom(*around.visitor);
  RecordSettings recorded = around.settings.record;
  recorded.input = around.recorded ? around.console.fileOfGroup(recorded.input) : "";
  show->watch_ = RunWatch::create(recorded, around.settings.play, player, findings);
  if (!show->watch_) return nullptr;
  const SheetPlace& size = around.overviewSize;
  show->overview_ = std::make_unique<Overview>(player.meshes(), player.walls(),
                                               static_cast<double>(size.width) / size.height);
  if (!around.settings.play.repeats(player)) player.playLive();
  return show;
}

/// The show before this one has ended: its last frames may be replaced by these.
void PlayingShow::beginRecording() {
  std::vector<std::string> walls = player_->walls().names();
  walls.push_back("overview");
  RecordingOptions options;
  options.profile = false;
  options.also.push_back(&budget_);
  if (around_.web) options.also.push_back(&around_.web->frameMeter());
  options.log.whole = false;
  options.log.samples = hasDrawnBudgets(player_->scene());
  options.log.shares = true;
  options.govern = governorOf(around_.settings.play, *player_, walls, around_.reporter.hintFunction());
  options.keep = lastFramesOf(around_.settings.play, around_.settings.record.blackBox, *player_, walls);
  if (around_.web) options.keep->late = around_.web->lateFunction(options.keep->walls);
  options.keep->wanted = false;  // whether it can be was found out before anything was played
  Diagnostics findings;
  recording_ = ShowRecording::create(std::move(options), findings);
  around_.reporter.report(findings);
}

PlayingShow::~PlayingShow() {
  stop();
}

ShowParts PlayingShow::parts() {
  ShowParts parts = player_->parts(around_.settings.draw.layout);
  for (std::size_t i = 0; i < parts.walls.size() && i < around_.pictureSizes.size(); ++i) {
    const auto& projection = parts.walls[i].projection;
    if (projection && projection->panorama()) continue;  // the window shows its picture
    const bool projected = projection != nullptr;
    if (projected) {  // the window shows about what the audience sees
      parts.walls[i].projection = nullptr;
      parts.walls[i].views =
          viewsOf(player_->walls().walls[i].wall, eyeCount(around_.settings.draw.layout) == 2);
    }
    const bool stated = !around_.settings.show.size.empty() || player_->walls().walls[i].pixels.width > 0;
    if (stated && !projected) continue;
    parts.walls[i].width = around_.pictureSizes[i].width;
    parts.walls[i].height = around_.pictureSizes[i].height;
  }
  WallViews outside{.name = {}, .views = {View{}}};
  outside.camera = overview_.get();
  outside.depth = player_->walls().depth;
  outside.width = around_.overviewSize.width;
  outside.height = around_.overviewSize.height;
  parts.walls.push_back(outside);
  around_.renderer.drawFor(parts);
  parts.sink = &around_.sink;
  parts.contexts = &around_.kept->contexts;
  parts.probe = &recording_->probe();
  parts.giveUp = [this] { return around_.stopping->load(); };
  parts.observer = [this](const TimeSignature& now, const InputSample& input, const Scene& scene) {
    see(now, input, scene);
  };
  return parts;
}

void PlayingShow::start(const std::optional<ShowPlace>& place) {
  from_ = place;
  beginRecording();
  FrameLoopOptions options = around_.settings.play.loopOptions(*player_);
  options.walls += 1;  // the overview
  ShowParts show = parts();
  around_.console.beginGroup(*player_, *watch_);
  around_.console.addTo(show, options);
  if (!player_->replaysLog()) options.decider = recording_->governor();
  if (around_.web) {
    around_.web->beginShow(boardShowOf(around_.settings.show.script, *player_, show),
                           {0, around_.console.groups(), 0, around_.console.state()});
    show.sink = &around_.web->sinkBefore(show.sink);
  }
  writes_ = watchWrites(around_.settings.play.guard, show, options);
  stages_ = std::make_unique<ShowStages>(std::move(show));
  loop_ = std::make_unique<FrameLoop>(*stages_, options, *around_.stopping, &recording_->probe());
  thread_ = std::thread([this] {
    outcome_ = loop_->run();
    if (around_.ended) around_.ended();
  });
}

void PlayingShow::stop() {
  *around_.stopping = true;
  if (thread_.joinable()) {
    thread_.join();
    writes_.reset();
    nameNode(outcome_.failure, player_->scene());
  }
  if (recording_) recording_->finish();
}

std::string PlayingShow::lateFrames() const {
  const BlackBox* box = recording_ ? recording_->blackBox() : nullptr;
  return box ? lateFramesText(*box) : "";
}

ShowPlace PlayingShow::place() const {
  const std::lock_guard lock(mutex_);
  return place_;
}

// On the App thread, after each App stage.
void PlayingShow::see(const TimeSignature& now, const InputSample& input, const Scene& scene) {
  watch_->see(now, input, scene);
  recording_->see(scene);
  if (around_.web) around_.web->see(now, around_.console.groups(), around_.console.state(), scene);
  overview_->see(input);
  if (now.frame == 0 && from_) takeUp(*from_);
  notePlace(scene);
  frames_ = now.frame + 1;
  time_ = now.time;
  const auto ticks = std::llround(toSeconds(now.step) * player_->rate());
  if (ticks > 1) dropped_ += static_cast<std::uint64_t>(ticks - 1);
}

void PlayingShow::takeUp(const ShowPlace& place) {
  Scene& scene = player_->scene();
  scene.moveRig(place.X_WR);
  for (const auto& [name, loaded] : subScenes(scene)) {
    const bool wanted = place.loaded.contains(name);
    if (wanted != loaded) scene.command(name, wanted ? CommandId::Load : CommandId::Unload, {}, 0);
  }
}

void PlayingShow::notePlace(const Scene& scene) {
  const bool changed = scene.tree().version() != loadsSeen_;
  loadsSeen_ = scene.tree().version();
  const std::lock_guard lock(mutex_);
  place_.X_WR = scene.feed().rigPose();
  if (!changed) return;
  place_.loaded.clear();
  for (const auto& [name, loaded] : subScenes(scene))
    if (loaded) place_.loaded.insert(name);
}

}  // namespace stadion
