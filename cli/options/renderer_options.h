#pragma once
/// --renderer, --gl, --gl-submission and --draw-threads: what draws. They mean the same in all commands that draw.
///
/// Ownership  the options write into this object, which must stay where it is until the command line has been
///            read.

#include "show/player/show_renderer.h"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace stadion {

struct RendererOptions {
  std::string renderer = "auto", gl = "auto", submission = "auto";
  unsigned threads = 0;  ///< 0: not given
  bool rendererGiven = false, glGiven = false, submissionGiven = false;

  /// `mayDrawNothing`: the command accepts --gl none.
  void addTo(CLI::App& command, bool mayDrawNothing = false);
  bool drawsNothing() const { return gl == "none"; }
  /// These options as words for another command line; none if they were not given.
  std::vector<std::string> words() const;
  /// The findings receive contradictions.
  RendererSettings settings(Diagnostics& findings) const;
};

}  // namespace stadion
