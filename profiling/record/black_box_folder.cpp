#include "profiling/record/black_box_folder.h"

#include "engine/base/folder_names.h"
#include "profiling/record/black_box.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <unistd.h>

namespace stadion {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".frames";

/// Returns an absolute path from the environment; empty if it is not set.
fs::path named(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value == '/' ? fs::path(value) : fs::path();
}

fs::path stateFolder() {
  if (fs::path state = named("XDG_STATE_HOME"); !state.empty()) return state;
  const fs::path home = named("HOME");
  return home.empty() ? home : home / ".local/state";
}

fs::path temporaryFolder() {
  std::error_code none;
  const fs::path folder = fs::temp_directory_path(none);
  if (!none) return folder;
  const fs::path asked = named("TMPDIR");
  return asked.empty() ? "/tmp" : asked;
}

/// "2026-11-23T07-45-12.123456Z-4711"
std::string nameNow() {
  const auto now = std::chrono::floor<std::chrono::microseconds>(std::chrono::system_clock::now());
  const auto whole = std::chrono::floor<std::chrono::seconds>(now);
  return fmt::format("{:%Y-%m-%dT%H-%M-%S}.{:06}Z-{}",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(whole)), (now - whole).count(),
                     getpid());
}

}  // namespace

BlackBoxFolder BlackBoxFolder::ofThisUser() {
  std::error_code wrong;
  if (fs::path state = stateFolder(); !state.empty()) {
    state /= "stadion/last-frames";
    fs::create_directories(state, wrong);
    if (access(state.c_str(), R_OK | W_OK | X_OK) == 0) return BlackBoxFolder(state);
  }
  const fs::path temporary = temporaryFolder() / fmt::format("stadion-{}", getuid());
  if (fs::create_directory(temporary, wrong)) fs::permissions(temporary, fs::perms::owner_all, wrong);
  return BlackBoxFolder(temporary);
}

std::string BlackBoxFolder::newFile() const {
  const std::vector<fs::path> there = files();
  for (std::size_t i = kMost - 1; i < there.size(); ++i) BlackBox::remove(there[i]);
  const std::string stem = nameNow();
  fs::path file = path_ / (stem + kEnding);
  std::error_code none;
  for (int n = 2; fs::exists(fs::symlink_status(file, none)); ++n)
    file = path_ / fmt::format("{}-{}{}", stem, n, kEnding);
  return file.string();
}

std::vector<fs::path> BlackBoxFolder::files() const {
  std::vector<fs::path> all;
  for (const std::string& name : namesIn(path_.string()))
    if (name.ends_with(kEnding)) all.push_back(path_ / name);
  std::ranges::sort(all, std::ranges::greater());
  return all;
}

}  // namespace stadion
