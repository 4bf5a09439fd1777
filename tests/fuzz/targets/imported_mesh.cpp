#include "engine/asset/importer_answer.h"
#include "engine/asset/mesh_checks.h"
#include "engine/asset/simplify.h"
#include "tests/fuzz/targets.h"

#include <cmath>
#include <cstring>

namespace stadion::fuzz {

void imported_mesh(Bytes bytes) {
  ImporterAnswer answer;
  const auto bring = [&bytes](void* to, std::size_t size) {
    if (size > bytes.size()) return Transfer::Broken;
    if (size > 0) std::memcpy(to, bytes.data(), size);
    bytes = bytes.subspan(size);
    return Transfer::Done;
  };
  if (readAnswer(bring, answer) != Transfer::Done || answer.status != ImportStatus::Loaded) return;
  const auto mesh = decode(answer.mesh);
  if (!mesh) return;
  Mesh& m = *mesh.value();
  finish(m);
  require(std::isfinite(m.sphere.radius) && m.sphere.centre.allFinite(), "a mesh is somewhere");
  require(std::isfinite(area(m)), "a mesh has an area");
  closed(m);
  require(static_cast<bool>(decode(encode(m))), "what is written is read again");
  addLevels(m, 2);
  for (const MeshLevel& level : m.levels)
    for (const std::uint32_t index : level.indices)
      require(index < m.positions.size(), "an index is in range");
}

}  // namespace stadion::fuzz
