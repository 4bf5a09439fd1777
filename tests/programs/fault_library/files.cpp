/// Disks that are full, slow or broken, and reads that give less than was asked for.

#include "tests/programs/fault_library/fault.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <ctime>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

namespace {

/// What happens to reads, or to writes.
struct FileFault {
  explicit FileFault(const char* kind) : fault(kind) {}

  const stadion::Fault fault;
  const long most = fault.number(" most=", 0), after = fault.number(" after=", 0);
  const long delay = fault.number(" delay=", 0);
  const int error = static_cast<int>(fault.number(" error=", 0));
  std::atomic<long> done = 0;  ///< bytes

  bool concerns(int file) const {
    if (!fault) return false;
    char link[64], path[4096];
    std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    const ssize_t length = ::readlink(link, path, sizeof path - 1);
    if (length <= 0 || path[0] != '/') return false;
    path[length] = 0;
    return fault.concerns(path);
  }
  /// How many of the bytes there are now; none: the error has been set.
  std::size_t allowed(std::size_t bytes) const {
    if (delay > 0) {
      const timespec pause{delay / 1000, delay % 1000 * 1'000'000};
      ::nanosleep(&pause, nullptr);
    }
    if (most > 0) bytes = std::min(bytes, static_cast<std::size_t>(most));
    if (error == 0) return bytes;
    const long left = after - done;
    if (left <= 0) return errno = error, 0;
    return std::min(bytes, static_cast<std::size_t>(left));
  }
};

FileFault& reads() {
  static FileFault fault("read");
  return fault;
}
FileFault& writes() {
  static FileFault fault("write");
  return fault;
}

template <class Function>
Function real(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

template <class Transfer>
ssize_t faulty(FileFault& fault, int file, std::size_t bytes, const Transfer& transfer) {
  if (bytes == 0 || !fault.concerns(file)) return transfer(bytes);
  const std::size_t now = fault.allowed(bytes);
  if (now == 0) return -1;
  const ssize_t done = transfer(now);
  if (done > 0) fault.done += done;
  return done;
}

}  // namespace

extern "C" {

ssize_t read(int file, void* to, std::size_t bytes) {
  static const auto call = real<decltype(&read)>("read");
  return faulty(reads(), file, bytes, [&](std::size_t n) { return call(file, to, n); });
}

ssize_t pread(int file, void* to, std::size_t bytes, off_t at) {
  static const auto call = real<decltype(&pread)>("pread");
  return faulty(reads(), file, bytes, [&](std::size_t n) { return call(file, to, n, at); });
}

// What another process sends comes in pieces, too.
ssize_t recv(int socket, void* to, std::size_t bytes, int flags) {
  static const auto call = real<decltype(&recv)>("recv");
  const auto most = static_cast<std::size_t>(reads().fault ? reads().most : 0);
  return call(socket, to, most > 0 ? std::min(bytes, most) : bytes, flags);
}

ssize_t write(int file, const void* from, std::size_t bytes) {
  static const auto call = real<decltype(&write)>("write");
  return faulty(writes(), file, bytes, [&](std::size_t n) { return call(file, from, n); });
}

// Room that is taken beforehand.
int posix_fallocate(int file, off_t at, off_t bytes) {
  static const auto call = real<decltype(&posix_fallocate)>("posix_fallocate");
  const auto wanted = static_cast<std::size_t>(bytes);
  if (wanted > 0 && writes().concerns(file) && writes().allowed(wanted) < wanted) return writes().error;
  return call(file, at, bytes);
}

// The C library's own buffers are written without write(): what is put into them counts as written.
std::size_t fwrite(const void* from, std::size_t size, std::size_t count, std::FILE* to) {
  static const auto call = real<decltype(&fwrite)>("fwrite");
  if (!writes().fault || to == stdout || to == stderr) return call(from, size, count, to);
  const auto bytes = static_cast<ssize_t>(size * count);
  const ssize_t done = faulty(writes(), ::fileno(to), size * count,
                              [&](std::size_t n) { return static_cast<ssize_t>(call(from, 1, n, to)); });
  if (done < bytes) errno = writes().error;
  return done < 0 || size == 0 ? 0 : static_cast<std::size_t>(done) / size;
}

}  // extern "C"
