#pragma once
/// What the nodes of a show are called and where they are declared, also of those that have been unloaded.
///
/// Threads  told on the App thread, read when the run is over.

#include "engine/scene/scene.h"

#include <map>
#include <string>
#include <vector>

namespace stadion {

class NodeNames {
public:
  /// After each App stage; looks at what has been loaded since the last time.
  void see(const Scene& scene);

  /// Its path and its line: "discus/take scripts/game_discus.evs:15"; of a node without a name its kind
  /// stands in brackets.
  std::string of(NodeRef node) const;

private:
  struct File {
    std::string name,
        path;  ///< path: of the scene node that loaded it, with a slash; empty of the show's own
    std::vector<std::uint32_t> lines;
    std::vector<std::string> called;  ///< by position
  };
  void learn(const Load& load);

  std::map<std::uint32_t, File> files_;  ///< by load number
  std::uint64_t version_ = ~std::uint64_t{0};
};

}  // namespace stadion
