#include "show/console/show_cues.h"

#include "engine/nodes/cue_node.h"

#include <algorithm>

namespace stadion {

std::string ShowCue::text() const {
  const std::string& what = label.empty() ? name : label;
  return what.empty() ? std::to_string(number) : std::to_string(number) + " (" + what + ")";
}

std::vector<ShowCue> cuesOf(const Scene& scene) {
  std::vector<ShowCue> cues;
  scene.tree().forEachNode([&](const Node& node) {
    if (node.kind() != "cue") return;
    const auto& cue = static_cast<const CueNode&>(node);
    cues.push_back({cue.number(), cue.name(), cue.label()});
  });
  std::ranges::stable_sort(cues, {}, &ShowCue::number);
  return cues;
}

}  // namespace stadion
