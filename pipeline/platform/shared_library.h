#pragma once
/// A shared library loaded at run time, its names kept to itself.
///
/// Ownership  never unloaded: Mesa leaves threads and exit handlers behind.
/// Threads    any.

#include "engine/base/diagnostic.h"

#include <dlfcn.h>
#include <string>

namespace stadion {

class SharedLibrary {
public:
  /// Fails with "FILE is missing: apt-get install PACKAGE", or with the linker's own words if it is there.
  static Result<SharedLibrary> open(const char* file, const char* package);
  /// The same library once more, with static memory of its own. What it needs itself is not copied.
  static Result<SharedLibrary> openCopy(const char* file, const char* package);

  /// The function of that name, or nullptr.
  template <class Function>
  Function* find(const char* name) const {
    return reinterpret_cast<Function*>(dlsym(handle_, name));
  }

  /// What its linker stamped it with, in hexadecimal digits: another build has another one. Empty if it was
  /// not stamped.
  std::string buildId() const;

private:
  explicit SharedLibrary(void* handle) : handle_(handle) {}
  void* handle_;
};

}  // namespace stadion
