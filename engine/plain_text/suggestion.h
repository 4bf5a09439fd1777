#pragma once
/// The end of a message about an unknown word: the known word that was probably meant.
///
/// Threads  plain functions.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

/// The candidate closest to `word` by edit distance if it is close enough to be a slip, else nothing. The
/// search is bounded to some milliseconds: of very many candidates, only the first ones are compared.
std::optional<std::string> closest(const std::string& word, const std::vector<std::string>& candidates);

/// `did you mean "front"?`, and how the two differ if they look alike.
std::string didYouMeanOne(const std::string& word, const std::string& candidate);

/// `; did you mean "density"?`, or `otherwise` if no candidate is near. Ignores the case of letters.
std::string didYouMean(std::string_view word, const std::vector<std::string>& candidates,
                       const std::string& otherwise = {});

/// `; did you mean "front"?`, or `; known are front, left, right` if no candidate is near.
std::string didYouMeanOrKnown(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace stadion
