#pragma once
/// Notices that a show's script, or a sub-scene, model, sound or table that its scripts name, was saved or removed.
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

  /// Returns a description of what happened to which file since the last description. A file counts as saved
  /// if it did not change since the call before: an editor may write in several steps. A file counts as gone
  /// after kGoneFor more calls: an editor may put another in its place.
  std::optional<std::string> changed();
  /// Takes the present files as known.
  void reset();

  static constexpr int kGoneFor = 4;

private:
  struct Stamp {
    std::string path;
    std::filesystem::file_time_type time{};
    std::uintmax_t size = 0;
    bool operator==(const Stamp&) const = default;
  };
  using Stamps = std::map<std::string, Stamp>;  ///< by name; of files that are there

  Stamps readStamps() const;
  bool somethingIsGone() const;
  std::string whatChanged() const;

  std::string script_;
  std::vector<std::string> assetRoots_;
  SharedTypes types_;
  std::vector<std::string> parts_;   ///< sub-scenes, as scripts name them
  std::vector<std::string> assets_;  ///< paths of the other files that scripts name
  Stamps known_, seen_;
  int stayedFor_ = 0;  ///< how many times it has been so
};

}  // namespace stadion
