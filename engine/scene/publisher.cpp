#include "engine/scene/publisher.h"

#include "engine/core/state_fields.h"

namespace stadion {

void Publisher::showChunk(LoadedScene& load) {
  if (load.chunk == kNoChunk || chunksShown_ >= kMostChunks) return;
  chunks_.push_back({load.chunk, true});
  load.chunkShown = true;
  ++chunksShown_;
}

void Publisher::hideChunk(const LoadedScene& load) {
  if (load.chunkShown) {
    chunks_.push_back({load.chunk, false});
    --chunksShown_;
  }
  std::erase_if(statics_, [&](const ChangeSet::StaticItem& s) { return s.chunk == load.chunk; });
}

void Publisher::resumeChunk(const LoadedScene& load) {
  if (load.chunkShown && load.chunk != kNoChunk) chunks_.push_back({load.chunk, true});
}

void Publisher::publish(const TimeSignature& now, const InputSample& input, ChangeSet& changes) {
  changes.clear();
  changes.signature = now;
  changes.chunks.swap(chunks_);
  changes.statics.swap(statics_);
  // An instance that only moved needs no mark. All others are marked, so that each is published once.
  for (const PlacementId p : placements_.takeChanged()) {
    instances_.publishAt(p, degradation_, changes);
    lights_.moved(p);
  }
  placements_.takeMovedFleets([&](std::span<const PlacementId> ids, std::span<const MemberPlace> places) {
    lights_.moved(ids);
    instances_.publishFleet(ids, places, degradation_, changes);
  });
  instances_.publishMarked(degradation_, changes);
  figures_.publish(changes);
  paints_.publish(changes);
  if (lights_.due()) lights_.publish(feed_.rigPose() * feed_.headInRig(input).p, changes);
  changes.sky = lights_.skyRecord();
  updateViewer(input, changes);
  changes.viewer.poseTime = input.time;
  changes.viewer.stress = degradation_.stress();
}

void Publisher::updateViewer(const InputSample& input, ChangeSet& changes) const {
  changes.viewer.set(feed_.rigPose(), feed_.headInRig(input));
  ShadowPlaces rings = shadows_;
  changes.shadows = rings.follow(changes.viewer.headInWorld());
}

void Publisher::stateOfChunks(StateFields& f) {
  f("chunks shown", chunksShown_);
}

void Publisher::stateOfShadows(StateFields& f) {
  f("shadow rings", shadows_);
}

}  // namespace stadion
