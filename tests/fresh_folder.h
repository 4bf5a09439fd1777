#pragma once
/// Folders for tests. A name with the process's number would not do: a test that was killed leaves its
/// folder, and a later process may have the same number.

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace stadion {

/// Makes an empty folder that no other test has; the caller removes it.
inline std::filesystem::path makeFreshFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "stadion-test-XXXXXX").string();
  if (!::mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
  return pattern;
}

/// Such a folder, removed with this object.
class FreshFolder {
public:
  FreshFolder() : path_(makeFreshFolder()) {}
  ~FreshFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  FreshFolder(const FreshFolder&) = delete;
  FreshFolder& operator=(const FreshFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
  std::filesystem::path path_;
};

}  // namespace stadion
