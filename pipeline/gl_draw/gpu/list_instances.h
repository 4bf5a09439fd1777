#pragma once
/// The instances of the draw list that is being drawn, and the buffer with their matrices.
///
/// Cull may still be filling the list. Its items are taken up as they come.
///
/// Ownership  owns the GL buffer; the list must stay until the next begin().
/// Threads    the thread on which the context is current.

#include "engine/core/frame_probe.h"
#include "pipeline/draw_list/draw_list.h"
#include "pipeline/draw_list/instance_batches.h"
#include "pipeline/gl_draw/gpu/frame_data.h"

#include <cstddef>
#include <vector>

namespace stadion {

class ListInstances {
public:
  /// `sorted`: transparent items are ordered far to near, instead of as they are listed.
  /// `ring`: where the matrices are uploaded; null = into a buffer of their own.
  ListInstances(const GlTable& gl, UploadRing* ring, bool sorted)
      : gl_(gl), sorted_(sorted), uploads_(gl, ring, GL_ARRAY_BUFFER) {}

  /// Starts with a list, of which nothing is taken up yet. `probe` gets the waits for Cull; null = none. With
  /// a probe, the owners of the instances are kept, too.
  void begin(const DrawList& list, FrameProbe* probe);
  /// Takes up the items beyond those taken before, and waits until there are some. Returns false if there are
  /// no more.
  bool takeMore();
  void takeAll() {
    while (takeMore()) {
    }
  }
  /// Returns true if the list has such an opaque batch. Waits until that is known.
  bool hasOpaque(std::size_t batch);

  const InstanceBatches& batches() const { return batches_; }

  /// Brings the buffer up to date with what was taken up.
  void upload();
  /// Points the bound vertex array at the matrices, from instance `first` on.
  void pointAt(std::uint32_t first) const;
  /// The matrices that were uploaded last.
  const FrameData& uploaded() const { return uploads_; }

private:
  const GlTable& gl_;
  bool sorted_;
  const DrawList* list_ = nullptr;
  FrameProbe* probe_ = nullptr;
  InstanceBatches batches_;
  bool complete_ = false;  ///< all is taken up
  std::size_t done_ = 0;   ///< uploaded instances
  std::vector<DrawItem> farToNear_;
  FrameData uploads_;
};

}  // namespace stadion
