#pragma once
/// An error without a place in a script.

#include "engine/base/diagnostic.h"

#include <string>
#include <utility>

namespace stadion {

inline Diagnostic problem(std::string message) {
  Diagnostic d;
  d.message = std::move(message);
  return d;
}

}  // namespace stadion
