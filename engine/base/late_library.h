#pragma once
/// C libraries that a program loads when it first needs them. Most runs need no sound, archive or network, and
/// loading what they need, with all that it needs in turn, took half of a program's start.
///
///     const LateLibrary zipLibrary(STADION_LIBZIP, "libzip4");  // the name that CMake found
///     const LateFunction<decltype(::zip_strerror)> zip_strerror(zipLibrary, "zip_strerror");
///
/// Code below these lines calls the function as if it were linked.
///
/// Ownership  a library is never unloaded.
/// Threads    any.
/// Errors     load() says what is missing. Functions may be called after load() has succeeded, only.

#include "engine/base/shared_library.h"

#include <atomic>
#include <optional>
#include <utility>

namespace stadion {

class LateLibrary {
public:
  constexpr LateLibrary(const char* file, const char* package) : file_(file), package_(package) {}

  /// Returns an error if the library is not there. Later calls cost little.
  std::optional<Diagnostic> load() const {
    const auto library = SharedLibrary::open(file_, package_);
    return library ? std::nullopt : std::optional(library.error());
  }
  template <class Function>
  Function* find(const char* name) const {
    const auto library = SharedLibrary::open(file_, package_);
    return library ? library.value().template find<Function>(name) : nullptr;
  }

private:
  const char *file_, *package_;
};

/// A function of a late library; `Function` is its type.
template <class Function>
class LateFunction;

template <class Returned, class... Given>
class LateFunction<Returned(Given...)> {
public:
  constexpr LateFunction(const LateLibrary& library, const char* name) : library_(library), name_(name) {}

  template <class... Arguments>
  Returned operator()(Arguments&&... arguments) const {
    return address()(std::forward<Arguments>(arguments)...);
  }
  /// For code that takes a pointer to a function.
  Returned (*address() const)(Given...) {
    auto* found = address_.load(std::memory_order_acquire);
    if (!found) {
      found = library_.find<Returned(Given...)>(name_);
      address_.store(found, std::memory_order_release);
    }
    return found;
  }

private:
  const LateLibrary& library_;
  const char* name_;
  mutable std::atomic<Returned (*)(Given...)> address_ = nullptr;
};

}  // namespace stadion
