#pragma once
/// The folders from which a show's assets may come; nothing outside them is opened.
///
/// Order      the script's folder, then `../assets` beside it, then the folders of `--asset-root`. The first
///            root that has the file wins.
/// Ownership  holds each folder open, so renaming one while the show runs changes nothing.
/// Threads    immutable once filled; open() may be called from any thread.

#include "engine/asset/beneath.h"
#include "engine/base/diagnostic.h"

#include <filesystem>
#include <string>
#include <vector>

namespace stadion {

class AssetRoots {
public:
  AssetRoots() = default;
  /// The roots of a script: its folder, and `../assets` beside it if there is one.
  static AssetRoots ofScript(const std::filesystem::path& script);

  /// False if it is not a folder that can be opened.
  bool add(const std::filesystem::path& folder);

  struct Found {
    int root = -1;        ///< the open folder; stays the roots' own
    FileDescriptor file;  ///< open for reading
    std::string path;     ///< as the user would write it, for messages
  };

  /// The file `name` (relative, without `..`). The error is one sentence: where it was looked for, and a name
  /// that is close.
  Result<Found> open(const std::string& name) const;

  bool empty() const { return roots_.empty(); }

private:
  struct Root {
    FileDescriptor folder;
    std::filesystem::path path;
  };
  std::string missing(const std::string& name) const;

  std::vector<Root> roots_;
};

}  // namespace stadion
