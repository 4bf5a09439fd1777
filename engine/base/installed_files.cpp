#include "engine/base/installed_files.h"

#include <cstdlib>
#include <optional>
#include <sstream>

namespace stadion {
namespace {

namespace fs = std::filesystem;

/// A checkout's program lies in build/PRESET/bin, an installed one in bin.
constexpr int kMostLevels = 4;

bool isThere(const fs::path& path) {
  std::error_code unknown;
  return fs::exists(path, unknown);
}

bool holdsWalls(const fs::path& folder) {
  return isThere(folder / "walls" / "cave4.walls");
}

fs::path folderOfProgram() {
  std::error_code unknown;
  return fs::read_symlink("/proc/self/exe", unknown).parent_path();
}

/// Nothing if no folder of PATH has a `stadion`.
std::optional<fs::path> folderInPath() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  std::error_code unknown;
  for (std::string folder; std::getline(folders, folder, ':');)
    if (!folder.empty() && fs::is_regular_file(fs::path(folder) / "stadion", unknown))
      return fs::canonical(fs::path(folder) / "stadion", unknown).parent_path();
  return {};
}

/// Of a folder with programs, or one above it.
std::optional<fs::path> shareAbove(fs::path folder) {
  for (int level = 0; level < kMostLevels && !folder.empty(); ++level, folder = folder.parent_path())
    for (const fs::path& candidate : {folder / "share" / "stadion", folder})
      if (holdsWalls(candidate)) return candidate;
  return {};
}

std::optional<fs::path> programNear(const fs::path& folder, const std::string& name) {
  const fs::path above = folder.parent_path();
  for (const fs::path& candidate :
       {folder / name, above / "lib" / "stadion" / name, above.parent_path() / "bin" / name})
    if (isThere(candidate)) return candidate;
  return {};
}

}  // namespace

std::string shareFolder() {
  if (const char* named = std::getenv("STADION_SHARE"); named && *named) return named;
  if (const auto share = shareAbove(folderOfProgram())) return share->string();
  const auto other = folderInPath();
  const auto share = other ? shareAbove(*other) : std::nullopt;
  return share ? share->string() : "";
}

fs::path helperProgram(const std::string& name) {
  if (const char* named = std::getenv("STADION_PROGRAMS"); named && *named) return fs::path(named) / name;
  if (const auto program = programNear(folderOfProgram(), name)) return *program;
  const auto other = folderInPath();
  const auto program = other ? programNear(*other, name) : std::nullopt;
  return program.value_or(fs::path(name));
}

}  // namespace stadion
