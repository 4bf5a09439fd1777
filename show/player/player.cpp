#include "show/player/player.h"

#include "engine/base/installed_files.h"
#include "engine/hall_formats/hall_import.h"
#include "engine/input/input_log.h"
#include "engine/plain_text/number_text.h"
#include "engine/scene/scene_snapshot.h"
#include "pipeline/platform/draw_pool.h"
#include "pipeline/platform/processor_set.h"
#include "pipeline/projection/projection.h"
#include "show/player/show_files.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>
#include <malloc.h>
#include <mutex>
#include <set>
#include <thread>
#include <tuple>

namespace stadion {
namespace {

/// There is no visitor: every tracker is silent.
class NoInput final : public InputDevice {
public:
  using InputDevice::sampleAt;
  void sampleAt(Nanoseconds showTime, InputSample& sample) override {
    sample.time = showTime;
    sample.trackers.clear();
  }
};

std::size_t appThreadsOf(const ShowOptions& o) {
  return o.appThreads > 0 ? o.appThreads : std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, 8);
}

/// The same, but what was said of a file is not said again whenever it is loaded again.
std::function<void(const Diagnostics&)> onlyNews(std::function<void(const Diagnostics&)> report) {
  struct Said {
    std::mutex mutex;
    std::set<std::string> texts;
  };
  constexpr std::size_t kMost = 10'000;  // beyond that, reports each one
  return [report = std::move(report), said = std::make_shared<Said>()](const Diagnostics& findings) {
    Diagnostics news;
    {
      const std::lock_guard lock(said->mutex);
      for (const Diagnostic& d : findings.all()) {
        std::string text = format(d);
        if (said->texts.contains(text)) continue;
        news.add(d);
        if (said->texts.size() < kMost) said->texts.insert(std::move(text));
      }
    }
    if (report && !news.all().empty()) report(news);
  };
}

}  // namespace

AssetRoots ShowOptions::roots() const {
  AssetRoots all = AssetRoots::ofScript(script);
  for (const std::string& root : assetRoots) all.add(root);
  return all;
}

bool ShowOptions::complete(Diagnostics& findings) {
  const auto sides = parseSize(size.empty() ? "800x600" : size);
  const auto fits = [](std::uint32_t side) { return side >= 1 && side <= 16384; };
  if (sides && fits(sides->first) && fits(sides->second))
    std::tie(width, height) = *sides;
  else
    findings.error({}, "--size: \"" + size +
                           "\" is not WIDTHxHEIGHT in pixels from 1x1 to 16384x16384, such as 800x600");
  if (samples > 0 && look == Look::Plain)
    findings.error({}, "--samples is for --look full: the plain look has one sample a pixel");
  return !findings.hasErrors();
}

Player::Player() = default;
Player::~Player() = default;

bool Player::openInput(Diagnostics& findings) {
  inputName_ = inputLogOf(options_.script, options_.input);
  rate_ = options_.rate;
  if (inputName_.empty()) {
    input_ = std::make_unique<NoInput>();
    return true;
  }
  auto log = loadInputLog(inputName_, findings);
  if (!log) return false;
  decisions_ = log->decisions;
  if (decisions_.rate > 0 && !options_.rateGiven) rate_ = decisions_.rate;
  if (decisions_.rate > 0 && rate_ != decisions_.rate && !decisions_.empty())
    findings.error({inputName_, 0, 0},
                   fmt::format("was recorded live at {} frames a second, and holds times that only this rate "
                               "repeats; leave --rate out",
                               decisions_.rate));
  for (const InputTrack& track : log->tracks) trackers_.push_back(track.name);
  input_ = std::make_unique<InputReplay>(std::move(*log));
  inputFound_ = true;
  return !findings.hasErrors();
}

