#pragma once
/// The folder for the last frames of runs without a named file: stadion/last-frames in the user's state
/// folder ($XDG_STATE_HOME, else ~/.local/state). If that cannot be written, it is stadion-UID in the folder
/// for temporary files.
///
/// A file's name begins with the start of its run (UTC), so the alphabetically last name belongs to the
/// newest run.
///
/// Threads    any; several programs may use it at a time.
/// Ownership  When a run begins, the newest kMost - 1 files stay. Older ones are removed, except those that a
///            run still writes, and except other files.

#include <filesystem>
#include <string>
#include <vector>

namespace stadion {

class BlackBoxFolder {
public:
  static constexpr std::size_t kMost = 16;

  /// Returns the user's folder, and creates it if needed.
  static BlackBoxFolder ofThisUser();
  explicit BlackBoxFolder(std::filesystem::path path) : path_(std::move(path)) {}

  const std::filesystem::path& path() const { return path_; }
  /// Returns a new file name for a run that begins now, and removes old files. (If there is no folder,
  /// creating the file fails and says so.)
  std::string newFile() const;
  /// Returns the existing files, the newest first.
  std::vector<std::filesystem::path> files() const;

private:
  std::filesystem::path path_;
};

}  // namespace stadion
