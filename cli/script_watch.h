#pragma once
/// Notices that a script, or a sub-scene that it names, has been saved.
///
/// Threads  one.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace stadion {

class ScriptWatch {
public:
  ScriptWatch(std::string script, std::vector<std::string> assetRoots);

  /// Whether a file has changed since the last time it said so, and has stayed as it is since it was asked
  /// before: an editor may write in several goes.
  bool changed();
  /// What there is now counts as known.
  void settle();

private:
  struct Stamp {
    std::filesystem::file_time_type time{};
    std::uintmax_t size = 0;
    bool operator==(const Stamp&) const = default;
  };
  using Stamps = std::map<std::string, Stamp>;

  Stamps look() const;
  void findFiles();

  std::string script_;
  std::vector<std::string> assetRoots_, files_;
  Stamps known_, seen_;
};

}  // namespace stadion
