#include "pipeline/gl_draw/gpu/list_instances.h"

#include "pipeline/draw_list/list_filling.h"
#include "pipeline/gl_draw/gpu/mesh_cache.h"

#include <algorithm>
#include <functional>

namespace stadion {

void ListInstances::begin(const DrawList& list, FrameProbe* probe) {
  list_ = &list;
  probe_ = probe;
  complete_ = false;
  done_ = 0;
  batches_.begin(probe != nullptr);
}

bool ListInstances::takeMore() {
  if (complete_) return false;
  std::size_t there = ListFilling::kAll;
  if (list_->filling) {
    const SpanScope span(probe_, Span::ForDraw, list_->ticket.signature.frame, list_->wall);
    there = list_->filling->await(batches_.taken());
  }
  complete_ = there == ListFilling::kAll;
  if (complete_ && list_->filling && list_->filling->isVoid()) return false;  // the picture is not shown
  batches_.addOpaque(list_->opaque, std::min(there, list_->opaque.size()));
  if (complete_ && !sorted_) batches_.addTransparent(list_->transparent);
  if (complete_ && sorted_) {
    farToNear_ = list_->transparent;
    std::ranges::stable_sort(farToNear_, std::greater<>{}, &DrawItem::distance);
    batches_.addTransparent(farToNear_);
  }
  return true;
}

bool ListInstances::hasOpaque(std::size_t batch) {
  while (batch >= batches_.opaque().size())
    if (!takeMore()) return false;
  return true;
}

void ListInstances::upload() {
  const std::span<const InstanceMatrix> all = batches_.matrices();
  if (done_ == all.size()) return;
  if (complete_ && done_ == 0) {
    uploads_.fill(all);
  } else {
    const std::size_t most = list_->opaque.size() + list_->transparent.size();
    if (done_ == 0) uploads_.reserve(most * sizeof(InstanceMatrix));
    uploads_.write(done_ * sizeof(InstanceMatrix), std::as_bytes(all.subspan(done_)));
  }
  done_ = all.size();
}

void ListInstances::pointAt(std::uint32_t first) const {
  pointAtInstances(gl_, uploads_, first);
}

}  // namespace stadion
