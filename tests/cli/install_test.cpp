/// An installed copy needs no checkout: it plays, and programs of others are built on it.

#include "tests/programs/program.h"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace stadion {
namespace {

namespace fs = std::filesystem;

const std::string kRoot = STADION_SOURCE_DIR;

/// What `cmake --install` puts into an empty folder; installed once for all tests.
class ProgramInstall : public testing::Test {
protected:
  static void SetUpTestSuite() {
    folder_ = new TestFolder;
    const ProgramResult r =
        runProgram({{"cmake", "--install", STADION_BINARY_DIR, "--prefix", prefix(), "--strip"}});
    ASSERT_EQ(r.status, 0) << r.err;
  }
  static void TearDownTestSuite() { delete folder_, folder_ = nullptr; }

  static std::string prefix() { return folder_->path() / "usr"; }
  static std::string path() { return "PATH=" + prefix() + "/bin:/usr/local/bin:/usr/bin:/bin"; }

  /// Configures and builds an example, as if `missing` packages were not installed. Returns the path of its
  /// program, or of another file that the build makes.
  static std::string built(const std::string& name, const std::string& file = {},
                           const std::vector<std::string>& missing = {}) {
    const std::string build = folder_->path() / name, source = folder_->path() / ("source-" + name);
    fs::copy(kRoot + "/examples/" + name, source, fs::copy_options::recursive);
    std::vector<std::string> configure{"cmake", "-S", source, "-B", build, "-G", "Ninja"};
    configure.insert(configure.end(), {"-DCMAKE_PREFIX_PATH=" + prefix(), "-DCMAKE_BUILD_TYPE=Release",
                                       "-DCMAKE_CXX_FLAGS=-O0 -Wall -Wextra -Werror"});
    for (const std::string& package : missing)
      configure.push_back("-DCMAKE_DISABLE_FIND_PACKAGE_" + package + "=ON");
    const ProgramResult made = runProgram({configure});
    EXPECT_EQ(made.status, 0) << made.out << made.err;
    const ProgramResult compiled = runProgram({{"cmake", "--build", build}});
    EXPECT_EQ(compiled.status, 0) << compiled.out << compiled.err;
    return build + (file.empty() ? "/" + name : file);
  }

