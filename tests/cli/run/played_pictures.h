#pragma once
// The pictures that a show writes.

#include "tests/programs/program.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

namespace stadion {

/// Plays the show on the desktop wall, 80 x 60 pixels, with further options. Returns the picture files by name.
inline std::map<std::string, std::string> playedPictures(const std::filesystem::path& show,
                                                         const std::vector<std::string>& how) {
  const TestFolder out;
  std::vector<std::string> words{"run",    show.string(), "--walls", "desktop",
                                 "--size", "80x60",       "--out",   out.path().string()};
  words.insert(words.end(), how.begin(), how.end());
  const ProgramResult r = stadionProgram(words);
  EXPECT_EQ(r.status, 0) << r.err;
  std::map<std::string, std::string> pictures;
  for (const auto& entry : std::filesystem::directory_iterator(out.path()))
    if (entry.path().extension() == ".png") pictures[entry.path().filename()] = fileContent(entry.path());
  return pictures;
}

}  // namespace stadion
