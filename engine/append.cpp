#include "engine/append.h"

#include <cerrno>
#include <sys/stat.h>
#include <unistd.h>

namespace stadion {

int appendWhole(int file, std::string_view text) {
  struct stat before {};
  if (fstat(file, &before) != 0) return errno;
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written > 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
      continue;
    }
    if (written < 0 && errno == EINTR) continue;
    const int why = written < 0 ? errno : ENOSPC;
    (void)!ftruncate(file, before.st_size);
    return why;
  }
  return 0;
}

}  // namespace stadion
