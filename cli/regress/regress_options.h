#pragma once
/// What `stadion regress` can be asked for.

#include "cli/options/renderer_options.h"
#include "engine/base/diagnostic.h"
#include "show/regress/regress_settings.h"

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace stadion {

struct RegressOptions {
  std::string suite;
  std::string program;            ///< --stadion; empty: this one
  std::string against, baseline;  ///< another program; a file
  std::string out;
  std::vector<std::string> cases, compare;
  bool baselineGiven = false;  ///< by --baseline: then it has to be there
  std::size_t rounds = 0;      ///< 0: as the suite says
  std::size_t limit = 600;     ///< [s] for a child
  RendererOptions renderer;
  bool update = false, instructions = false, json = false, resume = false;

  /// Expects that this object stays where it is until the command line has been read.
  void addTo(CLI::App& command);
  /// Completes what depends on other options. Says what is wrong.
  bool complete(Diagnostics& findings);
  RegressSettings settings() const { return {program, std::chrono::seconds(limit), instructions, asked()}; }
  /// What --compare leaves of what a suite may compare.
  regression::Metrics asked() const;
  /// Leaves what was asked for in the suite. Says which names it does not have.
  bool choose(regression::Suite& suite, Diagnostics& findings) const;
};

}  // namespace stadion
