/// The launcher `./stadion`, in a house of its own: a copy of the script beside programs that only say that
/// they were called.

#include "tests/programs/program.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

namespace fs = std::filesystem;

/// A root folder with the launcher, sources to compare with, and stand-ins for every program it calls. What
/// they were called with is in `calls`.
class House {
public:
  House() {
    fs::create_directories(root_.path() / "stubs");
    fs::copy_file(STADION_SOURCE_DIR "/stadion", root_.path() / "stadion");
    for (const char* floor :
         {"engine", "pipeline", "dynamics", "profiling", "show", "bench", "cli", "assets/generator", "tests"})
      write(std::string(floor) + "/x.cpp", "// source\n");
    write("CMakeLists.txt", "# build\n"), write("CMakePresets.json", "{}\n");
    stub("id", "echo ${STUB_UID:-0}");
    stub("dpkg-query",
         "for p; do :; done; case \" $STUB_MISSING \" in *\" $p \"*) exit 1;; esac; echo installed");
    stub("apt-get", "exit ${STUB_APT:-0}");
    stub("sudo", "exit 1");
    stub("cmake", "case $1 in --build) [ -z \"$STUB_ERROR\" ] || { echo \"$STUB_ERROR\"; exit 1; };; "
                  "*) mkdir -p build/release/bin; touch build/release/build.ninja;; esac");
    makeProgram();
  }

  void write(const std::string& name, const std::string& content) { root_.write(name, content); }
  std::string path(const std::string& name) const { return root_.path() / name; }

  ProgramResult start(std::vector<std::string> arguments, std::vector<std::string> environment = {},
                      const std::string& launcher = "", const std::string& folder = "") {
    arguments.insert(arguments.begin(), launcher.empty() ? path("stadion") : launcher);
    environment.push_back("PATH=" + path("stubs") + ":/usr/bin:/bin");
    environment.push_back("CALLS=" + path("calls"));
    return runProgram({arguments, environment, folder});
  }
  std::string calls() const { return fileContent(path("calls")); }
  void forgetCalls() { fs::remove(path("calls")); }

private:
  void script(const std::string& name, const std::string& content) {
    root_.write(name, "#!/bin/sh\n" + content + "\n");
    fs::permissions(path(name), fs::perms::owner_all);
  }
  void stub(const std::string& name, const std::string& content) {
    script("stubs/" + name, "[ " + name + " = id ] || [ " + name + " = dpkg-query ] || echo \"" + name +
                                " $*\" >>\"$CALLS\"\n" + content);
  }
  void makeProgram() { script("build/release/bin/stadion", "printf '<%s>' \"$@\""); }

  TestFolder root_;
};

TEST(ProgramLauncher, BuildsTheFirstTimeAndThenOnlyStarts) {
  House house;
  const ProgramResult first = house.start({"run", "a show.evs", "--frames", "5"});
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(first.out, "<run><a show.evs><--frames><5>");
  EXPECT_TRUE(has(house.calls(), "cmake --preset release")) << house.calls();
  EXPECT_TRUE(has(house.calls(), "--target stadion\n")) << house.calls();
  EXPECT_FALSE(has(house.calls(), "apt-get"));
  EXPECT_TRUE(has(first.err, "building")) << first.err;

  house.forgetCalls();
  const ProgramResult second = house.start({"nodes"});
  EXPECT_EQ(second.out, "<nodes>");
  EXPECT_EQ(second.err, "");
  EXPECT_EQ(house.calls(), "");
}

TEST(ProgramLauncher, TheMeasurementsAreBuiltWhenTheyAreFirstCalled) {
  House house;
  house.start({"nodes"});
  house.forgetCalls();
  EXPECT_EQ(house.start({"plan", "show.evs"}).out, "<plan><show.evs>");
  EXPECT_TRUE(has(house.calls(), "--target stadion-measure")) << house.calls();
  house.forgetCalls();
  EXPECT_EQ(house.start({"profile", "show.evs"}).out, "<profile><show.evs>");
  EXPECT_EQ(house.calls(), "");
  EXPECT_EQ(house.start({"bench", "walls"}).out, "<bench><walls>");
  EXPECT_TRUE(has(house.calls(), "--target programs")) << house.calls();
  house.forgetCalls();
  EXPECT_EQ(house.start({"bench", "walls"}).out, "<bench><walls>");
  EXPECT_EQ(house.start({"nodes"}).out, "<nodes>");
  EXPECT_EQ(house.calls(), "");
}

