#pragma once
/// Which machine of which cluster this process is.

#include <cstdint>
#include <string>

namespace stadion {

struct ClusterSettings {
  std::string file;                   ///< empty: one machine plays the show
  std::string node;                   ///< the name of this machine in the file
  bool isChecked = false;             ///< the parent process has warned of what is odd in the file
  std::uint64_t plantDifference = 0;  ///< for tests: after this frame a bit of the scene is changed; 0: never
};

}  // namespace stadion
