#pragma once
/// Publishes what changed in a frame: fills the ChangeSet from which the later stages draw.
///
/// Frames     World.
/// Ownership  borrows its collaborators; the ChangeSet is the caller's.
/// Threads    App only; the later stages see the ChangeSet's records alone.
/// Errors     none. Chunks beyond kMostChunks are not shown: the scene promotes their objects.

#include "engine/published/paint_table.h"
#include "engine/published/records.h"
#include "engine/published/shadow_places.h"
#include "engine/scene/degradation.h"
#include "engine/scene/figure_records.h"
#include "engine/scene/input_feed.h"
#include "engine/scene/instances.h"
#include "engine/scene/lights.h"
#include "engine/scene/loaded_scene.h"

#include <cstddef>
#include <vector>

namespace stadion {

class Publisher {
public:
  Publisher(Placements& placements, Instances& instances, FigureRecords& figures, PaintTable& paints,
            Lights& lights, const Degradation& degradation, const InputFeed& feed)
      : placements_(placements), instances_(instances), figures_(figures), paints_(paints), lights_(lights),
        degradation_(degradation), feed_(feed) {}

  /// Shows the load's chunk if there is room for it.
  void showChunk(LoadedScene& load);
  void hideChunk(const LoadedScene& load);
  /// The object of the chunk is no longer shown by it.
  void hideStatic(ChunkId chunk, std::uint32_t index) { statics_.push_back({chunk, index, true}); }

  /// Fills `changes` with all changes since the last call.
  void publish(const TimeSignature& now, const InputSample& input, ChangeSet& changes);
  /// Sets the viewer and the shadow rings alone.
  void updateViewer(const InputSample& input, ChangeSet& changes) const;
  /// Moves the shadow rings that the head at p_WH left behind.
  void follow(const Vec3& p_WH) { shadows_.follow(p_WH); }

  /// Shows a restored load's chunk again.
  void resumeChunk(const LoadedScene& load);
  void stateOfChunks(StateFields& f);
  void stateOfShadows(StateFields& f);

private:
  Placements& placements_;
  Instances& instances_;
  FigureRecords& figures_;
  PaintTable& paints_;
  Lights& lights_;
  const Degradation& degradation_;
  const InputFeed& feed_;
  ShadowPlaces shadows_;
  std::size_t chunksShown_ = 0;
  std::vector<ChangeSet::Chunk> chunks_;        ///< changes of this frame
  std::vector<ChangeSet::StaticItem> statics_;  ///< changes of this frame
};

}  // namespace stadion
