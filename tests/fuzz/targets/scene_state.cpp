#include "engine/scene/scene_snapshot.h"
#include "tests/fuzz/built_show.h"
#include "tests/fuzz/targets.h"

#include <array>

namespace stadion::fuzz {
namespace {

std::unique_ptr<BuiltShow> playing(const Workshop& workshop, const FuzzedShow& which) {
  auto show = std::make_unique<BuiltShow>(workshop, which);
  show->open(), show->play(30);
  return show;
}

}  // namespace

/// The first byte says whose state it is. A follower's scene takes it over, and one that plays already is
/// compared with it. Only a scene without bodies goes on. A restored world is checked for being one, but the
/// motion of bodies in impossible places is not promised (SECURITY.md).
void scene_state(Bytes bytes) {
  if (bytes.empty()) return;
  static const Workshop workshop;
  const std::size_t which = bytes[0] % std::size(kShows);
  bytes = bytes.subspan(1);
  static std::array<std::unique_ptr<BuiltShow>, std::size(kShows)> shows;
  if (!shows[which]) shows[which] = playing(workshop, kShows[which]);
  BuiltShow joining(workshop, kShows[which]);
  if (!SceneSnapshot(joining.scene()).restore(bytes, std::string(kShows[which].name))) {
    require(!SceneSnapshot(joining.scene()).difference(SceneSnapshot(joining.scene()).save()),
            "what is written down is what is there");
    if (!kShows[which].bodies) joining.goOn();
  }
  const auto differs = SceneSnapshot(shows[which]->scene()).difference(bytes);
  require(!differs || !differs->field.empty(), "a difference has a name");
}

}  // namespace stadion::fuzz
