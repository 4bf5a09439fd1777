#pragma once
/// The end of a message about an unknown word.

#include <string>

namespace stadion {

/// `did you mean "front"?`, and how the two differ if they look alike.
std::string didYouMeanOne(const std::string& word, const std::string& candidate);

}  // namespace stadion
