#pragma once
/// A file that appears complete or not at all.
///
/// What is written goes to a hidden temporary file in the same folder; commit() puts it in the place of the
/// target in one step. Whoever opens the target sees the old content or the new, never half of one. A
/// symbolic link stays: the target is what it leads to, there or not yet. A target that exists and is no
/// plain file (a device, a pipe), or that a link names as an open file (/dev/stdout), is written directly.
///
/// Ownership  owns the temporary file; without commit() it is removed again. Only a writer that is killed
///            leaves it: .NAME.PID-NUMBER.part.
/// Threads    one thread at a time.
/// Errors     the first one is kept and reported by commit(); writing after it does nothing.

#include "engine/base/diagnostic.h"

#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

class AtomicFile {
public:
  /// What becomes of a text that cannot be finished.
  enum class Unfinished {
    Goes,
    KeepsLines,  ///< its whole lines are kept as PATH.partial, in the place of an older one
  };

  explicit AtomicFile(std::string path, Unfinished unfinished = Unfinished::Goes);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* bytes, std::size_t count);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Records a failure from elsewhere (an encoder, for instance), so that commit() discards the file.
  void fail(const std::string& why);
  bool failed() const { return error_.has_value(); }
  /// Why it has failed so far, such as a folder that is not there.
  const std::optional<Diagnostic>& error() const { return error_; }

  /// Finishes the file. Nothing if all went well, else why there is none; the old target is then untouched.
  std::optional<Diagnostic> commit();

private:
  void discard();
  bool keepLines();

  Unfinished unfinished_;
  std::string path_;       ///< as it was named
  std::string target_;     ///< what its links lead to
  std::string temporary_;  ///< empty: the target is written directly
  std::FILE* file_ = nullptr;
  std::optional<Diagnostic> error_;
};

/// What writers of that file have left which are gone: they were killed, or the machine died.
std::vector<std::string> partsOfKilledWriters(const std::string& path);

/// The whole content at once.
std::optional<Diagnostic> writeFile(const std::string& path, std::string_view content);

}  // namespace stadion
