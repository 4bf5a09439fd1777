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
  uploaded_ = 0;
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
  if (uploaded_ == all.size()) return;
  if (complete_ && uploaded_ == 0) {
    stream(gl_, GL_ARRAY_BUFFER, buffer_, all);
  } else {
    const auto bytes = [](std::size_t instances) {
      return static_cast<GLsizeiptr>(instances * sizeof(InstanceMatrix));
    };
    gl_.BindBuffer(GL_ARRAY_BUFFER, buffer_.name());
    const std::size_t most = list_->opaque.size() + list_->transparent.size();
    if (uploaded_ == 0) gl_.BufferData(GL_ARRAY_BUFFER, bytes(most), nullptr, GL_STREAM_DRAW);
    gl_.BufferSubData(GL_ARRAY_BUFFER, bytes(uploaded_), bytes(all.size() - uploaded_),
                      all.data() + uploaded_);
  }
  uploaded_ = all.size();
}

void ListInstances::pointAt(std::uint32_t first) const {
  pointAtInstances(gl_, buffer_, first);
}

}  // namespace stadion
