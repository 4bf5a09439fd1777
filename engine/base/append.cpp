#include "engine/base/append.h"

#include <cerrno>
#include <sys/stat.h>
#include <unistd.h>

namespace stadion {

int appendWhole(int file, std::string_view text) {
  struct stat before {
  }, now{};
  if (fstat(file, &before) != 0) return errno;
  off_t added = 0;
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written > 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
      added += written;
      continue;
    }
    if (written < 0 && errno == EINTR) continue;
    const int why = written < 0 ? errno : ENOSPC;
    // Keeps text that another process has added behind it.
    if (fstat(file, &now) == 0 && now.st_size == before.st_size + added)
      (void)!ftruncate(file, before.st_size);
    return why;
  }
  return 0;
}

}  // namespace stadion
