#include "engine/display/frustum.h"
#include "engine/display/unfolding.h"
#include "engine/display/wall_lint.h"
#include "tests/fuzz/targets.h"

namespace stadion::fuzz {

void walls(Bytes bytes) {
  Diagnostics findings;
  const auto room = parseWalls(asText(bytes), "any.walls", findings);
  require(room.has_value() || findings.hasErrors(), "what is refused has a reason");
  if (room) {
    lintWalls(*room, findings);
    Diagnostics again;
    require(parseWalls(formatWalls(*room), "again.walls", again).has_value(),
            "what is written is read again");
    const bool stands = !findings.hasErrors();
    if (stands) {
      floorPlan(*room);
      require(unfold(room->walls, 640, 480).size() == room->walls.size(), "each wall has its place");
    }
    for (const WallEntry& entry : room->walls) {
      if (entry.output) pictureFromOutput(entry.output->shape);
      if (!stands) continue;
      const EyeFrustum f = eyeFrustum(entry.wall, kStandingEye, room->depth);
      require(projectionMatrix(f).allFinite() && f.eye.allFinite(), "a frustum has numbers");
    }
  }
  for (const Diagnostic& d : findings.all()) require(!format(d).empty(), "a finding says something");
}

}  // namespace stadion::fuzz
