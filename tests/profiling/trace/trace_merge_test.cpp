#include "profiling/trace/trace_merge.h"

#include "profiling/trace/trace_events.h"
#include "tests/fresh_folder.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <unistd.h>

namespace stadion {
namespace {

using trace::Ticks;

class TraceMerge : public ::testing::Test {
protected:
  std::string path(const std::string& name) const { return folder_ / name; }
  /// A host's trace: each frame swaps 16 ms after the one before, by a clock that is `ahead`.
  std::string hostTrace(const std::string& name, Ticks ahead, std::uint64_t first,
                        std::uint64_t frames) const {
    std::string text = "{\"displayTimeUnit\":\"ms\",\"traceEvents\":[\n";
    trace::addProcessName(text, "stadion kick.evs");
    for (std::uint64_t n = first; n < first + frames; ++n) {
      const Ticks end = static_cast<Ticks>(n) * 128'000 + ahead;
      const std::string args = "\"frame\":" + std::to_string(n) + ",\"ms\":0.5";
      trace::addSlice(text, {"\"Swap\"", "stage", 1, end - 4'000, end, args});
      trace::addFlow(text, trace::FlowPoint::Start, n + 1, 1, end - 4'000);
    }
    text.erase(text.size() - 2);
    std::ofstream(path(name)) << text << "\n],\"otherData\":{}}\n";
    return path(name);
  }
  nlohmann::json merged() const {
    std::ifstream file(path("all.json"));
    return nlohmann::json::parse(file);
  }

private:
  FreshFolder folder_;
};

TEST_F(TraceMerge, AlignsClocksByTheSwapsOfCommonFrames) {
  const auto hosts =
      tracesOf({hostTrace("trace-front.json", 8'000'000, 2, 20), hostTrace("trace-left.json", 5'000, 7, 20)});
  const auto result = mergeTraces(hosts, path("all.json"));
  ASSERT_TRUE(result) << result.error().message;
  ASSERT_EQ(result.value().size(), 2U);
  EXPECT_EQ(result.value()[0].host, "front");
  EXPECT_EQ(result.value()[1].host, "left");
  EXPECT_EQ(result.value()[1].commonFrames, 15U);
  EXPECT_DOUBLE_EQ(result.value()[1].shiftUs, (8'000'000 - 5'000) / 8.0);

  const auto j = merged();
  std::map<int, std::map<int, double>> ends;  // by frame and host
  std::set<std::uint64_t> arrows;
  std::size_t flows = 0;
  for (const auto& e : j["traceEvents"]) {
    if (e["name"] == "Swap") {
      EXPECT_GE(e["ts"].get<double>(), 0);
      ends[e["args"]["frame"]][e["pid"]] = e["ts"].get<double>() + e["dur"].get<double>();
    }
    if (e["ph"] == "s") arrows.insert(e["id"].get<std::uint64_t>()), ++flows;
  }
  EXPECT_EQ(arrows.size(), flows) << "no two hosts share an arrow";
  EXPECT_DOUBLE_EQ(ends[9][1], ends[9][2]);
  EXPECT_EQ(ends.size(), 25U);
}

TEST_F(TraceMerge, WithoutACommonFrameAHostIsNotAligned) {
  const auto hosts = tracesOf({hostTrace("a.json", 0, 0, 3), hostTrace("b.json", 0, 10, 3)});
  const auto result = mergeTraces(hosts, path("all.json"));
  ASSERT_TRUE(result);
  EXPECT_EQ(result.value()[1].commonFrames, 0U);
  EXPECT_EQ(result.value()[1].host, "b");
}

TEST_F(TraceMerge, NamesAFileThatIsNoTrace) {
  std::ofstream(path("x.json")) << "{}\n";
  const auto result = mergeTraces(tracesOf({hostTrace("a.json", 0, 0, 3), path("x.json")}), path("all.json"));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().where.file, path("x.json"));
  EXPECT_EQ(result.error().message, "is no trace of stadion");
  EXPECT_FALSE(std::filesystem::exists(path("all.json")));
  EXPECT_FALSE(mergeTraces(tracesOf({path("none.json")}), path("all.json")));
}

}  // namespace
}  // namespace stadion
