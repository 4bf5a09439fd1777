#pragma once
/// The distances butteraugli and ssimulacra, measured by the programs of Debian's package libjxl-devtools.
///
/// Threads  one at a time: it starts programs.
/// Errors   nothing if a program is missing, takes longer than a minute or says no number.

#include <optional>
#include <string>

namespace stadion::bench {

constexpr const char* kPerceptualPackage = "libjxl-devtools";

/// PNG files of two pictures of one size.
struct PictureFiles {
  std::string reference, picture;
};

/// About 1: a difference that is just noticed; the greatest one in the picture counts.
std::optional<double> butteraugliOf(const PictureFiles& files);
/// 0: alike; it grows with the difference that is seen.
std::optional<double> ssimulacraOf(const PictureFiles& files);

}  // namespace stadion::bench