  static TestFolder* folder_;
};
TestFolder* ProgramInstall::folder_ = nullptr;

TEST_F(ProgramInstall, AnInstalledCopyPlaysAShow) {
  const std::string out = folder_->path() / "pictures";
  const ProgramResult r =
      runProgram({{prefix() + "/bin/stadion", "run", prefix() + "/share/stadion/scripts/kick.evs", "--walls",
                   "desktop", "--size", "96x72", "--frames", "3", "--out", out},
                  {path()},
                  folder_->path()});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(fs::exists(out + "/contact-sheet.png")) << r.err;
}

// A file without a component is in no Debian package.
TEST_F(ProgramInstall, EachFileIsInOneOfThePackages) {
  std::ifstream rules(STADION_BINARY_DIR "/cmake_install.cmake");
  std::string component;
  int files = 0;
  for (std::string line; std::getline(rules, line);) {
    if (const std::size_t at = line.find("CMAKE_INSTALL_COMPONENT STREQUAL \""); at != std::string::npos)
      component = line.substr(at);
    if (!has(line, "file(INSTALL DESTINATION")) continue;
    ++files;
    EXPECT_TRUE(has(component, "\"runtime\"") || has(component, "\"development\"")) << component << line;
  }
  EXPECT_GT(files, 20);
}

TEST_F(ProgramInstall, HasManPagesAndCompletion) {
  const std::string page = fileContent(prefix() + "/share/man/man1/stadion.1");
  EXPECT_TRUE(page.starts_with(".TH stadion 1")) << page.substr(0, 80);
  for (const char* script :
       {"/share/bash-completion/completions/stadion", "/share/zsh/vendor-completions/_stadion",
        "/share/fish/vendor_completions.d/stadion.fish"})
    EXPECT_TRUE(has(fileContent(prefix() + script), "stadion")) << script;
}

// bash calls the function with the words and where the cursor is.
TEST_F(ProgramInstall, BashCompletesAnOption) {
  const std::string line =
      "source " + prefix() +
      "/share/bash-completion/completions/stadion; COMP_WORDS=(stadion run --stress-m); COMP_CWORD=2; "
      "_stadion; echo \"${COMPREPLY[@]}\"";
  EXPECT_EQ(runProgram({{"bash", "-c", line}, {path()}}).out, "--stress-max\n");
}

// It makes words of --pace=f at the sign, and of a room's name a file that is not there.
TEST_F(ProgramInstall, BashCompletesAValue) {
  const auto completed = [&](const std::string& words, const char* cursor) {
    const std::string line = "source " + prefix() +
                             "/share/bash-completion/completions/stadion; COMP_WORDS=(stadion " + words +
                             "); COMP_CWORD=" + cursor + "; _stadion 2>/dev/null; echo \"${COMPREPLY[@]}\"";
    return runProgram({{"bash", "-c", line}, {path()}}).out;
  };
  EXPECT_EQ(completed("run --pace = f", "4"), "free float\n");
  EXPECT_EQ(completed("run --pace =", "3"), "free lock float\n");
  EXPECT_EQ(completed("run --walls cave", "3"), "cave-blended cave4 cave6\n");
}

TEST_F(ProgramInstall, HasServicesForHallsThatSystemdAccepts) {
  const std::string units = prefix() + "/lib/systemd/system/";
  for (const char* unit : {"stadion@.service", "stadion-display.service"}) {
    const std::string text = fileContent(units + unit);
    EXPECT_TRUE(has(text, "ExecStart=" + prefix() + "/")) << text;
    EXPECT_FALSE(has(text, "@PREFIX@")) << unit;
  }
  EXPECT_TRUE(has(fileContent(prefix() + "/lib/sysusers.d/stadion.conf"), "u stadion"));
  EXPECT_EQ(fs::status(prefix() + "/lib/stadion/stadion-display").permissions() & fs::perms::owner_exec,
            fs::perms::owner_exec);
  const std::string instance = folder_->path() / "stadion@hall.service";
  fs::copy_file(units + "stadion@.service", instance);
  const ProgramResult r =
      runProgram({{"systemd-analyze", "verify", "--man=no", instance, units + "stadion-display.service"}});
  if (r.status == 127) GTEST_SKIP() << "needs systemd-analyze: apt-get install systemd";
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_FALSE(has(r.err, "Unknown")) << r.err;
}

TEST_F(ProgramInstall, NamesNoPathOfTheCheckout) {
  for (const char* program : {"/bin/stadion", "/lib/stadion/stadion-import", "/lib/stadion/stadion-wall"})
    EXPECT_FALSE(has(fileContent(prefix() + program), kRoot + "/")) << program;
  for (const auto& entry : fs::recursive_directory_iterator(prefix()))
    if (entry.path().extension() == ".cmake") {
      EXPECT_FALSE(has(fileContent(entry.path()), kRoot + "/")) << entry.path();
    }
}

// They compile for as long as many tests take.
class ProgramFullInstall : public ProgramInstall {};

TEST_F(ProgramFullInstall, AProgramPlaysAShow) {
  const std::string program = built("play_show"), picture = folder_->path() / "ball.png";
  const ProgramResult r =
      runProgram({{program, prefix() + "/share/stadion/scripts/kick.evs", "ball", picture}, {path()}});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(has(r.out, "after 60 frames")) << r.out;
  EXPECT_TRUE(fs::exists(picture));
}

// It needs none of the packages of the other targets.
TEST_F(ProgramFullInstall, AProgramEmbedsDynamics) {
  const ProgramResult r = runProgram({{built("embed_dynamics", {}, {"CycloneDDS", "nlohmann_json"})}});
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_TRUE(has(r.out, "10 of 10 crates rest")) << r.out;
}

TEST_F(ProgramFullInstall, APluginAddsANodeType) {
  const std::string plugin = built("node_plugin", "/libnode_plugin.so");
  const std::string show = folder_->path() / "spring.evs";
  std::ofstream(show) << "path( name=way, key=\"0, 0,0,0\", key=\"1, 3,0,0\" )\nspring( target=way )\n";
  const ProgramResult r =
      runProgram({{prefix() + "/bin/stadion", "hash", show, "--frames", "3", "--plugin", plugin},
                  {path()},
                  folder_->path()});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(std::ranges::count(r.out, '\n'), 3) << r.out;
}

}  // namespace
}  // namespace stadion
