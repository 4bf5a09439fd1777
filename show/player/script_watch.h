#pragma once
/// Notices that a script, or a sub-scene that it names, has been saved, or is gone.
///
/// It is asked again and again, a few times a second.
///
/// Threads  one.

#include "show/base/standard_nodes.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

class ScriptWatch {
public:
  ScriptWatch(std::string script, std::vector<std::string> assetRoots, SharedTypes types);

  /// What has happened to which file since the last time it said so, in words. A file that is saved must have
  /// stayed as it is since it was asked before: an editor may write in several goes. One that is gone must be
  /// so for kGoneFor more times: an editor may put another in its place.
  std::optional<std::string> changed();
  /// What there is now counts as known.
  void settle();

  static constexpr int kGoneFor = 4;

private:
  struct Stamp {
    std::string path;
    std::filesystem::file_time_type time{};
    std::uintmax_t size = 0;
    bool operator==(const Stamp&) const = default;
  };
  using Stamps = std::map<std::string, Stamp>;  ///< by name; of files that are there

  Stamps look() const;
  bool somethingIsGone() const;
  std::string whatChanged() const;

  std::string script_;
  std::vector<std::string> assetRoots_;
  SharedTypes types_;
  std::vector<std::string> parts_;  ///< sub-scenes, as scripts name them
  Stamps known_, seen_;
  int stayedFor_ = 0;  ///< how many times it has been so
};

}  // namespace stadion
