#include "pipeline/show_stages.h"

namespace stadion {
namespace {

Failure toFailure(const std::optional<Diagnostic>& d) {
  return d ? Failure(Reason(*d)) : std::nullopt;
}

/// Nothing is drawn, in front of a sky without light and without a sun.
void makeBlack(DrawList& list) {
  list.opaque.clear(), list.transparent.clear(), list.lights.clear();
  list.sky = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0};
}

}  // namespace

ShowStages::ShowStages(ShowParts parts)
    : parts_(std::move(parts)), contexts_(std::make_unique<WallContext[]>(parts_.walls.size())),
      pictures_(parts_.walls.size()) {
  for (std::size_t wall = 0; wall < parts_.walls.size(); ++wall) contexts_[wall].view = parts_.walls[wall];
}

ShowStages::~ShowStages() = default;

void ShowStages::app(const TimeSignature& now, std::size_t slot) {
  InputSample input;
  {
    const SpanScope span(parts_.probe, Span::Input);
    if (parts_.desk) parts_.input.freezeHead(parts_.desk->state().headFrozen);
    parts_.input.sampleFrame(now.time - now.step, now.time, input);
  }
  parts_.scene.advance(now, input, changes_, parts_.probe);
  {
    const SpanScope span(parts_.probe, Span::Publish);
    parts_.state.publish(slot, changes_);
    parts_.meshes.collect(shownFrame_);
  }
  tellPublished();
  if (parts_.sounds) {
    const SpanScope span(parts_.probe, Span::Sound);
    hear(input, false);
  }
  if (!parts_.observer) return;
  const SpanScope span(parts_.probe, Span::Watching);
  parts_.observer(now, input, parts_.scene);
}

/// For whom publishing was.
void ShowStages::tellPublished() {
  if (!parts_.probe || !parts_.probe->wantsShares(changes_.signature.frame, kNoWall)) return;
  std::vector<NodeRef> owners;
  for (const ChangeSet::Instance& i : changes_.instances)
    if (i.record.radius >= 0) owners.push_back(i.record.owner);
  parts_.probe->shared(Span::Publish, changes_.signature.frame, kNoWall, owners);
}

void ShowStages::hear(const InputSample& input, bool still) {
  if (!parts_.sounds) return;
  parts_.scene.listen(input, heard_);
  parts_.sounds->hear(heard_, {parts_.desk ? parts_.desk->state().volume : 1, still});
}

// The signature, sky and viewer of the last frame stay in the change set, but that the visitor looks around.
void ShowStages::still(std::size_t slot) {
  changes_.clear();
  if (parts_.desk) parts_.input.freezeHead(parts_.desk->state().headFrozen);
  InputSample now;
  if (parts_.input.sampleNow(now)) changes_.viewer.set(parts_.scene.rigPose(), parts_.scene.headInRig(now));
  hear(parts_.scene.lastInput(), true);
  parts_.state.publish(slot, changes_);
}

void ShowStages::cull(std::size_t wall, std::size_t slot, DrawList& list) {
  const Presentation& shown = list.ticket.shown;
  WallView& view = contexts_[wall].view;
  view.eyeSeparation = shown.eyeSeparation >= 0 ? shown.eyeSeparation : parts_.walls[wall].eyeSeparation;
  cullWall(parts_.state.view(slot), view, static_cast<std::uint32_t>(wall), stillCasters_, list,
           parts_.probe);
  if (view.camera) return;  // somebody else's, not the visitor's
  if (shown.swapEyes && list.eyeCount == 2) std::swap(list.eyes[0], list.eyes[1]);
  if (shown.black) makeBlack(list);
}

Failure ShowStages::openWall(std::size_t wall) {
  if (!parts_.provider) return {};
  auto target = parts_.provider->create(parts_.walls[wall].width, parts_.walls[wall].height);
  if (!target) return Reason(target.error());
  contexts_[wall].target = std::move(target.value());
  if (Failure f = enterContext(wall)) return f;
  auto renderer = Renderer::create(contexts_[wall].target->gl(), contexts_[wall].target->turns(),
                                   parts_.meshes, parts_.walls[wall].width, parts_.walls[wall].height);
  if (!renderer) return Reason(renderer.error());
  contexts_[wall].renderer = std::move(renderer.value());
  if (wall == 0) glDescription_ = describeGl(contexts_[wall].target->gl());
  return {};
}

// A thread that draws one wall enters its context once; a thread that draws all of them goes from one to the
// next.
Failure ShowStages::enterContext(std::size_t wall) {
  const std::thread::id me = std::this_thread::get_id();
  if (contexts_[wall].currentOn == me) return {};
  for (std::size_t other = 0; other < parts_.walls.size(); ++other)
    if (contexts_[other].currentOn == me) leaveContext(other);
  if (Failure f = toFailure(contexts_[wall].target->makeCurrent())) return f;
  contexts_[wall].currentOn = me;
  return {};
}

void ShowStages::leaveContext(std::size_t wall) {
  contexts_[wall].target->release();
  contexts_[wall].currentOn = std::thread::id{};
}

bool ShowStages::wantsDrawn(const FrameTicket& ticket) const {
  return parts_.drawUnseen || ticket.last || (parts_.sink && parts_.sink->wants(ticket.signature));
}

Failure ShowStages::draw(std::size_t wall, const DrawList& list) {
  if (!parts_.provider) return {};
  if (Failure f = enterContext(wall)) return f;
  WallContext& c = contexts_[wall];
  c.eyes = 0;  // until it is finished there is no picture
  if (Failure f = toFailure(c.renderer->draw(list, parts_.giveUp, parts_.probe))) return f;
  c.eyes = list.eyeCount, c.frame = list.ticket.signature.frame, c.read = false;
  const bool wanted = parts_.sink && parts_.sink->wants(list.ticket.signature);
  return wanted || list.ticket.last ? readPictures(wall) : std::nullopt;
}

Failure ShowStages::readPictures(std::size_t wall) {
  const SpanScope span(parts_.probe, Span::Read);
  WallContext& c = contexts_[wall];
  pictures_[wall].frame = c.frame;
  pictures_[wall].eyes.resize(c.eyes);
  for (std::uint32_t eye = 0; eye < c.eyes; ++eye) {
    Picture& p = pictures_[wall].eyes[eye];
    p = Picture(parts_.walls[wall].width, parts_.walls[wall].height);
    if (Failure f = toFailure(c.renderer->read(eye, p.rgba))) return f;
  }
  c.read = true;
  return {};
}

void ShowStages::closeWall(std::size_t wall) {
  WallContext& c = contexts_[wall];
  if (!c.target) return;
  if (!enterContext(wall)) {
    // After a failure, or a wait that was given up, nobody knew which frame would be the last.
    if (c.renderer && c.eyes > 0 && !c.read) readPictures(wall);
    c.renderer.reset();
    leaveContext(wall);
  }
  c.target.reset();
}

Failure ShowStages::swap(const TimeSignature& now) {
  shownFrame_ = now.frame;
  if (parts_.shown) parts_.shown();
  if (parts_.sink && parts_.sink->wants(now)) return parts_.sink->take(now, pictures_);
  return {};
}

}  // namespace stadion
