#include "pipeline/loop/show_stages.h"

#include "engine/input/tracker_names.h"
#include "pipeline/gl_draw/warm_up_list.h"
#include "pipeline/process/per_view_process_renderer.h"
#include "pipeline/projection/pattern_pictures.h"
#include "pipeline/projection/projection.h"
#include "pipeline/wall/cpu_wall_renderer.h"
#include "pipeline/wall/gl_wall_renderer.h"

#include <algorithm>
#include <iterator>

namespace stadion {
namespace {

std::unique_ptr<WallRenderer> wallRendererFor(const ShowParts& parts) {
  std::vector<WallPicture> pictures;
  for (const WallViews& wall : parts.walls) pictures.push_back({wall.width, wall.height, wall.card});
  std::vector<std::string> names;
  for (const WallViews& wall : parts.walls) names.push_back(wall.name);
  if (!parts.wallProcesses && parts.pool)
    return std::make_unique<CpuWallRenderer>(
        CpuWallRendererParts{parts.meshes, *parts.pool, std::move(pictures), PictureRung::of(parts.quality),
                             parts.giveUp, parts.probe});
  if (!parts.wallProcesses && parts.provider)
    return std::make_unique<GlWallRenderer>(
        GlWallRendererParts{*parts.provider, parts.meshes, std::move(pictures), parts.quality, parts.contexts,
                            parts.giveUp, parts.probe, parts.processors, std::move(names), parts.tell});
  if (!parts.wallProcesses) return {};
  const WallProcesses& w = *parts.wallProcesses;
  PerWallProcessParts wallProcesses{parts.meshes,
                                    std::move(pictures),
                                    std::move(names),
                                    parts.quality,
                                    w.renderer,
                                    w.rasteriserThreads,
                                    w.everyFrame,
                                    w.rate,
                                    parts.giveUp,
                                    w.tell,
                                    wall_process::wallProgram(),
                                    parts.processors};
  if (parts.quality.look != Look::Plain)
    return std::make_unique<PerWallProcessRenderer>(std::move(wallProcesses));
  std::vector<std::uint32_t> views;
  for (const WallViews& wall : parts.walls) views.push_back(static_cast<std::uint32_t>(wall.views.size()));
  return std::make_unique<PerViewProcessRenderer>(std::move(wallProcesses), views);
}

void tellCounts(const FrameCounters& counters, FrameProbe& probe) {
  probe.counted(Count::Visits, counters.nodesVisited);
  probe.counted(Count::Messages, counters.messagesDelivered);
  probe.counted(Count::Published, counters.changesPublished);
}

}  // namespace

WallPixels wallPixelsOf(const WallViews& wall, const View& view) {
  WallPixels pixels{view.screen, wall.width, wall.height};
  const auto* panorama =
      wall.projection && wall.projection->panorama() ? &*wall.projection->panorama() : nullptr;
  pixels.around = panorama != nullptr;
  if (panorama) pixels.at = panorama->at;
  return pixels;
}

ShowStages::ShowStages(ShowParts parts)
    : parts_(std::move(parts)), room_(parts_.walls), wallRenderer_(wallRendererFor(parts_)),
      drawn_(parts_.walls.size()), pictures_(parts_.walls.size()) {
  if (parts_.head.latch) latch_.emplace(parts_.input, *parts_.head.latch);
  for (const WallViews& wall : parts_.walls) {
    const Wall* last = nullptr;
    for (const View& view : wall.views) {
      if (!wall.camera && !(last && isSameScreen(view.screen, *last)))
        wallPixels_.push_back(wallPixelsOf(wall, view));
      last = &view.screen;
    }
  }
  std::ranges::copy(parts_.otherWalls, std::back_inserter(wallPixels_));
  const bool shadows = parts_.quality.look == Look::Full;
  const bool oneSample = parts_.quality.samples == 1 && parts_.quality.leavesOutUnseen;
  const CullParts cull{
      room_, shadows ? &stillCasters_ : nullptr, wallPixels_, &parts_.meshes, parts_.probe, oneSample};
  for (std::uint32_t wall = 0; wall < parts_.walls.size(); ++wall) culls_.emplace_back(cull, wall);
}

ShowStages::~ShowStages() = default;

void ShowStages::app(const TimeSignature& now, std::size_t slot) {
  InputSample& input = input_;
  {
    const SpanScope span(parts_.probe, Span::Input);
    if (parts_.controls) parts_.input.freezeHead(parts_.controls->state().headFrozen);
    if (parts_.head.predict) parts_.input.aimHead(aimedAt());
    parts_.input.sampleFrame(now.time - now.step, now.time, input);
    noteMeasured(input);
  }
  // Changes go into the slot as they are found, unless the probe wants to see them as a whole.
  const bool whole = parts_.probe && parts_.probe->wantsShares(now.frame, kNoWall);
  changes_.sink = whole ? nullptr : &parts_.state;
  parts_.state.begin(slot);
  published_ = true;
  parts_.scene.advance(now, input, changes_, parts_.probe);
  if (parts_.probe) tellCounts(parts_.scene.counters(), *parts_.probe);
  {
    const SpanScope span(parts_.probe, Span::Publish);
    parts_.state.finish(changes_);
    parts_.meshes.collect(shownFrame_);
    if (parts_.freeUnshown) parts_.freeUnshown(shownFrame_);
  }
  if (whole) tellPublished();
  if (parts_.sounds) {
    const SpanScope span(parts_.probe, Span::Sound);
    playSounds(input, false);
  }
  if (!parts_.observer) return;
  const SpanScope span(parts_.probe, Span::Watching);
  parts_.observer(now, input, parts_.scene);
}

/// Reports the end of publishing; the visitor's place is part of every frame.
void ShowStages::tellPublished() {
  std::vector<NodeRef> owners{NodeRef{}};
  for (const ChangeSet::Instance& i : changes_.instances)
    if (i.record.radius >= 0) owners.push_back(i.record.owner);
  parts_.probe->shared(Span::Publish, changes_.signature.frame, kNoWall, owners);
}

void ShowStages::noteMeasured(const InputSample& input) {
  const TrackerSample* head = input.find(kHeadTracker);
  measured_.reset();
  if (head && head->valid && head->measured > 0) measured_.emplace(std::chrono::nanoseconds(head->measured));
}

Nanoseconds ShowStages::aimedAt() const {
  const auto predict = parts_.head.predict;
  return !predict ? 0 : *predict == HeadTiming::kToSwap ? swaps_.expected() : *predict;
}

std::optional<std::chrono::steady_clock::time_point> ShowStages::posed(std::size_t wall) const {
  return drawn_[wall].posed;
}

void ShowStages::latch(std::size_t wall, DrawList& list) {
  if (latch_)
    latch_->latch(parts_.walls[wall], list.ticket.began + std::chrono::nanoseconds(aimedAt()), list);
}

void ShowStages::playSounds(const InputSample& input, bool still) {
  if (!parts_.sounds) return;
  parts_.scene.collectSounds(input, heard_);
  parts_.sounds->play(heard_, {parts_.controls ? parts_.controls->state().volume : 1, still});
}

// Signature, sky and viewer of the last frame stay in the change set, except that the visitor may look
// around.
void ShowStages::still(const TimeSignature& now, std::size_t slot) {
  changes_.sink = nullptr;
  if (published_)
    changes_.clear();
  else
    parts_.scene.publishAsItStands(now, changes_);
  published_ = true;
  if (parts_.controls) parts_.input.freezeHead(parts_.controls->state().headFrozen);
  if (parts_.head.predict) parts_.input.aimHead(aimedAt());
  InputSample input;
  if (parts_.input.sampleNow(input)) parts_.scene.updateViewer(input, changes_);
  noteMeasured(input);
  playSounds(parts_.scene.feed().lastInput(), true);
  parts_.state.publish(slot, changes_);
}

void ShowStages::cull(std::size_t wall, std::size_t slot, DrawList& list) {
  const Presentation& shown = list.ticket.presentation;
  const bool visitors = !parts_.walls[wall].camera;  // else the view is an onlooker's
  const CullOptions options{.eyes = {shown.eyeSeparation, shown.swapEyes}, .black = visitors && shown.black};
  culls_[wall].fill(parts_.state.view(slot), options, list);
}

Failure ShowStages::openWall(std::size_t wall) {
  if (!wallRenderer_) return kNoFailure;
  if (Failure f = wallRenderer_->open(wall)) return f;
  if (wall == 0) drawnBy_ = wallRenderer_->drawnBy(wall);
  return kNoFailure;
}

Failure ShowStages::warmUp(std::size_t wall, const DrawList& list) {
  if (!wallRenderer_) return kNoFailure;
  const std::vector<MeshId> fading = parts_.fading ? parts_.fading() : std::vector<MeshId>();
  return wallRenderer_->warmUp(wall, warmUpList(list, parts_.meshes, fading));
}

bool ShowStages::wantsDrawn(const FrameTicket& ticket) const {
  return parts_.drawUnseen || ticket.last || (parts_.sink && parts_.sink->wants(ticket.signature));
}

Failure ShowStages::draw(std::size_t wall, const DrawList& list) {
  if (!wallRenderer_) return kNoFailure;
  Drawn& drawn = drawn_[wall];
  drawn.views = 0;  // until it is finished there is no picture
  began_ = list.ticket.began;
  const bool wanted =
      list.ticket.last || (parts_.sink && parts_.sink->wantsWall(list.ticket.signature, wall));
  if (DrawOutcome outcome = wallRenderer_->draw(wall, list, wanted); outcome.failure || !outcome.drawn) {
    if (!outcome.failure) {
      drawn.late.inARow = std::max(drawn.late.inARow, ++drawn.lateNow);
      ++drawn.late.frames;
    }
    return std::move(outcome.failure);
  }
  drawn.lateNow = 0;
  drawn.posed = list.ticket.posed;
  drawn.views = list.viewCount;
  drawn.frame = list.ticket.signature.frame;
  drawn.read = false;
  if (parts_.walls[wall].projection)
    for (std::uint32_t view = 0; view < list.viewCount; ++view)
      drawn.clipFromRig[view] = clipFromRig(list, view);
  drawn.totals = wallRenderer_->totals(wall);
  if (!wanted || showPattern(wall, list.ticket.presentation)) return kNoFailure;
  return readPictures(wall);
}

/// Puts the test pattern in the place of the wall's pictures. Returns false if it is not to be shown.
bool ShowStages::showPattern(std::size_t wall, const Presentation& shown) {
  const WallViews& of = parts_.walls[wall];
  if (!shown.pattern || shown.black || !parts_.patterns || of.camera) return false;
  EyePictures& pictures = pictures_[wall];
  if (!parts_.patterns->copyTo(pictures.eyes, wall, of.width, of.height, parts_.waitsForPatterns))
    return false;
  pictures.frame = drawn_[wall].frame;
  drawn_[wall].read = true;
  return true;
}

Failure ShowStages::readPictures(std::size_t wall) {
  Drawn& drawn = drawn_[wall];
  const bool projected = parts_.walls[wall].projection != nullptr;
  if (Failure f = readViews(wall, projected ? drawn.facets : pictures_[wall].eyes)) return f;
  pictures_[wall].frame = drawn.frame;
  if (projected) project(wall);
  drawn.read = true;
  return kNoFailure;
}

Failure ShowStages::readViews(std::size_t wall, std::vector<Picture>& pictures) {
  const SpanScope span(parts_.probe, Span::Read);
  pictures.resize(drawn_[wall].views);
  for (std::uint32_t view = 0; view < drawn_[wall].views; ++view) {
    Picture& p = pictures[view];
    const WallViews& of = parts_.walls[wall];
    if (p.width != of.width || p.height != of.height) p = Picture(of.width, of.height);
    if (Failure f = wallRenderer_->read(wall, view, p.rgba)) return f;
  }
  return kNoFailure;
}

/// Makes the picture of each eye from the facets' pictures.
void ShowStages::project(std::size_t wall) {
  const SpanScope span(parts_.probe, Span::Warp);
  const Drawn& drawn = drawn_[wall];
  const Projection& projection = *parts_.walls[wall].projection;
  const std::size_t facets = projection.facets().all.size(), eyes = drawn.views / facets;
  pictures_[wall].eyes.resize(eyes);
  for (std::size_t eye = 0; eye < eyes; ++eye) {
    std::array<FacetPicture, Facets::kMost> seen;
    for (std::size_t f = 0; f < facets; ++f)
      seen[f] = {drawn.clipFromRig[f * eyes + eye], &drawn.facets[f * eyes + eye]};
    projection.draw({seen.data(), facets}, pictures_[wall].eyes[eye], parts_.pool);
  }
}

void ShowStages::closeWall(std::size_t wall) {
  if (!wallRenderer_) return;
  // After a failure, or a wait that was given up, no stage knew which frame would be the last.
  const bool wanted =
      drawn_[wall].views > 0 && !drawn_[wall].read && !(parts_.controls && parts_.controls->leaving());
  if (wanted)
    if (const Failure lost = readPictures(wall); lost && parts_.tell) parts_.tell(lost->message);
  wallRenderer_->close(wall);
}

Failure ShowStages::swap(const TimeSignature& now) {
  shownFrame_ = now.frame;
  if (const auto began = began_.exchange({}); began.time_since_epoch().count() != 0)
    swaps_.note(std::chrono::steady_clock::now() - began);
  if (parts_.shown) parts_.shown();
  if (parts_.sink && parts_.sink->wants(now)) return parts_.sink->take(now, pictures_);
  return kNoFailure;
}

}  // namespace stadion
