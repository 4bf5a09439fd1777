#include "pipeline/cluster/compatibility_key.h"

#include "engine/core/state_hash.h"
#include "engine/plain_text/text_line.h"
#include "pipeline/cluster/session_rules.h"

#include <fmt/format.h>

#include <cstring>

namespace stadion::cluster {

std::uint64_t CompatibilityKey::show() const {
  StateHash hash;
  hash.add(script);
  hash.add(input);
  return hash.value();
}

std::uint64_t hashOf(const ClusterFile& file) {
  StateHash hash;
  for (const ClusterNode& node : file.nodes) {
    hash.add(std::string_view(node.name));
    hash.add(std::uint64_t{node.walls.size()});
    for (const std::string& wall : node.walls) hash.add(std::string_view(wall));
  }
  hash.add(std::uint64_t{file.lead});
  hash.add(file.deadline);
  hash.add(file.hashEvery);
  hash.add(file.stopOnDifference);
  return hash.value();
}

stadion_wire_CompatibilityKey written(const CompatibilityKey& a) {
  stadion_wire_CompatibilityKey w{a.script, a.input, a.cluster, a.walls, {}, {}};
  a.plugins.copy(w.plugins, sizeof(w.plugins) - 1);
  a.pictures.copy(w.pictures, sizeof(w.pictures) - 1);
  return w;
}

CompatibilityKey read(const stadion_wire_CompatibilityKey& w) {
  return {w.script,
          w.input,
          w.cluster,
          w.walls,
          std::string(w.pictures, strnlen(w.pictures, sizeof(w.pictures))),
          std::string(w.plugins, strnlen(w.plugins, sizeof(w.plugins)))};
}

std::string refusal(const CompatibilityKey& lead, const CompatibilityKey& ours,
                    const std::string& nameOfLead) {
  const char* what = lead.script != ours.script                    ? "plays another script"
                     : lead.cluster != ours.cluster                ? "has another cluster file"
                     : lead.walls != ours.walls                    ? "has another wall file"
                     : lead.input != 0 && lead.input != ours.input ? "plays another input log"
                                                                   : nullptr;
  if (what) return fmt::format("{} {}; put the same file on all machines", nameOfLead, what);
  if (lead.plugins == ours.plugins) return {};
  const auto words = [](const std::string& plugins) {
    return plugins.empty() ? "no plugins" : "the plugins " + printable(plugins, kMaxRemoteText);
  };
  return fmt::format("{} plays with {}, we with {}; load the same plugins on all machines", nameOfLead,
                     words(lead.plugins), words(ours.plugins));
}

std::string remark(const CompatibilityKey& lead, const CompatibilityKey& ours,
                   const std::string& nameOfLead) {
  if (lead.pictures == ours.pictures) return {};
  return fmt::format("{} plays with {}, we with {}: the walls will not look alike", nameOfLead,
                     printable(lead.pictures, kMaxRemoteText), ours.pictures);
}

std::string inTheWay(const ClusterFile& ours) {
  return fmt::format("another cluster plays in the same network, with domain {} and partition {}, too; give "
                     "each a partition "
                     "of its own; this program ends",
                     ours.domain, ours.partition);
}

}  // namespace stadion::cluster
