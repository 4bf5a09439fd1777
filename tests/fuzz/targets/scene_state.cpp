#include "tests/fuzz/built_show.h"
#include "tests/fuzz/targets.h"

namespace stadion::fuzz {

/// A follower's scene takes the state over, and one that plays already is compared with it.
void scene_state(Bytes bytes) {
  static const Workshop workshop;
  BuiltShow joining(workshop);
  if (joining.scene().restore(bytes)) {
    require(!joining.scene().difference(joining.scene().save()), "what is written down is what is there");
    joining.goOn();
  }
  static BuiltShow* const playing = [] {
    auto* show = new BuiltShow(workshop);
    show->open(), show->play(30);
    return show;
  }();
  const auto differs = playing->scene().difference(bytes);
  require(!differs || !differs->field.empty(), "a difference has a name");
}

}  // namespace stadion::fuzz
