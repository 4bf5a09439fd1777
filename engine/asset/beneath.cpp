#include "engine/asset/beneath.h"

#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>

#include <cerrno>

namespace stadion {

FileDescriptor openBeneath(int root, const std::string& path, bool folder) {
  if (path.empty() || path.find('\0') != std::string::npos) {
    errno = ENOENT;
    return FileDescriptor();
  }
  open_how how{};
  // Without O_NONBLOCK, opening a named pipe would wait for a writer.
  how.flags = O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK | (folder ? O_DIRECTORY : 0);
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  long opened = -1;
  for (int attempt = 0; attempt < 8; ++attempt) {
    opened = ::syscall(SYS_openat2, root, path.c_str(), &how, sizeof how);
    if (opened >= 0 || (errno != EAGAIN && errno != EINTR)) break;  // EAGAIN: a folder was renamed meanwhile
  }
  FileDescriptor file(static_cast<int>(opened));
  if (!file || folder) return file;
  struct stat about {};
  if (::fstat(file.get(), &about) != 0 || !S_ISREG(about.st_mode)) {
    file.close();
    errno = EINVAL;
  }
  return file;
}

}  // namespace stadion
