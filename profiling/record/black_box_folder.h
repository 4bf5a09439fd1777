#pragma once
/// Where runs keep their last frames if nobody names a file: stadion/last-frames in the user's folder for
/// state
/// ($XDG_STATE_HOME, else ~/.local/state); where that cannot be written, stadion-UID in the one for temporary
/// files.
///
/// A file's name begins with when its run began (UTC): the last name in the alphabet is the newest run's.
///
/// Threads    any; several programs may use it at a time.
/// Ownership  when a run begins, the newest kMost - 1 stay; older ones are removed, but none that a run still
///            writes, and nothing else that is there.

#include <filesystem>
#include <string>
#include <vector>

namespace stadion {

class BlackBoxFolder {
public:
  static constexpr std::size_t kMost = 16;

  /// The user's. Makes the folder.
  static BlackBoxFolder ofThisUser();
  explicit BlackBoxFolder(std::filesystem::path path) : path_(std::move(path)) {}

  const std::filesystem::path& path() const { return path_; }
  /// For a run that begins now: a file that is not there yet, with room made for it. (If there is no folder,
  /// making the file fails and says so.)
  std::string newFile() const;
  /// What is there, the newest first.
  std::vector<std::filesystem::path> files() const;

private:
  std::filesystem::path path_;
};

}  // namespace stadion
