#include "cli/json_errors.h"

#include "cli/exit_code.h"
#include "cli/findings_json.h"
#include "show/base/error_output.h"

#include <cerrno>
#include <new>
#include <unistd.h>

namespace stadion {
namespace {

/// A reason stands in the first or the last lines of a failed command; long runs write more.
constexpr std::size_t kMostText = std::size_t{1} << 16;

/// "stadion: error: there is no baseline" without the name of the program and the word "error".
std::string withoutPrefixes(std::string line) {
  for (const std::string_view prefix : {"stadion: ", "error: "})
    if (line.starts_with(prefix)) line.erase(0, prefix.size());
  return line;
}

}  // namespace

WatchedStream::WatchedStream(FILE*& stream, int descriptor, int buffering) : descriptor_(descriptor) {
  std::fflush(stream);
  FILE* watched = ::fopencookie(this, "w", {nullptr, &WatchedStream::write, nullptr, nullptr});
  if (!watched) return;
  std::setvbuf(watched, nullptr, buffering, BUFSIZ);
  stream = watched;
}

/// Returns the count of written bytes; fewer than `count` mean an error.
ssize_t WatchedStream::write(void* watched, const char* bytes, std::size_t count) {
  auto& self = *static_cast<WatchedStream*>(watched);
  std::size_t done = 0;
  while (done < count) {
    const ssize_t written = ::write(self.descriptor_, bytes + done, count - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) break;
    done += static_cast<std::size_t>(written);
  }
  self.keep(bytes, count);
  return static_cast<ssize_t>(done);
}

void WatchedStream::keep(const char* bytes, std::size_t count) noexcept {
  try {
    text_.append(bytes, count);
    if (text_.size() > 2 * kMostText) text_.erase(0, text_.size() - kMostText);
  } catch (const std::bad_alloc&) {
    text_.clear();  // "out of memory" follows
  }
}

JsonErrors::JsonErrors(bool wanted) {
  if (!wanted) return;
  const int buffering = ::isatty(STDOUT_FILENO) ? _IOLBF : _IOFBF;
  out_ = new WatchedStream(stdout, STDOUT_FILENO, buffering);
  err_ = new WatchedStream(stderr, STDERR_FILENO, _IONBF);
}

void JsonErrors::finish(int code) {
  constexpr int kFirstSignal = 128;
  if (!out_ || code == kOk || code > kFirstSignal) return;
  const bool written = std::fflush(stdout) == 0;
  if (!written || !out_->text().empty()) return;
  try {
    printJson({{"error", withoutPrefixes(reasonIn(err_->text()))}});
  } catch (const std::bad_alloc&) {
    std::fputs("{\"error\":\"out of memory\"}\n", stdout);
  }
}

}  // namespace stadion
