#include "cli/output_names.h"

#include <filesystem>

namespace stadion {
namespace {

namespace fs = std::filesystem;

/// Also of files that are not there yet, by their folders.
bool isSame(const std::string& a, const std::string& b) {
  std::error_code none;
  if (fs::exists(a, none) && !fs::is_regular_file(a, none)) return false;
  if (fs::equivalent(a, b, none) && !none) return true;
  const fs::path first = fs::weakly_canonical(fs::absolute(a, none), none);
  return !none && first == fs::weakly_canonical(fs::absolute(b, none), none) && !none;
}

}  // namespace

void refuseSameFiles(std::span<const NamedFile> files, Diagnostics& findings) {
  for (std::size_t i = 0; i < files.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const NamedFile &one = files[k], &other = files[i];
      if (one.file.empty() || other.file.empty() || (!one.written && !other.written)) continue;
      if (!isSame(one.file, other.file)) continue;
      findings.error({}, one.option + " and " + other.option + " name the same file, " + other.file +
                             ", and only one of them would be left; name another");
      break;
    }
}

}  // namespace stadion
