#pragma once
/// With --json, the standard output is JSON also if a command fails.
///
/// Many places report errors, and all of them write to the standard error. So the standard streams are
/// watched: if a command fails and has printed nothing, an object with the reason is printed.
///
/// Threads  any thread may write meanwhile. Created by the main thread, before there are others.

#include <cstddef>
#include <cstdio>
#include <string>

namespace stadion {

/// Replaces a standard stream by one that writes to the same descriptor and keeps the end of the text.
///
/// Ownership  lives until the process ends: libraries such as OpenAL keep the stream, and use it in exit().
class WatchedStream {
public:
  /// `stream` is stdout or stderr.
  WatchedStream(FILE*& stream, int descriptor, int buffering);
  ~WatchedStream() = delete;
  WatchedStream(const WatchedStream&) = delete;
  WatchedStream& operator=(const WatchedStream&) = delete;

  /// The end of what was written and flushed.
  const std::string& text() const { return text_; }

private:
  static ssize_t write(void* watched, const char* bytes, std::size_t count);
  void keep(const char* bytes, std::size_t count) noexcept;

  const int descriptor_;
  std::string text_;
};

class JsonErrors {
public:
  /// Does nothing unless `wanted`.
  explicit JsonErrors(bool wanted);

  /// Prints {"error": REASON} if a command ended with a `code` of a failure and printed nothing. A signal is
  /// no failure.
  void finish(int code);

private:
  WatchedStream* out_ = nullptr;  ///< null: not wanted
  WatchedStream* err_ = nullptr;
};

}  // namespace stadion
