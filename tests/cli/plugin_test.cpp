/// Node types of others: shows that use them, and plugins that cannot be used.

#include "tests/programs/program.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace stadion {
namespace {

std::string pluginFile(const std::string& name) {
  return std::string(STADION_BINARY_DIR) + "/bin/lib" + name + ".so";
}

const std::string kFollows = "path( name=way, key=\"0, 0, 0, 0\", key=\"1, 3, 0, 0\" )\n"
                             "spring( name=tail, target=way, frequency=2 )\n"
                             "timer( period=0.2, eventmessage=\"timesup, tail, kick\" )\n";

/// What the program says of a plugin that it refuses.
std::string refusal(const std::vector<std::string>& files) {
  std::vector<std::string> words = {"hash", testShow("part.evs"), "--frames", "1"};
  for (const std::string& file : files) words.insert(words.end(), {"--plugin", file});
  const ProgramResult r = stadionProgram(words);
  EXPECT_EQ(r.status, 2) << r.out;
  return r.err;
}

TEST(ProgramPlugin, AShowMayUseItsNodeTypes) {
  const TestFolder folder;
  const std::string show = folder.write("follows.evs", kFollows), plugin = pluginFile("spring-plugin");
  const ProgramResult without = stadionProgram({"check", show});
  EXPECT_EQ(without.status, 2);
  EXPECT_TRUE(has(without.out, "\"spring\" is not a node type")) << without.out;
  EXPECT_TRUE(has(without.out, "\"kick\" is not a command")) << without.out;
  EXPECT_EQ(stadionProgram({"check", show, "--plugin", plugin}).out, show + ": ok\n");

  const ProgramResult first = stadionProgram({"hash", show, "--plugin", plugin, "--frames", "60"});
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(stadionProgram({"hash", "--plugin", plugin, show, "--frames", "60"}).out, first.out);
  const ProgramResult pictures = stadionProgram({"run", show, "--plugin", plugin, "--frames", "2", "--walls",
                                                 "desktop", "--size", "32x24", "--wall-workers", "process"});
  EXPECT_EQ(pictures.status, 0) << pictures.err;
}

TEST(ProgramPlugin, TheReferenceTellsOfItsNodeTypes) {
  const ProgramResult r = stadionProgram({"nodes", "spring", "--plugin", pluginFile("spring-plugin")});
  EXPECT_EQ(r.status, 0) << r.err;
  for (const char* words :
       {"spring: follows another node", "frequency", "[Hz]", "kick", "initstate", "detach"})
    EXPECT_TRUE(has(r.out, words)) << words << "\n" << r.out;
}

TEST(ProgramPlugin, AShowThatUsesNoneHasTheSameHashes) {
  const auto hashes = [](std::vector<std::string> further) {
    std::vector<std::string> words = {"hash", std::string(STADION_SOURCE_DIR) + "/scripts/kick.evs",
                                      "--frames", "30"};
    words.insert(words.end(), further.begin(), further.end());
    return stadionProgram(words).out;
  };
  const std::string plain = hashes({});
  EXPECT_EQ(std::ranges::count(plain, '\n'), 30);
  EXPECT_EQ(hashes({"--plugin", pluginFile("spring-plugin")}), plain);
}

TEST(ProgramPlugin, WhatCannotBeUsedIsRefusedWithTheReason) {
  EXPECT_TRUE(has(refusal({"/nowhere/none.so"}), "--plugin: /nowhere/none.so cannot be opened"))
      << refusal({"/nowhere/none.so"});
  const std::string old = refusal({pluginFile("old-plugin")});
  EXPECT_TRUE(has(old, "was built for another version of Stadion (interface 1.00000001; this program has 1."))
      << old;
  const std::string other = refusal({pluginFile("counting-library")});
  EXPECT_TRUE(has(other, "is no plugin of Stadion: it has no function stadion_plugin")) << other;
  const std::string script = refusal({testShow("part.evs")});
  EXPECT_TRUE(has(script, "cannot be loaded: ")) << script;
  const std::string taken = refusal({pluginFile("taken-plugin")});
  EXPECT_TRUE(has(taken, "the node type \"timer\" is already there, from engine")) << taken;
  const std::string twice = refusal({pluginFile("spring-plugin"), pluginFile("same-plugin")});
  EXPECT_TRUE(has(twice, "is called \"spring\", as a plugin that is loaded already")) << twice;
}

}  // namespace
}  // namespace stadion
