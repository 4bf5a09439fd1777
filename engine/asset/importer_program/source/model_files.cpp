#include "engine/asset/importer_program/source/model_files.h"

#include "engine/asset/beneath.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace stadion::importer {
namespace {

bool readInto(int file, std::vector<std::uint8_t>& bytes) {
  std::size_t have = 0;
  while (have < bytes.size()) {
    const ssize_t got = ::read(file, bytes.data() + have, bytes.size() - have);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return false;
    if (got == 0) break;  // the file has become shorter meanwhile
    have += static_cast<std::size_t>(got);
  }
  bytes.resize(have);
  return true;
}

}  // namespace

std::string plainPath(std::string path) {
  std::replace(path.begin(), path.end(), '\\', '/');
  if (path.starts_with("file://")) path.erase(0, 7);
  while (path.starts_with("./")) path.erase(0, 2);
  return path;
}

std::optional<std::vector<std::uint8_t>> readBeneath(int root, std::string path, std::uint64_t mostBytes,
                                                     std::string* why) {
  const auto fail = [&](std::string reason) {
    if (why) *why = std::move(reason);
    return std::nullopt;
  };
  const FileDescriptor file = openBeneath(root, plainPath(std::move(path)));
  if (!file && errno == EXDEV) return fail("lies outside the asset folder");
  if (!file && errno == EINVAL) return fail("is not a regular file");
  if (!file)
    return fail(errno == ENOENT ? "is missing" : std::string("cannot be opened: ") + std::strerror(errno));
  struct stat about {};
  if (::fstat(file.get(), &about) != 0) return fail("cannot be read");
  if (static_cast<std::uint64_t>(about.st_size) > mostBytes)
    return fail("is larger than a show's files may be");
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(about.st_size));
  if (!readInto(file.get(), bytes)) return fail("cannot be read");
  return bytes;
}

}  // namespace stadion::importer
