#include "show/output/output_names.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <unistd.h>

namespace stadion {
namespace {

namespace fs = std::filesystem;

/// What a link leads to, also if that is not there yet.
fs::path targetOf(fs::path file) {
  std::error_code none;
  constexpr int kMostLinks = 40;  // as Linux follows
  for (int i = 0; i < kMostLinks && fs::is_symlink(file, none); ++i)
    file = file.parent_path() / fs::read_symlink(file, none);
  return file;
}

/// Also of files that are not there yet, by their folders.
bool isSame(const std::string& a, const std::string& b) {
  std::error_code none;
  if (fs::exists(a, none) && !fs::is_regular_file(a, none)) return false;
  if (fs::equivalent(a, b, none) && !none) return true;
  const fs::path first = fs::weakly_canonical(fs::absolute(targetOf(a), none), none);
  return !none && first == fs::weakly_canonical(fs::absolute(targetOf(b), none), none) && !none;
}

/// 0, or an errno. A file that is there need not lie in a folder of ours (/var/log/show.log).
int whyNotWritable(const fs::path& file) {
  std::error_code none;
  if (fs::is_directory(file, none)) return EISDIR;
  const bool isThere = fs::exists(file, none);
  const fs::path place = isThere ? file : file.parent_path() / ".";
  return access(place.c_str(), isThere ? W_OK : W_OK | X_OK) == 0 ? 0 : errno;
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

void refuseUnwritable(std::span<const NamedFile> files, Diagnostics& findings) {
  for (const NamedFile& f : files) {
    const int why = f.written && !f.file.empty() ? whyNotWritable(f.file) : 0;
    if (why != 0) findings.error({}, f.option + ": " + f.file + " cannot be written: " + std::strerror(why));
  }
}

}  // namespace stadion
