#pragma once
/// Two hosts of a cluster that play live.

#include "tests/programs/desk.h"
#include "tests/programs/played_cluster.h"

#include <csignal>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

namespace stadion {

/// Two machines with a wall each that play live, each started by hand.
class TwoLive {
public:
  explicit TwoLive(const std::string& script = "", const std::string& more = "")
      : script_(script.empty() ? kKick : folder_->write("show.evs", script)),
        file_(folder_->write("two.cluster", "walls two.walls\nnode front front\nnode floor floor\n"
                                            "partition live" +
                                                std::to_string(getpid()) + "\n" + more)) {
    folder_->write("two.walls",
                   "wall front  lower-left -1.5  1.5 0  lower-right 1.5  1.5 0  upper-left -1.5 1.5 3\n"
                   "wall floor  lower-left -1.5 -1.5 0  lower-right 1.5 -1.5 0  upper-left -1.5 1.5 0\n");
  }
  std::unique_ptr<RunningProgram> start(const std::string& node, std::vector<std::string> more = {}) const {
    ProgramRun run{{stadionPath(), "run", script_, "--cluster", file_, "--node", node, "--size", "32x24",
                    "--look", "plain", "--asset-root", assetFolder(), "--journal", journal(node)}};
    run.words.insert(run.words.end(), more.begin(), more.end());
    return std::make_unique<RunningProgram>(run);
  }
  /// So many programs of that node have shown a picture.
  bool show(const std::string& node, std::size_t times = 1) const {
    return becomes([&] {
      const std::string text = fileContent(journal(node));
      std::size_t count = 0;
      for (std::size_t at = 0; (at = text.find("the first picture", at)) != text.npos; ++at) ++count;
      return count >= times;
    });
  }
  /// The same, with another copy of the script.
  std::unique_ptr<RunningProgram> startWith(const std::string& script, const std::string& node,
                                            std::vector<std::string> more) const {
    TwoLive other(*this);
    other.script_ = script;
    return other.start(node, std::move(more));
  }
  static int endOf(RunningProgram& program) {
    kill(program.pid(), SIGINT);
    return program.status();
  }

private:
  std::string journal(const std::string& node) const { return folder_->path() / (node + ".log"); }

  std::shared_ptr<const TestFolder> folder_ = std::make_shared<TestFolder>();
  std::string script_, file_;
};

}  // namespace stadion
