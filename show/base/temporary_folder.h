#pragma once
/// A folder that goes with its owner.

#include <cstdlib>
#include <filesystem>
#include <string>

namespace stadion {

class TemporaryFolder {
public:
  TemporaryFolder() {
    std::error_code none;
    std::string pattern = std::filesystem::temp_directory_path(none) / "stadion-XXXXXX";
    if (mkdtemp(pattern.data())) path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code none;
    if (!path_.empty()) std::filesystem::remove_all(path_, none);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  /// Returns the path of a file in the folder. (If there is no folder, writing the file fails and says so.)
  std::string path(const std::string& name) const { return path_ + "/" + name; }

private:
  std::string path_;
};

}  // namespace stadion
