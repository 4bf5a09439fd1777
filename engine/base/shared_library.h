#pragma once
/// A shared library loaded at run time; its symbols stay private.
///
/// Ownership  never unloaded: Mesa leaves threads and exit handlers behind.
/// Threads    any.

#include "engine/base/diagnostic.h"

#include <dlfcn.h>
#include <string>

namespace stadion {

class SharedLibrary {
public:
  /// Fails with "FILE is missing: apt-get install PACKAGE", or with the linker's message if the file exists.
  static Result<SharedLibrary> open(const char* file, const char* package);
  /// Loads another copy of the library, with static memory of its own. Its dependencies are not copied.
  static Result<SharedLibrary> openCopy(const char* file, const char* package);

  /// Returns the function of that name, or nullptr.
  template <class Function>
  Function* find(const char* name) const {
    return reinterpret_cast<Function*>(dlsym(handle_, name));
  }

  /// Returns the build id set by its linker, in hexadecimal digits; each build has another one. Empty if
  /// there is none.
  std::string buildId() const;

private:
  explicit SharedLibrary(void* handle) : handle_(handle) {}
  void* handle_;
};

}  // namespace stadion
