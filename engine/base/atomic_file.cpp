#include "engine/base/atomic_file.h"

#include "engine/base/folder_names.h"

#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace stadion {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  ///< as many as the system follows

/// How the names of all temporary files for that one begin.
std::string beginOfParts(const fs::path& target) {
  return fmt::format(".{}.", target.filename().string().substr(0, 200));
}

/// A name that no other writer of this machine uses at the same time.
std::string temporaryFor(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  const std::string name = fmt::format("{}{}-{}.part", beginOfParts(target), getpid(), counter.fetch_add(1));
  return (target.parent_path() / name).string();
}

/// Returns true if "PID-NUMBER.part" belongs to a process that has ended.
bool isOfGoneProcess(std::string_view rest) {
  pid_t writer = 0;
  const auto [end, wrong] = std::from_chars(rest.data(), rest.data() + rest.size(), writer);
  if (wrong != std::errc() || writer <= 0 || end == rest.data() + rest.size() || *end != '-') return false;
  return rest.ends_with(".part") && ::kill(writer, 0) != 0 && errno == ESRCH;
}

/// A link in /proc names a file that a process has open: it must not be replaced.
bool isOpenFile(const fs::path& link) {
  std::error_code none;
  return fs::canonical(link.parent_path(), none).string().starts_with("/proc/");
}

/// Opens it for writing. A pipe without a reader is an error, and no reason to wait.
std::FILE* openToWrite(const std::string& path) {
  const int file =
      ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0666);
  if (file < 0) return nullptr;
  fcntl(file, F_SETFL, 0);  // what is written may wait
  std::FILE* const stream = fdopen(file, "wb");
  if (!stream) ::close(file);
  return stream;
}

/// Returns the target of the path's links. Returns nothing if that is an open file.
std::optional<std::string> targetOf(fs::path path) {
  std::error_code none;
  for (int i = 0; i < kMostLinks && fs::is_symlink(path, none); ++i) {
    if (isOpenFile(path)) return std::nullopt;
    path = path.parent_path() / fs::read_symlink(path, none);
  }
  return path.string();
}

}  // namespace

AtomicFile::AtomicFile(std::string path, Unfinished unfinished)
    : unfinished_(unfinished), path_(std::move(path)) {
  struct stat status {};
  const bool exists = stat(path_.c_str(), &status) == 0;
  const bool ring = !exists && errno == ELOOP;
  if (ring || (exists && S_ISDIR(status.st_mode))) {
    fail(ring ? std::strerror(ELOOP) : "it is a folder");
    return;
  }
  const auto target = targetOf(path_);
  const bool direct = !target || (exists && !S_ISREG(status.st_mode));
  target_ = target.value_or(path_);
  if (!direct) temporary_ = temporaryFor(target_);
  file_ = openToWrite(direct ? path_ : temporary_);
  if (!file_) {
    const int reason = errno;
    temporary_.clear();
    fail(reason == ENXIO && S_ISFIFO(status.st_mode) ? "it is a pipe without a reader"
                                                     : std::strerror(reason));
  }
}

AtomicFile::~AtomicFile() {
  discard();
}

void AtomicFile::write(const void* bytes, std::size_t count) {
  if (failed() || !file_ || count == 0) return;
  if (std::fwrite(bytes, 1, count, file_) != count) fail(std::strerror(errno));
}

void AtomicFile::overwrite(long at, std::string_view bytes) {
  if (failed() || !file_) return;
  if (std::fseek(file_, at, SEEK_SET) != 0) return fail(std::strerror(errno));
  write(bytes);
  if (!failed() && std::fseek(file_, 0, SEEK_END) != 0) fail(std::strerror(errno));
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
  if (!failed() && !temporary_.empty() && std::rename(temporary_.c_str(), target_.c_str()) != 0)
    fail(std::strerror(errno));
  if (!failed()) temporary_.clear();
  if (failed() && unfinished_ == Unfinished::KeepsLines && keepLines())
    error_->message += fmt::format("; what could be written is in {}.partial", target_);
  discard();
  return error_;
}

// To cut and to rename takes no room.
bool AtomicFile::keepLines() {
  std::FILE* const text = temporary_.empty() ? nullptr : std::fopen(temporary_.c_str(), "rbe");
  if (!text) return false;
  long whole = 0, at = 0;
  for (int c = std::fgetc(text); c != EOF; c = std::fgetc(text))
    if (++at, c == '\n') whole = at;
  std::fclose(text);
  if (whole == 0 || truncate(temporary_.c_str(), whole) != 0) return false;
  if (std::rename(temporary_.c_str(), (target_ + ".partial").c_str()) != 0) return false;
  temporary_.clear();
  return true;
}

void AtomicFile::discard() {
  if (file_) std::fclose(file_);
  file_ = nullptr;
  if (!temporary_.empty()) unlink(temporary_.c_str());
  temporary_.clear();
}

std::vector<std::string> partsOfKilledWriters(const std::string& path) {
  const fs::path target = targetOf(path).value_or("");
  const std::string begin = beginOfParts(target);
  std::vector<std::string> parts;
  if (target.empty()) return parts;
  for (const std::string& name : namesIn(target.has_parent_path() ? target.parent_path().string() : "."))
    if (name.starts_with(begin) && isOfGoneProcess(std::string_view(name).substr(begin.size())))
      parts.push_back((target.parent_path() / name).string());
  return parts;
}

std::optional<Diagnostic> writeFile(const std::string& path, std::string_view content) {
  AtomicFile file(path);
  file.write(content);
  return file.commit();
}

}  // namespace stadion
