#include "engine/atomic_file.h"

#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace stadion {
namespace {

/// A name that no other writer of this machine uses at the same time.
std::string temporaryFor(const std::string& path) {
  static std::atomic<unsigned> counter{0};
  const std::filesystem::path target(path);
  const std::string name = fmt::format(".{}.{}-{}.part", target.filename().string().substr(0, 200), getpid(),
                                       counter.fetch_add(1));
  return (target.parent_path() / name).string();
}

}  // namespace

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)) {
  struct stat status {};
  const bool exists = stat(path_.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) {
    fail("it is a folder");
    return;
  }
  const bool direct = exists && !S_ISREG(status.st_mode);
  if (!direct) temporary_ = temporaryFor(path_);
  file_ = std::fopen((direct ? path_ : temporary_).c_str(), "wbe");
  if (!file_) {
    const int reason = errno;
    temporary_.clear();
    fail(std::strerror(reason));
  }
}

AtomicFile::~AtomicFile() {
  discard();
}

void AtomicFile::write(const void* bytes, std::size_t count) {
  if (failed() || !file_ || count == 0) return;
  if (std::fwrite(bytes, 1, count, file_) != count) fail(std::strerror(errno));
}

void AtomicFile::fail(const std::string& why) {
  if (error_) return;
  Diagnostic& d = error_.emplace();
  d.where.file = path_;
  d.message = fmt::format("cannot be written: {}", why);
}

std::optional<Diagnostic> AtomicFile::commit() {
  if (!failed() && !file_) fail("it is finished already");
  if (!failed() && std::fflush(file_) != 0) fail(std::strerror(errno));
  if (file_) {
    const int closed = std::fclose(file_);
    file_ = nullptr;
    if (closed != 0) fail(std::strerror(errno));
  }
  if (!failed() && !temporary_.empty() && std::rename(temporary_.c_str(), path_.c_str()) != 0)
    fail(std::strerror(errno));
  if (!failed()) temporary_.clear();
  discard();
  return error_;
}

void AtomicFile::discard() {
  if (file_) std::fclose(file_);
  file_ = nullptr;
  if (!temporary_.empty()) unlink(temporary_.c_str());
  temporary_.clear();
}

std::optional<Diagnostic> writeFile(const std::string& path, std::string_view content) {
  AtomicFile file(path);
  file.write(content);
  return file.commit();
}

}  // namespace stadion
