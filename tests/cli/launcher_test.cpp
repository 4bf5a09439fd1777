/// The launcher `./stadion`, in a checkout of its own: a copy of the script beside programs that only say that
/// they were called.

#include "tests/programs/program.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

namespace fs = std::filesystem;

/// A root folder with the launcher, sources to compare with, and stand-ins for every program it calls. What
/// they were called with is in `calls`.
class Checkout {
public:
  Checkout() {
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
  /// Writes a file that is newer than what has been built.
  void edit(const std::string& name, const std::string& content) {
    write(name, content);
    makeNewer(name);
  }
  /// Time stamps of files are some milliseconds coarse, and a build here takes no longer.
  void makeNewer(const std::string& name) {
    fs::last_write_time(path(name), fs::file_time_type::clock::now() + std::chrono::seconds(1));
  }
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
  Checkout checkout;
  const ProgramResult first = checkout.start({"run", "a show.evs", "--frames", "5"});
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(first.out, "<run><a show.evs><--frames><5>");
  EXPECT_TRUE(has(checkout.calls(), "cmake --preset release")) << checkout.calls();
  EXPECT_TRUE(has(checkout.calls(), "--target stadion\n")) << checkout.calls();
  EXPECT_FALSE(has(checkout.calls(), "apt-get"));
  EXPECT_TRUE(has(first.err, "building")) << first.err;

  checkout.forgetCalls();
  const ProgramResult second = checkout.start({"nodes"});
  EXPECT_EQ(second.out, "<nodes>");
  EXPECT_EQ(second.err, "");
  EXPECT_EQ(checkout.calls(), "");
}

TEST(ProgramLauncher, TheMeasurementsAreBuiltWhenTheyAreFirstCalled) {
  Checkout checkout;
  checkout.start({"nodes"});
  checkout.forgetCalls();
  EXPECT_EQ(checkout.start({"plan", "show.evs"}).out, "<plan><show.evs>");
  EXPECT_TRUE(has(checkout.calls(), "--target stadion-measure")) << checkout.calls();
  checkout.forgetCalls();
  EXPECT_EQ(checkout.start({"profile", "show.evs"}).out, "<profile><show.evs>");
  EXPECT_EQ(checkout.calls(), "");
  EXPECT_EQ(checkout.start({"bench", "walls"}).out, "<bench><walls>");
  EXPECT_TRUE(has(checkout.calls(), "--target programs")) << checkout.calls();
  checkout.forgetCalls();
  EXPECT_EQ(checkout.start({"bench", "walls"}).out, "<bench><walls>");
  EXPECT_EQ(checkout.start({"nodes"}).out, "<nodes>");
  EXPECT_EQ(checkout.calls(), "");
}

TEST(ProgramLauncher, AChangedSourceIsBuiltAgain) {
  Checkout checkout;
  checkout.start({"nodes"});
  checkout.forgetCalls();
  checkout.edit("engine/new.cpp", "// more\n");
  checkout.start({"nodes"});
  EXPECT_TRUE(has(checkout.calls(), "--build")) << checkout.calls();
}

TEST(ProgramLauncher, ARemovedSourceIsBuiltAgain) {
  Checkout checkout;
  checkout.start({"nodes"});
  checkout.forgetCalls();
  fs::remove(checkout.path("engine/x.cpp"));
  checkout.makeNewer("engine");
  checkout.start({"nodes"});
  EXPECT_TRUE(has(checkout.calls(), "--build")) << checkout.calls();
}

TEST(ProgramLauncher, InstallsWhatIsMissingAsRoot) {
  Checkout checkout;
  const ProgramResult r = checkout.start({"nodes"}, {"STUB_MISSING=libfcl-dev libegl1"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(has(checkout.calls(), "apt-get install -y -qq --no-install-recommends libfcl-dev libegl1"))
      << checkout.calls();
}

TEST(ProgramLauncher, SaysTheOneAptLineWhenItCannotBecomeRoot) {
  Checkout checkout;
  const ProgramResult r = checkout.start({"nodes"}, {"STUB_UID=1000", "STUB_MISSING=libfcl-dev libegl1"});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.out + r.err, "apt-get install --no-install-recommends libfcl-dev libegl1"))
      << r.out << r.err;
  EXPECT_FALSE(has(checkout.calls(), "apt-get")) << checkout.calls();
  EXPECT_FALSE(has(checkout.calls(), "cmake")) << checkout.calls();
}

TEST(ProgramLauncher, SetupPeersInstallsAndBuildsTheOtherEngines) {
  Checkout checkout;
  const ProgramResult r = checkout.start({"setup", "peers"}, {"STUB_MISSING=libode-dev libmujoco-dev"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(has(checkout.calls(), "--no-install-recommends libode-dev libmujoco-dev")) << checkout.calls();
  EXPECT_TRUE(has(checkout.calls(), "cmake --preset release -DSTADION_PEERS=ON")) << checkout.calls();
  EXPECT_TRUE(has(checkout.calls(), "--target programs")) << checkout.calls();
  EXPECT_EQ(r.out, "");

  checkout.forgetCalls();
  EXPECT_EQ(checkout.start({"nodes"}, {"STUB_MISSING=libbullet-dev"}).out, "<nodes>");
  EXPECT_EQ(checkout.calls(), "");  // no other program needs them
}

TEST(ProgramLauncher, SetupPeersSaysTheAptLineWhenItCannotBecomeRoot) {
  Checkout checkout;
  const ProgramResult r = checkout.start({"setup", "peers"}, {"STUB_UID=1000", "STUB_MISSING=libbullet-dev"});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.out, "apt-get install --no-install-recommends libbullet-dev")) << r.out << r.err;
  EXPECT_FALSE(has(checkout.calls(), "cmake")) << checkout.calls();
}

TEST(ProgramLauncher, SetupKnowsOnlyPeers) {
  Checkout checkout;
  const ProgramResult r = checkout.start({"setup", "everything"});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "./stadion setup peers")) << r.err;
  EXPECT_EQ(checkout.calls(), "");
}