// As asked for, else to the end of the input, else until stopped.
void Player::computeLength() {
  const auto framesTo = [&](double seconds) {
    return static_cast<std::uint64_t>(std::ceil(seconds * rate_)) + 1;
  };
  frames_ = options_.frames;
  if (frames_ == 0 && options_.seconds > 0) frames_ = framesTo(options_.seconds);
  if (frames_ > 0 || !inputFound_) return;
  end_ = input_->end();
  // Where ticks were missed there are fewer frames than that.
  if (decisions_.frames.empty()) frames_ = framesTo(toSeconds(end_));
}

std::unique_ptr<Player> Player::create(const ShowOptions& options, Diagnostics& findings,
                                       std::function<void(const Diagnostics&)> report,
                                       const std::atomic<bool>* stop, ImportedMeshes* kept) {
  auto player = prepare(options, findings, std::move(report), stop, kept);
  return player && player->openScene(findings) ? std::move(player) : nullptr;
}

std::unique_ptr<Player> Player::prepare(const ShowOptions& options, Diagnostics& findings,
                                        std::function<void(const Diagnostics&)> report,
                                        const std::atomic<bool>* stop, ImportedMeshes* kept) {
  std::unique_ptr<Player> player(new Player);
  Player& p = *player;
  p.options_ = options;
  if (kept) p.meshes_ = &kept->store();

  auto walls = loadHall(options.walls, shareFolder() + "/walls", findings);
  if (!walls) return nullptr;
  if (!p.project(*walls, findings)) return nullptr;
  p.takeWalls(std::move(*walls));
  if (!p.openInput(findings)) return nullptr;
  p.computeLength();

  p.roots_ = AssetRoots::ofScript(options.script);
  AssetRoots forImporter = AssetRoots::ofScript(options.script);
  for (const std::string& root : options.assetRoots)
    if (!p.roots_.add(root) || !forImporter.add(root))
      findings.error({}, "--asset-root: cannot open the folder " + root);
  if (findings.hasErrors()) return nullptr;

  p.types_ = options.types;
  p.services_.set(DynamicsServices(options.variation, &p.roots_));
  ImportLimits limits;
  limits.giveUp = stop;
  p.importer_ = std::make_unique<Importer>(Importer::installedProgram(), std::move(forImporter), limits);
  p.loader_ = std::make_unique<Loader>(LoaderParts{
      *p.meshes_, p.state_.arena(), *p.importer_, p.roots_, *p.types_, p.services_,
      onlyNews(std::move(report)), stop, fromSeconds(1 / p.rate_), p.trackers_, p.inputName_, kept,
      options.texts ? options.texts : ScriptTexts::read(options.script, p.roots_, *p.types_)});
  p.loader_->replay(p.decisions_.loads);
  p.scene_ = std::make_unique<Scene>(*p.loader_, *p.meshes_, appThreadsOf(options));
  p.options_.texts.reset();  // the loader keeps what is still to be loaded
  return player;
}

bool Player::openScene(Diagnostics& findings) {
  if (const auto state = std::exchange(options_.state, nullptr)) {
    if (const auto why = SceneSnapshot(*scene_).restore(*state, options_.script)) {
      findings.error({options_.script, 0, 0}, "the show cannot go on from the scene that was kept: " + *why);
      return false;
    }
  } else if (!scene_->open(options_.script)) {
    return false;
  }
  bool hasCues = false;
  scene_->tree().forEachNode([&](const Node& node) { hasCues = hasCues || node.kind() == "cue"; });
  if (hasCues) operator_.emplace(visitor());
  // Reading a show of a million nodes takes more memory than holding it. Here no frame waits for its release.
  malloc_trim(0);
  return true;
}

FrameLoopOptions Player::loopOptions() const {
  FrameLoopOptions l;
  l.mode = options_.mode;
  l.rate = rate_;
  l.walls = walls_.walls.size();
  l.frames = frames_;
  l.frameTimes = decisions_.frames;
  l.degradation = decisions_.degradation;
  if (frames_ == 0) l.end = end_;
  return l;
}