TEST(ProgramLauncher, AChangedSourceIsBuiltAgain) {
  House house;
  house.start({"nodes"});
  house.forgetCalls();
  house.write("engine/new.cpp", "// more\n");
  house.start({"nodes"});
  EXPECT_TRUE(has(house.calls(), "--build")) << house.calls();
}

TEST(ProgramLauncher, ARemovedSourceIsBuiltAgain) {
  House house;
  house.start({"nodes"});
  house.forgetCalls();
  fs::remove(house.path("engine/x.cpp"));
  house.start({"nodes"});
  EXPECT_TRUE(has(house.calls(), "--build")) << house.calls();
}

TEST(ProgramLauncher, InstallsWhatIsMissingAsRoot) {
  House house;
  const ProgramResult r = house.start({"nodes"}, {"STUB_MISSING=libfcl-dev libegl1"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(has(house.calls(), "apt-get install -y -qq --no-install-recommends libfcl-dev libegl1"))
      << house.calls();
}

TEST(ProgramLauncher, SaysTheOneAptLineWhenItCannotBecomeRoot) {
  House house;
  const ProgramResult r = house.start({"nodes"}, {"STUB_UID=1000", "STUB_MISSING=libfcl-dev libegl1"});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.out + r.err, "apt-get install --no-install-recommends libfcl-dev libegl1"))
      << r.out << r.err;
  EXPECT_FALSE(has(house.calls(), "apt-get")) << house.calls();
  EXPECT_FALSE(has(house.calls(), "cmake")) << house.calls();
}

TEST(ProgramLauncher, SetupPeersInstallsAndBuildsTheOtherEngines) {
  House house;
  const ProgramResult r = house.start({"setup", "peers"}, {"STUB_MISSING=libode-dev libmujoco-dev"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(has(house.calls(), "--no-install-recommends libode-dev libmujoco-dev")) << house.calls();
  EXPECT_TRUE(has(house.calls(), "cmake --preset release -DSTADION_PEERS=ON")) << house.calls();
  EXPECT_TRUE(has(house.calls(), "--target programs")) << house.calls();
  EXPECT_EQ(r.out, "");

  house.forgetCalls();
  EXPECT_EQ(house.start({"nodes"}, {"STUB_MISSING=libbullet-dev"}).out, "<nodes>");
  EXPECT_EQ(house.calls(), "");  // no other program needs them
}

TEST(ProgramLauncher, SetupPeersSaysTheAptLineWhenItCannotBecomeRoot) {
  House house;
  const ProgramResult r = house.start({"setup", "peers"}, {"STUB_UID=1000", "STUB_MISSING=libbullet-dev"});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.out, "apt-get install --no-install-recommends libbullet-dev")) << r.out << r.err;
  EXPECT_FALSE(has(house.calls(), "cmake")) << house.calls();
}

TEST(ProgramLauncher, SetupKnowsOnlyPeers) {
  House house;
  const ProgramResult r = house.start({"setup", "everything"});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "./stadion setup peers")) << r.err;
  EXPECT_EQ(house.calls(), "");
}

TEST(ProgramLauncher, AFailedInstallationIsShown) {
  House house;
  const ProgramResult r = house.start({"nodes"}, {"STUB_MISSING=libfcl-dev", "STUB_APT=100"});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "installing failed")) << r.err;
}

TEST(ProgramLauncher, AFailedBuildShowsItsErrorsAndIsTriedAgain) {
  House house;
  const ProgramResult r = house.start({"nodes"}, {"STUB_ERROR=x.cpp:1:1: error: no"});
  EXPECT_EQ(r.status, 3);
  EXPECT_TRUE(has(r.err, "x.cpp:1:1: error: no")) << r.err;
  EXPECT_EQ(r.out, "");
  EXPECT_EQ(house.start({"nodes"}).out, "<nodes>");
}

TEST(ProgramLauncher, WorksFromAnotherFolderAndThroughALink) {
  House house;
  const TestFolder elsewhere;
  fs::create_symlink(house.path("stadion"), elsewhere.path() / "play");
  const ProgramResult r = house.start({"run", "mine.evs"}, {}, elsewhere.path() / "play", elsewhere.path());
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.out, "<run><mine.evs>");
  EXPECT_TRUE(fs::exists(house.path("build/release/.built")));
}

