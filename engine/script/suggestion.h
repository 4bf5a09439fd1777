#pragma once
/// The end of a message about an unknown word.

#include "engine/base/diagnostic.h"
#include "engine/unicode/likeness.h"

#include <string>
#include <string_view>
#include <vector>

namespace stadion {

/// `; did you mean "density"?`, or `otherwise` if no candidate is near.
inline std::string didYouMean(std::string_view word, const std::vector<std::string>& candidates,
                              const std::string& otherwise = {}) {
  std::string small(word);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c | 0x20);
  auto found = closest(std::string(word), candidates);
  if (!found) found = closest(small, candidates);
  return found ? "; " + didYouMeanOne(std::string(word), *found) : otherwise;
}

}  // namespace stadion
