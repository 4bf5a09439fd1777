/// Four machines in network namespaces of their own, between which a relay loses and delays what they tell.

#include "tests/programs/played_cluster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <unistd.h>
#include <vector>

namespace stadion {
namespace {

/// Root may make namespaces, unless a sandbox does not let it.
class Network {
public:
  Network(const std::string& loss, const std::string& jitter)
      : prefix_("s" + std::to_string(getpid())),
        relay_(::popen((STADION_BINARY_DIR "/bin/lossy-network " + prefix_ + " 4 " + loss + " " + jitter +
                        " > " + said_.string())
                           .c_str(),
                       "w")) {}
  ~Network() {
    if (relay_) ::pclose(relay_);
  }
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  bool isReady() const {
    becomes([&] { return fileContent(said_).find('\n') != std::string::npos; });
    return fileContent(said_).find("ready") != std::string::npos;
  }
  std::string space(std::size_t node) const { return prefix_ + "-" + std::to_string(node); }

private:
  TestFolder folder_;
  std::filesystem::path said_ = folder_.path() / "said";
  std::string prefix_;
  std::FILE* relay_;
};

struct PlayedCluster {
  const char *loss, *jitter, *frames, *size, *look = "full";
};

/// All walls show what one machine shows, and no machine shows a frame before every other one has shown the
/// one before.
void expectTheSamePictures(const PlayedCluster& how) {
  const Network network(how.loss, how.jitter);
  if (!network.isReady()) GTEST_SKIP() << "network namespaces cannot be made here (that takes root)";
  const TestFolder folder;
  const std::string cluster = folder.write(
      "net.cluster",
      "walls cave4\nnode front front\nnode left left\nnode right right\nnode floor floor\ninterface eth0\n"
      "deadline 5\n");  // on a machine that is busy, too
  const std::vector<std::string> same{"--size",   how.size,     "--look", how.look,  "--frames",
                                      how.frames, "--pictures", "none",   "--hashes"};
  std::vector<pid_t> nodes;
  for (std::size_t i = 0; i < std::size(kFourNodes); ++i) {
    const std::string node = kFourNodes[i];
    ProgramRun run{{"ip", "netns", "exec", network.space(i), stadionPath(), "run", kKick, "--cluster",
                    cluster, "--node", node, "--out", folder.path() / "four" / node}};
    run.words.insert(run.words.end(), same.begin(), same.end());
    nodes.push_back(startProgram(run, folder.path() / (node + ".said"), folder.path() / (node + ".told")));
  }
  for (std::size_t i = 0; i < nodes.size(); ++i)
    EXPECT_EQ(endOf(nodes[i]), 0) << fileContent(folder.path() / (std::string(kFourNodes[i]) + ".told"));
  std::vector<std::string> alone{"run", kKick, "--walls", "cave4", "--out", folder.path() / "one"};
  alone.insert(alone.end(), same.begin(), same.end());
  ProgramRun one{{stadionPath()}};
  one.words.insert(one.words.end(), alone.begin(), alone.end());
  one.limit = std::chrono::minutes(10);
  ASSERT_EQ(runProgram(one).status, 0);
  EXPECT_EQ(hashesBelow(folder.path() / "four"), hashesBelow(folder.path() / "one"));

  std::vector<std::map<std::uint64_t, std::int64_t>> swaps;
  for (const char* node : kFourNodes) swaps.push_back(swapTimesOf(folder.path() / "four" / node));
  const std::uint64_t frames = std::stoull(how.frames);
  for (std::uint64_t f = 0; f + 1 < frames; ++f) {
    std::int64_t last = 0, next = INT64_MAX;
    for (auto& node : swaps) last = std::max(last, node[f]), next = std::min(next, node[f + 1]);
    EXPECT_LT(last, next) << "frame " << f;
  }
  const Json lead = summaryOf(folder.path() / "four" / "front")["cluster"];
  EXPECT_EQ(lead["left_out"], 0);
  EXPECT_LE(lead["most_order_bytes"], 1024);
  for (const char* node : kFourNodes) {
    const Json s = summaryOf(folder.path() / "four" / node)["cluster"];
    std::printf("%s %% lost, %s ms jitter, %s: barrier p50 %.3f ms, p99 %.3f ms\n", how.loss, how.jitter,
                node, s["barrier_p50_ms"].get<double>(), s["barrier_p99_ms"].get<double>());
  }
}

TEST(ProgramAloneClusterNetwork, APacketInTenIsLostAndNoPicture) {
  expectTheSamePictures({"10", "5", "80", "32x24", "plain"});
}

TEST(ProgramFullClusterNetwork, TenThousandFramesOverNamespaces) {
  expectTheSamePictures({"0", "0", "10000", "64x48"});
}
TEST(ProgramFullClusterNetwork, TenThousandFramesWithOnePacketInAHundredLost) {
  expectTheSamePictures({"1", "5", "10000", "64x48"});
}
TEST(ProgramFullClusterNetwork, TenThousandFramesWithOnePacketInTenLost) {
  expectTheSamePictures({"10", "5", "10000", "64x48"});
}
TEST(ProgramFullClusterNetwork, ThreeHundredFramesAtFullSize) {
  expectTheSamePictures({"0", "0", "300", "800x600"});
}

}  // namespace
}  // namespace stadion