TEST(ProgramLauncher, OnlyTheTestCommandInstallsWhatOnlyTheTestsNeed) {
  House house;
  const std::vector<std::string> missing{"STUB_MISSING=chromium ffmpeg assimp-testmodels valgrind xvfb"};
  EXPECT_EQ(house.start({"run", "a.evs"}, missing).status, 0);
  EXPECT_FALSE(has(house.calls(), "apt-get")) << house.calls();
  const ProgramResult r = house.start({"test"}, missing);
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(has(house.calls(), "--no-install-recommends xvfb chromium ffmpeg assimp-testmodels valgrind"))
      << house.calls();
}

TEST(ProgramLauncher, TestBuildsEverythingAndPassesItsArgumentsOn) {
  House house;
  const ProgramResult r = house.start({"test", "--only", "Same pictures"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.out, "<test><--only><Same pictures>");
  EXPECT_TRUE(has(house.calls(), "--target all")) << house.calls();
}

// A folder in the place of the lock stands for a checkout that cannot be written: root may write anywhere
// else.
TEST(ProgramLauncher, WhatIsBuiltStartsFromAFolderThatCannotBeWritten) {
  House house;
  house.start({"nodes"});
  fs::remove(house.path("build/.lock"));
  fs::create_directory(house.path("build/.lock"));
  const ProgramResult r = house.start({"run", "a.evs"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.out, "<run><a.evs>");
  EXPECT_EQ(r.err, "");
}

TEST(ProgramLauncher, WithoutABuildAFolderThatCannotBeWrittenIsOneClearMessage) {
  House house;
  fs::remove_all(house.path("build"));
  house.write("build", "a file is in the way");
  for (const char* command : {"run", "test"}) {
    const ProgramResult r = house.start({command});
    EXPECT_EQ(r.status, 2) << r.err;
    EXPECT_EQ(r.out, "");
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << r.err;
    EXPECT_TRUE(has(r.err, "cannot write into " +
                               fs::canonical(house.path("stadion")).parent_path().string() + "/build"))
        << r.err;
    EXPECT_EQ(house.calls(), "");
  }
}

TEST(ProgramLauncher, AnOutdatedBuildThatCannotBeRenewedIsNotStarted) {
  House house;
  house.start({"nodes"});
  house.forgetCalls();
  fs::remove(house.path("build/.lock"));
  fs::create_directory(house.path("build/.lock"));
  house.write("engine/new.cpp", "// more\n");
  const ProgramResult r = house.start({"nodes"});
  EXPECT_EQ(r.status, 2);
  EXPECT_EQ(r.out, "");
  EXPECT_TRUE(has(r.err, "older than its sources")) << r.err;
  EXPECT_EQ(house.calls(), "");
}

TEST(ProgramLauncher, FuzzingWithoutABuildOfItsTargetsSaysWhatMakesOne) {
  const TestFolder root;
  root.write("tests/fuzz/targets/walls.cpp", "// target\n");
  fs::copy_file(STADION_SOURCE_DIR "/tests/fuzz/run", root.path() / "tests/fuzz/run");
  const ProgramResult r = runProgram({{root.path() / "tests/fuzz/run", "walls"}});
  EXPECT_EQ(r.status, 2);
  EXPECT_EQ(r.err, "fuzz: there is no build of libFuzzer's targets; ./stadion fuzz makes one\n");
  EXPECT_FALSE(fs::exists(root.path() / "build"));
}

TEST(ProgramFullLauncher, TheRealOneAddsLittleToASecondStart) {
  // Only where the launcher has built this very tree; elsewhere it would begin to build.
  if (!fs::exists(STADION_SOURCE_DIR "/build/release/.built") ||
      std::string(STADION_BINARY_DIR) != STADION_SOURCE_DIR "/build/release")
    GTEST_SKIP() << "not built by the launcher";
  double shortest = 1e9;
  for (int i = 0; i < 3; ++i) {
    const ProgramResult launched = runProgram({{STADION_SOURCE_DIR "/stadion", "--version"}});
    if (launched.err != "") GTEST_SKIP() << "sources are newer than the build";
    shortest = std::min(shortest, launched.seconds - stadionProgram({"--version"}).seconds);
  }
  RecordProperty("added_ms", static_cast<int>(1000 * shortest));
  EXPECT_LT(shortest, 0.5);
}

}  // namespace
}  // namespace stadion