/// Finds how the projectors of the hall, if it has any, share its screens, and the views of panoramas. Neighbours
/// that other hosts draw count, too.
bool Player::project(WallFile& room, Diagnostics& findings) {
  if (!options_.isDrawn || std::ranges::all_of(room.walls, &WallEntry::isFlat)) return true;
  for (WallEntry& entry : room.walls) {
    // --size states the width: the pictures of projectors and panoramas keep their shape.
    if (options_.size.empty()) break;
    if (entry.panorama) entry.panorama = withWidth(*entry.panorama, options_.width);
    if (!entry.projector) continue;
    Projector& p = *entry.projector;
    p.height = std::max(1u, static_cast<std::uint32_t>(std::uint64_t{p.height} * options_.width / p.width));
    p.width = options_.width;
  }
  DrawPool pool(std::max<std::size_t>(1, processorsOfThisThread().size()));
  auto made = makeProjections(room, pool);
  if (!made) {
    findings.add(made.error());
    return false;
  }
  for (std::size_t i = 0; i < room.walls.size(); ++i)
    if (made.value()[i]) projections_[room.walls[i].wall.name] = std::move(made.value()[i]);
  return true;
}

void Player::takeWalls(WallFile room) {
  walls_ = std::move(room);
  if (options_.onlyWalls.empty()) return;
  const auto isOurs = [&](const WallEntry& entry) {
    return std::ranges::find(options_.onlyWalls, entry.wall.name) != options_.onlyWalls.end();
  };
  std::ranges::remove_copy_if(walls_.walls, std::back_inserter(others_), isOurs);
  std::erase_if(walls_.walls, [&](const WallEntry& entry) { return !isOurs(entry); });
}

/// What the user says on the command line counts, else what the wall file says, else the standard size.
PixelSize Player::pixelsOf(const WallEntry& entry) const {
  const bool byFile = options_.size.empty() && entry.pixels.width > 0;
  return byFile ? entry.pixels : PixelSize{options_.width, options_.height};
}

WallViews Player::viewsOfEntry(const WallEntry& entry, bool stereo) const {
  WallViews wall{.name = entry.wall.name};
  wall.depth = walls_.depth;
  wall.eyeSeparation = walls_.eyeSeparation;
  wall.card = entry.card;
  if (const auto projection = projections_.find(entry.wall.name); projection != projections_.end()) {
    wall.projection = projection->second;
    wall.views = viewsOf(*wall.projection, stereo);
    wall.width = wall.projection->facets().width;
    wall.height = wall.projection->facets().height;
    return wall;
  }
  wall.views = viewsOf(entry.wall, stereo);
  const PixelSize pixels = pixelsOf(entry);
  wall.width = pixels.width;
  wall.height = pixels.height;
  return wall;
}

ShowParts Player::parts(StereoLayout stereo, InputDevice* instead) {
  ShowParts parts{.scene = *scene_,
                  .state = state_,
                  .meshes = *meshes_,
                  .input = instead ? *instead : input(),
                  .walls = {},
                  .observer = {},
                  .freeUnshown = [this](std::uint64_t frame) { loader_->shown(frame); },
                  .fading = [this] { return loader_->fadingMeshes(); }};
  if (options_.look == Look::Plain) parts.quality = RenderQuality::plain();
  if (options_.samples > 0) parts.quality.samples = options_.samples;
  for (const WallEntry& entry : walls_.walls)
    parts.walls.push_back(viewsOfEntry(entry, eyeCount(stereo) == 2));
  for (const WallEntry& entry : others_) {
    const WallViews wall = viewsOfEntry(entry, false);
    for (const View& view : wall.views) parts.otherWalls.push_back(wallPixelsOf(wall, view));
  }
  patterns_ = std::make_unique<PatternPictures>(walls_, eyeCount(stereo) == 2);
  parts.patterns = patterns_.get();
  return parts;
}

}  // namespace stadion