TEST(ProgramLauncher, AFailedInstallationIsShown) {
  Checkout checkout;
  const ProgramResult r = checkout.start({"nodes"}, {"STUB_MISSING=libfcl-dev", "STUB_APT=100"});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "installing failed")) << r.err;
}

TEST(ProgramLauncher, AFailedBuildShowsItsErrorsAndIsTriedAgain) {
  Checkout checkout;
  const ProgramResult r = checkout.start({"nodes"}, {"STUB_ERROR=x.cpp:1:1: error: no"});
  EXPECT_EQ(r.status, 3);
  EXPECT_TRUE(has(r.err, "x.cpp:1:1: error: no")) << r.err;
  EXPECT_EQ(r.out, "");
  EXPECT_EQ(checkout.start({"nodes"}).out, "<nodes>");
}

TEST(ProgramLauncher, WorksFromAnotherFolderAndThroughALink) {
  Checkout checkout;
  const TestFolder elsewhere;
  fs::create_symlink(checkout.path("stadion"), elsewhere.path() / "play");
  const ProgramResult r =
      checkout.start({"run", "mine.evs"}, {}, elsewhere.path() / "play", elsewhere.path());
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.out, "<run><mine.evs>");
  EXPECT_TRUE(fs::exists(checkout.path("build/release/.built")));
}

TEST(ProgramLauncher, OnlyTheTestCommandInstallsWhatOnlyTheTestsNeed) {
  Checkout checkout;
  const std::vector<std::string> missing{"STUB_MISSING=chromium ffmpeg assimp-testmodels valgrind xvfb"};
  EXPECT_EQ(checkout.start({"run", "a.evs"}, missing).status, 0);
  EXPECT_FALSE(has(checkout.calls(), "apt-get")) << checkout.calls();
  const ProgramResult r = checkout.start({"test"}, missing);
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(
      has(checkout.calls(), "--no-install-recommends xvfb chromium ffmpeg assimp-testmodels valgrind"))
      << checkout.calls();
}

TEST(ProgramLauncher, TestBuildsEverythingAndPassesItsArgumentsOn) {
  Checkout checkout;
  const ProgramResult r = checkout.start({"test", "--only", "Same pictures"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.out, "<test><--only><Same pictures>");
  EXPECT_TRUE(has(checkout.calls(), "--target all")) << checkout.calls();
}

// A folder in the place of the lock stands for a checkout that cannot be written: root may write anywhere
// else.
TEST(ProgramLauncher, WhatIsBuiltStartsFromAFolderThatCannotBeWritten) {
  Checkout checkout;
  checkout.start({"nodes"});
  fs::remove(checkout.path("build/.lock"));
  fs::create_directory(checkout.path("build/.lock"));
  const ProgramResult r = checkout.start({"run", "a.evs"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.out, "<run><a.evs>");
  EXPECT_EQ(r.err, "");
}

TEST(ProgramLauncher, WithoutABuildAFolderThatCannotBeWrittenIsOneClearMessage) {
  Checkout checkout;
  fs::remove_all(checkout.path("build"));
  checkout.write("build", "a file is in the way");
  for (const char* command : {"run", "test"}) {
    const ProgramResult r = checkout.start({command});
    EXPECT_EQ(r.status, 2) << r.err;
    EXPECT_EQ(r.out, "");
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << r.err;
    EXPECT_TRUE(has(r.err, "cannot write into " +
                               fs::canonical(checkout.path("stadion")).parent_path().string() + "/build"))
        << r.err;
    EXPECT_EQ(checkout.calls(), "");
  }
}

TEST(ProgramLauncher, AnOutdatedBuildThatCannotBeRenewedIsNotStarted) {
  Checkout checkout;
  checkout.start({"nodes"});
  checkout.forgetCalls();
  fs::remove(checkout.path("build/.lock"));
  fs::create_directory(checkout.path("build/.lock"));
  checkout.edit("engine/new.cpp", "// more\n");
  const ProgramResult r = checkout.start({"nodes"});
  EXPECT_EQ(r.status, 2);
  EXPECT_EQ(r.out, "");
  EXPECT_TRUE(has(r.err, "older than its sources")) << r.err;
  EXPECT_EQ(checkout.calls(), "");
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
