#pragma once
/// A file that appears complete or not at all.
///
/// Text goes to a hidden temporary file in the same folder; commit() renames it to the target in one step. A
/// reader of the target sees the old content or the new, never half of one. A symbolic link stays: its target
/// is replaced, or created. A target that is no plain file (a device, a pipe), or an open file behind a link
/// (/dev/stdout), is written directly.
///
/// Ownership  owns the temporary file; without commit() it is removed again. Only a killed writer leaves it:
///            .NAME.PID-NUMBER.part.
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
  /// The treatment of a text that cannot be finished.
  enum class Unfinished {
    Goes,
    KeepsLines,  ///< whole lines of the text are kept as PATH.partial, in place of an older one
  };

  explicit AtomicFile(std::string path, Unfinished unfinished = Unfinished::Goes);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* bytes, std::size_t count);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Replaces bytes that were written, such as sizes in a heading. Fails if the target is a pipe.
  void overwrite(long at, std::string_view bytes);
  /// Records a failure from elsewhere (an encoder, for instance), so that commit() discards the file.
  void fail(const std::string& why);
  bool failed() const { return error_.has_value(); }
  /// Returns why it has failed so far, such as a missing folder.
  const std::optional<Diagnostic>& error() const { return error_; }

  /// Finishes the file. Returns nothing on success, else the error; the old target is then unchanged.
  std::optional<Diagnostic> commit();

private:
  void discard();
  bool keepLines();

  Unfinished unfinished_;
  std::string path_;       ///< path as the caller named it
  std::string target_;     ///< path to which its links lead
  std::string temporary_;  ///< empty: the target is written directly
  std::FILE* file_ = nullptr;
  std::optional<Diagnostic> error_;
};

/// Returns the temporary files that ended writers of that file have left: they were killed, or the machine
/// crashed.
std::vector<std::string> partsOfKilledWriters(const std::string& path);

/// Writes the whole content at once.
std::optional<Diagnostic> writeFile(const std::string& path, std::string_view content);

}  // namespace stadion
