/// `stadion cluster FILE SHOW`: plays a show on all nodes of a cluster at once, on this machine, for trying
/// out.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/stop_signal.h"
#include "pipeline/cluster/cluster_file.h"
#include "pipeline/output/child_process.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <memory>
#include <thread>

namespace stadion {
namespace {

constexpr std::chrono::milliseconds kLook{20};
/// Who has not ended so long after who leads has lost it at the end, and would wait for it for ever.
constexpr std::chrono::seconds kAfterLead{10};
constexpr std::size_t kMostSaid = 1 << 20;  ///< of a node's summary that is told [byte]

struct ClusterOptions {
  std::string file, script, out;
  bool once = false;
  std::vector<std::string> more;  ///< for each `run`
};

/// A node's process and what it says.
struct NodeProcess {
  std::string name;
  std::vector<std::string> words;
  Descriptor said = makeMemoryFile();
  ChildProcess child;
  std::optional<int> status{};
  unsigned starts = 0;

  void interrupt() const {
    if (child.pid() > 0) kill(child.pid(), SIGINT);  // -1 would be everybody
  }
  bool start() {
    said = makeMemoryFile(), status.reset(), ++starts;
    return !child.start(words, {-1, said.get(), 2});
  }
};

std::deque<NodeProcess> processesOf(const ClusterOptions& o, const ClusterFile& cluster) {
  const std::string program = std::filesystem::canonical("/proc/self/exe").string();
  std::deque<NodeProcess> all;
  for (const ClusterNode& node : cluster.nodes) {
    NodeProcess& p = all.emplace_back();
    p.name = node.name;
    p.words = {program, "run", o.script, "--cluster", o.file, "--node", node.name};
    if (!o.out.empty()) p.words.insert(p.words.end(), {"--out", o.out + "/" + node.name});
    p.words.insert(p.words.end(), o.more.begin(), o.more.end());
  }
  return all;
}

/// Looks after them until all have ended. Who dies begins again, until who leads has come to its end: then
/// nobody is waited for any more.
void watch(const ClusterOptions& o, std::deque<NodeProcess>& nodes, std::size_t lead) {
  const std::atomic<bool>& stop = catchStopSignals();
  const auto died = [](const NodeProcess& node) { return node.status && *node.status > 128; };
  bool told = false, overTold = false;
  std::optional<std::chrono::steady_clock::time_point> ended;
  for (bool running = true; running;) {
    running = false;
    for (NodeProcess& node : nodes) {
      if (node.status) continue;
      if (stop && !told) node.interrupt();
      node.status = node.child.wait(std::chrono::milliseconds(0));
      running = running || !node.status;
      const bool over = nodes[lead].status && !died(nodes[lead]);
      if (!died(node) || o.once || stop || over) continue;
      std::fprintf(stderr, "cluster: %s was ended by signal %d and begins again\n", node.name.c_str(),
                   *node.status - 128);
      if (node.start())
        running = true;
      else
        node.status = kInternalFault,
        std::fprintf(stderr, "cluster: %s cannot be started\n", node.name.c_str());
    }
    told = stop;
    if (!ended && nodes[lead].status && !died(nodes[lead])) ended = std::chrono::steady_clock::now();
    if (ended && !overTold && std::chrono::steady_clock::now() - *ended > kAfterLead) {
      overTold = true;
      for (NodeProcess& node : nodes)
        if (!node.status) node.interrupt();
    }
    std::this_thread::sleep_for(kLook);
  }
}

int playCluster(ClusterOptions o) {
  Diagnostics findings;
  const auto cluster = loadCluster(o.file, findings);
  if (!std::filesystem::exists(o.script)) findings.error({}, "there is no show " + o.script);
  for (const Diagnostic& d : findings.all()) std::fprintf(stderr, "%s\n", format(d).c_str());
  if (!cluster || findings.hasErrors()) return kBadInput;
  std::error_code wrong;
  if (!o.out.empty()) std::filesystem::create_directories(o.out, wrong);
  if (wrong)
    return std::fprintf(stderr, "stadion: --out %s: %s\n", o.out.c_str(), wrong.message().c_str()), kBadInput;

  std::deque<NodeProcess> nodes = processesOf(o, *cluster);
  for (NodeProcess& node : nodes)
    if (!node.start())
      return std::fprintf(stderr, "stadion: %s cannot be started\n", node.name.c_str()), kInternalFault;
  watch(o, nodes, cluster->lead);

  int code = kOk;
  for (const NodeProcess& node : nodes) {
    std::printf("-- %s%s\n%s", node.name.c_str(),
                node.starts > 1 ? (", begun " + std::to_string(node.starts) + " times").c_str() : "",
                contentOf(node.said, kMostSaid).c_str());
    if (code == kOk) code = node.status.value_or(kInternalFault);
  }
  return code;
}

constexpr const char* kClusterFooter =
    R"(Each node is a process of its own, as `stadion run SHOW --cluster FILE --node NAME` is on a machine of its own. ClusterOptions that
are not listed here go to every one of them; pictures of --out DIR lie in DIR/NODE. A node that dies is begun again, and goes
on from the others' scene.

  ./stadion cluster walls/four.cluster scripts/kick.evs --frames 300 --out pictures
  ./stadion cluster walls/four.cluster scripts/olympia.evs --size 320x240

docs/cluster.md has the file's format, and what happens when a machine or the network fails.)";

}  // namespace

void addClusterCommand(CLI::App& app, int& code) {
  auto o = std::make_shared<ClusterOptions>();
  CLI::App* command =
      app.add_subcommand("cluster", "Play a show on all nodes of a cluster at once, on this machine");
  command->add_option("FILE", o->file, "the cluster file")->required();
  command->add_option("SHOW", o->script, "the script to play (.evs)")->required();
  command->add_option("--out", o->out, "folder for each node's folder of pictures");
  command->add_flag("--once", o->once, "a node that dies is not begun again");
  command->allow_extras();
  command->footer(kClusterFooter);
  command->callback([o, command, &code] {
    o->more = command->remaining();
    code = playCluster(*o);
  });
}

}  // namespace stadion
