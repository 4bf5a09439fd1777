#pragma once
/// What a crash of the program says of itself: the signal and where it was, on the standard error. The
/// process then ends as it would have without.

#include <string>

namespace stadion {

/// A file with the last frames. While this object lives, a crash report names the file.
///
/// Threads  any; of more than four at a time the others are not told of.
class CrashFileRegistration {
public:
  explicit CrashFileRegistration(const std::string& file);
  ~CrashFileRegistration();
  CrashFileRegistration(const CrashFileRegistration&) = delete;
  CrashFileRegistration& operator=(const CrashFileRegistration&) = delete;

private:
  int place_ = -1;
};

/// For signals that have no other handler (of a sanitizer). Once, before there are threads.
void reportCrashes();

}  // namespace stadion
