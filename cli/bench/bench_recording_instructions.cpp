#include "cli/bench/bench_recording_instructions.h"

#include "engine/base/installed_files.h"
#include "engine/base/plain_file.h"
#include "show/regress/regress_child.h"

#include <cstdlib>

namespace stadion {
namespace {

/// Between them lies one round of the samples that FrameLog takes of a large wall.
constexpr int kFewer = 9, kMore = 521;
constexpr std::chrono::minutes kLimit{30};

/// All instructions of a run; with `wrong`, if there are none.
double instructionsOf(std::vector<std::string> words, int frames, const std::string& file,
                      const std::atomic<bool>& stop, std::string& wrong) {
  const std::string program = helperProgram("stadion").string();
  words.insert(words.begin(), {"valgrind", "--tool=callgrind", "--callgrind-out-file=" + file, program});
  words.insert(words.end(), {"--frames", std::to_string(frames)});
  const ChildResult child = runChild(words, kLimit, stop);
  if (!child.fault.empty()) {
    wrong = child.missing ? kNoValgrind : child.fault;
    return 0;
  }
  constexpr std::size_t kMostBytes = 256 << 20;
  const Result<std::string> text = readPlainFile(file, kMostBytes);
  const std::size_t at = text ? text.value().find("\nsummary: ") : std::string::npos;
  if (at == std::string::npos) {
    wrong = "callgrind wrote no summary";
    return 0;
  }
  return std::strtod(text.value().c_str() + at + 10, nullptr);
}

}  // namespace

FrameInstructions instructionsAFrame(const std::vector<std::string>& words, const std::string& folder,
                                     const std::atomic<bool>& stop) {
  FrameInstructions out;
  const std::string file = folder + "/callgrind.out";
  const double fewer = instructionsOf(words, kFewer, file, stop, out.fault);
  if (!out.fault.empty()) return out;
  const double more = instructionsOf(words, kMore, file, stop, out.fault);
  out.each = (more - fewer) / (kMore - kFewer);
  return out;
}

}  // namespace stadion
