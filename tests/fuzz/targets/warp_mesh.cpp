#include "engine/hall_formats/warp_mesh_file.h"
#include "tests/fuzz/targets.h"

namespace stadion::fuzz {

void warp_mesh(Bytes bytes) {
  static constexpr const char* kNames[] = {"a.data",   "a.obj",     "a.pfm", "a.csv",
                                           "a.simcad", "a.skyskan", "a.ol",  "a.sgc"};
  if (bytes.empty()) return;
  Diagnostics findings;
  const auto file =
      readWarpFile(asText(bytes.subspan(1)), kNames[bytes[0] % std::size(kNames)], 1.5, findings);
  require(file.has_value() || findings.hasErrors(), "what is refused has a reason");
  for (const Diagnostic& d : findings.all()) require(!format(d).empty(), "a finding says something");
  if (!file) return;
  if (const auto grid = sampleWarp(file->mesh, 16, 12)) lightOf(*grid);
}

}  // namespace stadion::fuzz
