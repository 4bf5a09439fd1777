#include "pipeline/cluster/cluster_file.h"

#include "tests/fuzz/targets.h"

namespace stadion::fuzz {

void cluster_file(Bytes bytes) {
  Diagnostics findings;
  const auto cluster = parseCluster(asText(bytes), "any.cluster", findings);
  require(cluster.has_value() || findings.hasErrors(), "what is refused has a reason");
  if (cluster) {
    require(cluster->lead < cluster->nodes.size(), "somebody leads");
    checkWalls(*cluster, {"front", "left", "right", "floor"}, findings);
  }
  for (const Diagnostic& d : findings.all()) require(!format(d).empty(), "a finding says something");
}

}  // namespace stadion::fuzz
