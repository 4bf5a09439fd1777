#include "show/regress/regress_rounds.h"

#include "profiling/regression/spans/callgrind_record.h"
#include "profiling/regression/statistics/instruction_comparison.h"
#include "profiling/regression/statistics/noise_calibration.h"
#include "show/base/temporary_folder.h"
#include "show/regress/regress_child.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace stadion {
namespace {

using namespace regression;

constexpr const char* kStoppedFault = "stopped";

/// Lets the rasteriser work in the thread that draws: else its time cannot be attributed.
const std::vector<std::string> kDrawAlone{"LP_NUM_THREADS=0"};

ChildResult runMeasured(const std::vector<std::string>& words, const MeasuringOptions& o) {
  return runChild(words, o.limit, o.stop, kDrawAlone);
}

std::vector<std::string> measuredWords(const SuiteCase& c, const std::string& mode,
                                       const MeasuredProgram& program, const std::string& file, bool turns) {
  std::vector<std::string> words = playWords(program.path, c, mode);
  words.insert(words.end(), {"--spans", file, "--app-threads", "1"});
  if (turns) words.emplace_back("--turns");
  if (!program.planted.empty()) words.insert(words.end(), {"--plant", program.planted});
  return words;
}

std::string faultOf(const MeasuredProgram& program, const ChildResult& child) {
  return child.fault.empty() ? "" : program.path + ": " + child.fault;
}

/// Builds that know nothing of --spans tell in their summary what the stages cost.
std::vector<SpanRow> playedOld(const SuiteCase& c, const std::string& mode, const MeasuredProgram& program,
                               const MeasuringOptions& o, std::string& fault) {
  const ChildResult child = runMeasured(playWords(program.path, c, mode), o);
  fault = faultOf(program, child);
  return stagesOfSummary(child.out);
}

bool knowsNoSpans(const ChildResult& child) {
  return child.status == 2 && child.err.find("--spans") != std::string::npos;
}

/// A program and where its record goes.
struct RoundSide {
  const MeasuredProgram& program;
  std::string file;
  std::vector<SpanRow> rows{};
};

class Rounds {
public:
  Rounds(const SuiteCase& c, const std::string& mode, const MeasuringOptions& o)
      : case_(c), mode_(mode), o_(o), turns_(mode == "sequential") {}

  /// False, with the reason in `fault`, if one of the two could not be played.
  bool play(RoundSide& first, RoundSide& second) {
    if (!old_ && turns_) {
      const auto [a, b] = runInTurns(words(first), words(second), o_.limit, o_.stop, kDrawAlone);
      if (knowsNoSpans(a) || knowsNoSpans(b)) {
        old_ = true;
        return play(first, second);
      }
      return take(a, first) && take(b, second);
    }
    return play(first) && play(second);
  }

  bool play(RoundSide& side) {
    if (old_) {
      side.rows = playedOld(case_, mode_, side.program, o_, fault);
      return fault.empty();
    }
    const ChildResult child = runMeasured(measuredWords(case_, mode_, side.program, side.file, false), o_);
    if (knowsNoSpans(child)) {
      old_ = true;
      return play(side);
    }
    return take(child, side);
  }

  std::string fault;

private:
  std::vector<std::string> words(const RoundSide& side) const {
    return measuredWords(case_, mode_, side.program, side.file, true);
  }

  bool take(const ChildResult& child, RoundSide& side) {
    fault = faultOf(side.program, child);
    if (fault.empty()) side.rows = spanRows(textOf(side.file));
    if (fault.empty() && side.rows.empty()) fault = side.program.path + ": it did not write what it cost";
    return fault.empty();
  }

  const SuiteCase& case_;
  const std::string& mode_;
  const MeasuringOptions& o_;
  bool turns_, old_ = false;
};

}  // namespace

MeasuredRounds measureRounds(const SuiteCase& c, const std::string& mode, const MeasuredProgram& before,
                             const MeasuredProgram& now, const MeasuringOptions& options) {
  const TemporaryFolder folder;
  Rounds rounds(c, mode, options);
  MeasuredRounds measured;
  for (std::size_t i = 0; i < options.rounds && !options.stop; ++i) {
    RoundSide a{before, folder.path("before")}, b{now, folder.path("now")};
    if (!(i % 2 == 0 ? rounds.play(a, b) : rounds.play(b, a))) {
      measured.fault = rounds.fault;
      return measured;
    }
    measured.rounds.push_back({std::move(a.rows), std::move(b.rows)});
  }
  if (measured.rounds.size() < options.rounds) measured.fault = kStoppedFault;
  return measured;
}

