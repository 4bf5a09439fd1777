#pragma once
/// Suite files: text that names the shows of a regression suite, their settings, and what is compared.
///
///     stadion-suite 1
///     size 96x72                          # before the first case: of every case
///     case kick
///       show     ../kick.evs
///       modes    sequential pipelined
///       frames   180
///       compare  state images counts times
///       tolerance times 3
///
/// docs/formats.md has every statement.
///
/// Units    tolerances in percent.
/// Threads  plain values, any thread.
/// Errors   go to the Diagnostics with line, column and a fix if one is known; there may be several.

#include "engine/base/diagnostic.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stadion::regression {

/// The metrics of a case to compare.
struct Metrics {
  bool state = true;          ///< state hashes of all frames, exactly
  bool images = true;         ///< hashes of the last frame's pictures, exactly
  bool counts = true;         ///< counts of nodes, messages, draw calls and so on, exactly
  bool instructions = false;  ///< by callgrind, without the rasteriser's
  bool times = false;         ///< times of stages, by rank test

  bool none() const { return !state && !images && !counts && !instructions && !times; }
};

struct Tolerances {
  double instructions = 0.5;  ///< [%]
  double times = 3;           ///< [%]
};

struct SuiteCase {
  std::string name;
  std::string show;             ///< path
  std::string walls = "cave4";  ///< name or path
  std::string input;            ///< path, "none", or empty: the log beside the show
  std::string stereo = "pair";
  std::string look = "full";  ///< or "plain"
  std::string size;           ///< "WxH"; empty: as the wall file says
  std::vector<std::string> modes{"sequential"};
  std::vector<std::string> assetRoots;
  std::vector<std::string> renderer{};  ///< words of the command line; empty: the program chooses what draws
  double rate = 0;                      ///< [1/s]; 0: the show's
  std::uint64_t frames = 0;             ///< 0: to the end of the input log
  Metrics metrics;
  Tolerances tolerances;
  std::uint64_t rounds = 12;  ///< rounds for times, at least 12: with fewer, chance cannot be excluded
};

/// Returns the name of a played case in baselines, histories and reports: CASE/MODE, and CASE/MODE/plain in
/// the plain look. Another look draws something else at another cost, so it has another name.
std::string playedName(const SuiteCase& played, const std::string& mode);

struct Suite {
  static constexpr std::size_t kMostCases = 1000;

  std::string file;              ///< as the user named it
  std::vector<SuiteCase> cases;  ///< in file order
};

/// Reads the text; returns nothing if it has errors. Names of files become relative to the suite's own
/// folder; their existence is not checked.
std::optional<Suite> parseSuite(std::string_view text, const std::string& file, Diagnostics& out);

/// Reads the file. Missing shows, wall files and logs are errors at the place that names them.
std::optional<Suite> loadSuite(const std::string& path, Diagnostics& out);

}  // namespace stadion::regression
