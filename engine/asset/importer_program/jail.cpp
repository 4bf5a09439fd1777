#include "engine/asset/importer_program/jail.h"

#include "engine/asset/beneath.h"

#include <assimp/IOStream.hpp>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace stadion::importer {
namespace {

class MemoryFile : public Assimp::IOStream {
public:
  explicit MemoryFile(std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)) {}

  std::size_t Read(void* to, std::size_t size, std::size_t count) override {
    if (size == 0) return 0;
    const std::size_t whole = std::min(count, (bytes_.size() - at_) / size);
    if (whole > 0) std::memcpy(to, bytes_.data() + at_, whole * size);
    at_ += whole * size;
    return whole;
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    // From the end assimp means "offset back"; unsigned wrap-around of negative offsets is caught by the
    // check.
    const std::size_t base = origin == aiOrigin_CUR ? at_ : origin == aiOrigin_END ? bytes_.size() : 0;
    const std::size_t to = base + offset;
    if (to > bytes_.size()) return aiReturn_FAILURE;
    at_ = to;
    return aiReturn_SUCCESS;
  }
  std::size_t Tell() const override { return at_; }
  std::size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

private:
  std::vector<std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

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

// As exporters write them: Windows slashes, "./" and "file://" in front.
std::string plain(std::string path) {
  std::replace(path.begin(), path.end(), '\\', '/');
  if (path.starts_with("file://")) path.erase(0, 7);
  while (path.starts_with("./")) path.erase(0, 2);
  return path;
}

}  // namespace

std::optional<std::vector<std::uint8_t>> readBeneath(int root, std::string path, std::uint64_t mostBytes,
                                                     std::string* why) {
  const auto fail = [&](std::string reason) {
    if (why) *why = std::move(reason);
    return std::nullopt;
  };
  const FileDescriptor file = openBeneath(root, plain(std::move(path)));
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

void Jail::replace(std::string path, std::vector<std::uint8_t> bytes) {
  replaced_ = std::move(path);
  replacement_ = std::move(bytes);
}

bool Jail::Exists(const char* path) const {
  return path && bool(openBeneath(root_, plain(path)));
}

Assimp::IOStream* Jail::Open(const char* path, const char* mode) {
  if (!path || !mode || std::strpbrk(mode, "wa+")) return nullptr;
  if (!replaced_.empty() && replaced_ == path) return new MemoryFile(replacement_);
  auto bytes = readBeneath(root_, path, mostBytes_);
  return bytes ? new MemoryFile(std::move(*bytes)) : nullptr;
}

void Jail::Close(Assimp::IOStream* stream) {
  delete stream;
}

}  // namespace stadion::importer