MeasuredRounds measureRounds(const SuiteCase& c, const std::string& mode, const MeasuredProgram& now,
                             const MeasuringOptions& options) {
  const TemporaryFolder folder;
  Rounds rounds(c, mode, options);
  MeasuredRounds measured;
  for (std::size_t i = 0; i < options.rounds && !options.stop; ++i) {
    RoundSide side{now, folder.path("now")};
    const double earlier = calibrationMs();
    if (!rounds.play(side)) {
      measured.fault = rounds.fault;
      return measured;
    }
    measured.calibrationMs.push_back((earlier + calibrationMs()) / 2);
    measured.rounds.push_back({{}, std::move(side.rows)});
  }
  if (measured.rounds.size() < options.rounds) measured.fault = kStoppedFault;
  return measured;
}

std::string_view nameOf(CountedBy by) {
  return by == CountedBy::Hardware ? "hardware counters" : "callgrind";
}

namespace {

/// The rasteriser's threads are not counted: it works in its own.
CountedInstructions countByHardware(const SuiteCase& c, const MeasuredProgram& program,
                                    const std::string& file, bool drawn, const MeasuringOptions& options) {
  std::vector<std::string> words = measuredWords(c, "sequential", program, file, false);
  words.emplace_back("--count-by-hardware");
  if (!drawn) words.insert(words.end(), {"--gl", "none"});
  const ChildResult child = runChild(words, options.limit, options.stop);
  CountedInstructions counted{{}, faultOf(program, child)};
  if (counted.fault.empty()) counted.rows = spanRows(textOf(file));
  if (counted.fault.empty() && stageInstructions(counted.rows).empty())
    counted.fault = program.path + ": the hardware counter has counted nothing of it";
  return counted;
}

/// The file that ran under this command line: a script may have become another program, and links lead to it.
std::string programIn(std::string_view command) {
  for (std::size_t end = 0; end < command.size();) {  // its path may hold blanks
    end = std::min(command.find(' ', end + 1), command.size());
    std::error_code none;
    const std::filesystem::path program = std::filesystem::canonical(command.substr(0, end), none);
    if (!none && std::filesystem::is_regular_file(program, none)) return program.string();
  }
  return {};
}

}  // namespace

CountedInstructions countInstructions(const SuiteCase& c, const MeasuredProgram& program, bool drawn,
                                      const MeasuringOptions& options, CountedBy by) {
  const TemporaryFolder folder;
  SuiteCase shorter = c;
  if (!drawn) shorter.renderer.clear();
  shorter.frames = c.frames == 0 ? kCountedFrames : std::min(c.frames, kCountedFrames);
  if (by == CountedBy::Hardware)
    return countByHardware(shorter, program, folder.path("spans"), drawn, options);
  std::vector<std::string> words = measuredWords(shorter, "sequential", program, folder.path("spans"), false);
  words.insert(words.begin(), {"valgrind", "--tool=callgrind", "--trace-children=yes",
                               "--trace-children-skip=*/stadion-import", "--instr-atstart=no",
                               "--combine-dumps=yes", "--callgrind-out-file=" + folder.path("callgrind")});
  words.emplace_back("--count-instructions");
  if (!drawn) words.insert(words.end(), {"--gl", "none"});

  const ChildResult child = runMeasured(words, options);
  CountedInstructions counted;
  if (child.missing) return {{}, kNoValgrind, true};
  counted.fault = faultOf(program, child);
  if (!counted.fault.empty()) return counted;
  counted.rows = spanRows(textOf(folder.path("spans")));
  const std::string record = textOf(folder.path("callgrind"));
  const auto counts = instructionsByLabel(record, programIn(commandOf(record)));
  giveInstructions(counted.rows, counts);
  if (counts.empty())
    counted.fault =
        program.path + ": callgrind has counted nothing of it; a script has to `exec` the program";
  return counted;
}

}  // namespace stadion
