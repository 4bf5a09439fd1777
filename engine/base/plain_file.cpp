#include "engine/base/plain_file.h"

#include "engine/base/file_descriptor.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

namespace stadion {
namespace {

Diagnostic cannotRead(const std::string& path, const std::string& why) {
  return {Severity::Error, {path, 0, 0}, "cannot be read: " + why, {}};
}

std::string tooLarge(std::size_t limit) {
  const bool whole = limit % (std::size_t{1} << 20) == 0;
  return whole ? fmt::format("it is larger than {} MiB", limit >> 20)
               : fmt::format("it is larger than {} bytes", limit);
}

std::string refusal(const struct stat& about, std::size_t limit) {
  if (S_ISDIR(about.st_mode)) return "it is a folder";
  if (!S_ISREG(about.st_mode)) return "it is not a plain file";
  return static_cast<std::uint64_t>(about.st_size) > limit ? tooLarge(limit) : std::string();
}

}  // namespace

Result<std::string> readPlainFile(int file, const std::string& path, std::size_t limit) {
  struct stat about {};
  if (::fstat(file, &about) != 0) return cannotRead(path, std::strerror(errno));
  if (const std::string why = refusal(about, limit); !why.empty()) return cannotRead(path, why);
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(about.st_size));
  std::array<char, 1 << 16> part;
  for (;;) {
    const ssize_t got = ::read(file, part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return cannotRead(path, std::strerror(errno));
    if (got == 0) return bytes;
    // It may have grown, and files that the kernel generates on reading have no size beforehand.
    if (bytes.size() + static_cast<std::size_t>(got) > limit) return cannotRead(path, tooLarge(limit));
    bytes.append(part.data(), static_cast<std::size_t>(got));
  }
}

Result<std::string> readPlainFile(const std::string& path, std::size_t limit) {
  // Without O_NONBLOCK, opening a named pipe would wait for a writer.
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK));
  if (!file) return cannotRead(path, std::strerror(errno));
  return readPlainFile(file.get(), path, limit);
}

}  // namespace stadion
