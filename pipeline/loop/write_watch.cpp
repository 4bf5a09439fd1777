#include "pipeline/loop/write_watch.h"

#include "pipeline/draw_list/list_difference.h"

namespace stadion {
namespace {

std::string fieldIn(const char* what, std::string_view field) {
  return std::string(what) + ", field \"" + std::string(field) + "\"";
}

}  // namespace

WriteWatch::WriteWatch(SceneState& state, std::size_t walls) : state_(state), kept_(walls) {
  state_.guard(guard_);
}

WriteWatch::~WriteWatch() {
  state_.unguard();
}

std::optional<WrongWrite> WriteWatch::inScene(const WriteGuard::Stage& stage) const {
  const void* address = stage.written();
  if (!address) return {};
  const PublishedPlace place = state_.placeOf(address);
  return WrongWrite{fieldIn("the published scene", place.field), place.node};
}

std::optional<WrongWrite> WriteWatch::inList(std::size_t wall, const DrawList& list) const {
  const auto difference = differenceOf(kept_[wall], list);
  if (!difference) return {};
  return WrongWrite{fieldIn("the wall's draw list", difference->field), difference->node};
}

}  // namespace stadion
