/// Includes go to lower layers, never up or sideways, each foreign library has its
/// one folder, and what is simulated calls no function whose results differ between machines.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = STADION_SOURCE_DIR;

struct Line {
  std::string file;  ///< relative to the root
  std::size_t number;
  std::string text;  ///< without comments and string contents

  std::string place() const { return file + ":" + std::to_string(number) + ": " + text; }
};

/// The line without `//` comments and, but in includes, without what stands between quotes.
std::string codeOf(const std::string& line) {
  static const std::regex strings(R"("([^"\\]|\\.)*")");
  std::string code = line;
  if (code.find('"') != std::string::npos && code.find("#include") == std::string::npos)
    code = std::regex_replace(code, strings, "\"\"");
  return code.substr(0, code.find("//"));
}

std::vector<Line> readBelow(const std::string& folder) {
  std::vector<Line> lines;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
    const fs::path& p = entry.path();
    if (p.extension() != ".h" && p.extension() != ".cpp") continue;
    const std::string file = fs::relative(p, kRoot).string();
    std::ifstream in(p);
    std::string text;
    for (std::size_t n = 1; std::getline(in, text); ++n) lines.push_back({file, n, codeOf(text)});
  }
  EXPECT_FALSE(lines.empty()) << folder;
  return lines;
}

/// Each folder is read once.
const std::vector<Line>& linesBelow(const std::string& folder) {
  static std::map<std::string, std::vector<Line>> read;
  const auto known = read.find(folder);
  return known != read.end() ? known->second : read.emplace(folder, readBelow(folder)).first->second;
}

const std::vector<std::string> kLayers{"engine", "pipeline", "dynamics", "profiling", "show", "bench", "cli"};

/// Which layers a file may include.
std::set<std::string> allowedFor(const std::string& file) {
  const std::string layer = file.substr(0, file.find('/'));
  if (layer == "cli") return {kLayers.begin(), kLayers.end()};
  if (layer == "show") return {"engine", "pipeline", "dynamics", "profiling", "show"};
  if (layer == "bench") return {"engine", "pipeline", "dynamics", "profiling", "bench"};
  return {"engine", layer};
}

/// The name in `#include "name"`, or with other signs around it; empty if the line is none.
std::string included(const std::string& code, char open, char close) {
  if (!code.starts_with('#') || code.find("include") == std::string::npos) return "";
  const std::size_t begin = code.find(open);
  return begin == std::string::npos ? "" : code.substr(begin + 1, code.find(close, begin + 1) - begin - 1);
}

TEST(Layering, IncludesGoDownAndNeverUpOrSideways) {
  for (const std::string& layer : kLayers)
    for (const Line& line : linesBelow(layer)) {
      const std::string name = included(line.text, '"', '"');
      if (name.empty()) continue;
      EXPECT_TRUE(allowedFor(line.file).contains(name.substr(0, name.find('/')))) << line.place();
    }
}

TEST(Layering, IncludesAreRelativeToTheRoot) {
  for (const char* folder : {"engine", "pipeline", "dynamics", "profiling", "show", "bench", "cli", "tests"})
    for (const Line& line : linesBelow(folder)) {
      const std::string name = included(line.text, '"', '"');
      if (name.empty()) continue;
      EXPECT_EQ(name.find(".."), std::string::npos) << line.place();
      EXPECT_TRUE(fs::exists(kRoot / name)) << line.place();
    }
}

TEST(Layering, NoOtherFolderIncludesTheImporterProgram) {
  for (const std::string& layer : kLayers)
    for (const Line& line : linesBelow(layer))
      if (!line.file.starts_with("engine/asset/importer_program/")) {
        EXPECT_FALSE(included(line.text, '"', '"').starts_with("engine/asset/importer_program/"))
            << line.place();
      }
}

std::string folderOf(const std::string& file) {
  return file.substr(0, file.rfind('/'));
}

/// The folders of a layer or of the tests, and one include for each folder that another one includes.
using Folders = std::map<std::string, std::map<std::string, std::string>>;
Folders foldersOf(const std::string& part) {
  Folders folders;
  for (const Line& line : linesBelow(part)) {
    const std::string name = included(line.text, '"', '"'), folder = folderOf(line.file);
    if (name.starts_with(part + "/") && folderOf(name) != folder)
      folders[folder].emplace(folderOf(name), line.place());
  }
  return folders;
}

/// A way along includes from the last folder of `way` back to its first; empty if there is none.
std::vector<std::string> cycleFrom(const Folders& folders, std::vector<std::string> way,
                                   std::set<std::string>& seen) {
  const auto next = folders.find(way.back());
  if (next == folders.end()) return {};
  for (const auto& [folder, place] : next->second) {
    if (folder == way.front()) return way;
    if (!seen.insert(folder).second) continue;
    way.push_back(folder);
    if (auto cycle = cycleFrom(folders, way, seen); !cycle.empty()) return cycle;
    way.pop_back();
  }
  return {};
}

TEST(Layering, TheFoldersOfALayerFormNoCycle) {
  for (const char* part :
       {"engine", "pipeline", "dynamics", "profiling", "show", "bench", "cli", "assets/generator"}) {
    const Folders folders = foldersOf(part);
    for (const auto& [folder, others] : folders) {
      std::set<std::string> seen;
      const std::vector<std::string> cycle = cycleFrom(folders, {folder}, seen);
      for (std::size_t i = 0; i < cycle.size(); ++i) {
        const std::string& to = cycle[(i + 1) % cycle.size()];
        ADD_FAILURE() << cycle[i] << " -> " << to << ", " << folders.at(cycle[i]).at(to);
      }
      if (!cycle.empty()) break;
    }
  }
}

/// Reads the lines of a header and collects the classes that it defines in namespaces, by their full names.
class HeaderClasses {
public:
  explicit HeaderClasses(std::map<std::string, Line>& found) : found_(found) {}

  void take(const Line& line) {
    static const std::regex named(R"(^namespace ([\w:]*) ?\{)");
    static const std::regex defines(
        R"(^(class|struct|union|enum( class)?) (alignas\(\w+\) )?([\w:]+)[^;<]*(\{|$))");
    std::smatch part;
    const bool inNamespaces = depth_ == names_.size();
    if (inNamespaces && std::regex_search(line.text, part, named)) {
      names_.push_back(part[1]);
      ++depth_;
      return;
    }
    if (inNamespaces && std::regex_search(line.text, part, defines)) add(part[4], line);
    for (const char c : line.text) count(c);
  }

private:
  void add(const std::string& name, const Line& line) {
    std::string full;
    for (const std::string& n : names_) full += n + "::";
    // Names in an anonymous namespace belong to one file.
    if (names_.empty() || names_.back().empty()) return;
    const auto [known, isNew] = found_.emplace(full + name, line);
    EXPECT_TRUE(isNew || known->second.file == line.file)
        << full << name << ": " << known->second.place() << ", " << line.place();
  }

  void count(char c) {
    if (c == '{') ++depth_;
    if (c != '}' || depth_ == 0) return;
    if (depth_ == names_.size()) names_.pop_back();
    --depth_;
  }

  std::map<std::string, Line>& found_;
  std::vector<std::string> names_;  ///< of the open namespaces
  std::size_t depth_ = 0;           ///< of braces
};

// One program may link both: two definitions of one name break the one-definition rule.
TEST(Layering, NoTwoHeadersDefineClassesOfOneName) {
  std::map<std::string, Line> found;
  for (const char* folder :
       {"engine", "pipeline", "dynamics", "profiling", "show", "bench", "cli", "tests"}) {
    std::map<std::string, HeaderClasses> headers;
    for (const Line& line : linesBelow(folder))
      if (line.file.ends_with(".h")) headers.try_emplace(line.file, found).first->second.take(line);
  }
  EXPECT_TRUE(found.contains("stadion::Scene"));
  EXPECT_GT(found.size(), 1000u);
}

TEST(Layering, NoFolderHasMoreThanFortyFiles) {
  constexpr int kMost = 40;
  std::map<std::string, int> files;
  for (const char* part :
       {"engine", "pipeline", "dynamics", "profiling", "show", "bench", "cli", "assets/generator"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / part))
      if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp")
        ++files[fs::relative(entry.path().parent_path(), kRoot).string()];
  for (const auto& [folder, count] : files) EXPECT_LE(count, kMost) << folder;
}

TEST(Layering, OnlyProgramsIncludeCli11) {
  for (const std::string& layer : kLayers) {
    if (layer == "cli") continue;
    for (const Line& line : linesBelow(layer)) {
      const std::string library = included(line.text, '<', '>');
      // The program of a bench has a command line of its own.
      if (line.file.starts_with("bench/")) continue;
      EXPECT_FALSE(library.starts_with("CLI/")) << line.place();
    }
  }
}

TEST(Layering, TheLibraryThatPlaysShowsWritesToNoTerminal) {
  const std::regex writes(R"(\b(stderr|stdout|printf|puts|perror|cout|cerr|clog)\b)");
  for (const Line& line : linesBelow("show")) {
    if (line.file == "show/recording/crash_report.cpp") continue;  // a crash has no other place left
    EXPECT_FALSE(std::regex_search(line.text, writes)) << line.place();
  }
}

/// The files that include a header whose name begins so.
std::set<std::string> includersOf(const std::string& prefix) {
  std::set<std::string> files;
  for (const std::string& layer : kLayers)
    for (const Line& line : linesBelow(layer))
      if (included(line.text, '<', '>').starts_with(prefix)) files.insert(line.file);
  return files;
}

TEST(Layering, EachForeignLibraryIsIncludedInFewFiles) {
  using Files = std::set<std::string>;
  // The programs of `bench walls` link what they draw with; the product does not know them.
  const std::string osg = "bench/walls/osg/", floor = "bench/walls/floor/";
  EXPECT_EQ(includersOf("GL/osmesa"), (Files{"pipeline/target/osmesa_provider.cpp", osg + "osg_context.h"}));
  EXPECT_EQ(includersOf("EGL/"), (Files{"pipeline/target/egl_provider.cpp", floor + "headless_context.cpp",
                                        osg + "osg_context.h"}));
  EXPECT_EQ(includersOf("osg"), (Files{osg + "osg_context.h", osg + "osg_walls.cpp"}));
  EXPECT_EQ(includersOf("GLFW/"), Files{"pipeline/target/glfw_windows.cpp"});
  EXPECT_EQ(includersOf("meshoptimizer"),
            (Files{"engine/asset/importer_program/gltf/meshopt_view.cpp", "engine/asset/simplify.cpp"}));
  EXPECT_EQ(includersOf("zip"), Files{"engine/hall_formats/zip_archive.cpp"});
  EXPECT_EQ(includersOf("pugixml"),
            (Files{"engine/hall_formats/mpcdi_document.cpp", "engine/hall_formats/mpcdi_writer.cpp",
                   "engine/hall_formats/warp_formats_grid.cpp"}));
  EXPECT_EQ(includersOf("httplib"), Files{"show/web/http_library/http_library.cpp"});
  EXPECT_EQ(includersOf("sndfile"), Files{"engine/asset/sound_file.cpp"});
  EXPECT_EQ(includersOf("hwloc"), Files{"pipeline/platform/topology.cpp"});
  EXPECT_EQ(includersOf("lo/"), Files{"pipeline/device/osc_server.cpp"});
  EXPECT_EQ(includersOf("vrpn"), Files{"pipeline/device/vrpn_trackers.cpp"});
  EXPECT_EQ(includersOf("AL/"), Files{"pipeline/sound/sound_device.cpp"});
  EXPECT_EQ(includersOf("fcl/"), Files{"dynamics/shapes/mesh_distance.cpp"});
  EXPECT_EQ(includersOf("GL/gl"), (Files{"pipeline/gl/gl_table.h", floor + "gl.h"}));
  EXPECT_EQ(includersOf("btBulletDynamicsCommon"), Files{"bench/dynamics/engine_bullet.cpp"});
  EXPECT_EQ(includersOf("ode/"), Files{"bench/dynamics/engine_ode.cpp"});
  EXPECT_EQ(includersOf("mujoco/"), Files{"bench/dynamics/engine_mujoco.cpp"});
  // What reads hostile files lives in a program of its own.
  const Files assimp = includersOf("assimp/");
  EXPECT_FALSE(assimp.empty());
  for (const std::string& file : assimp)
    EXPECT_TRUE(file.starts_with("engine/asset/importer_program/assimp/")) << file;
  EXPECT_EQ(includersOf("draco/"), Files{"engine/asset/importer_program/gltf/draco_mesh.cpp"});
  EXPECT_EQ(includersOf("OpenEXR/"), Files{"engine/asset/importer_program/environment/exr_picture.cpp"});
  EXPECT_EQ(includersOf("webp/"), Files{"engine/asset/importer_program/mesh/picture_decoder.cpp"});
}

// What Eigen makes of a processor's instructions is decided there.
TEST(Layering, EigenIsReadAsMathsSays) {
  std::string file;
  bool decided = false;
  for (const std::string& layer : kLayers)
    for (const Line& line : linesBelow(layer)) {
      if (line.file != file) {
        file = line.file;
        decided = file == "engine/maths/eigen.h";
      }
      if (included(line.text, '"', '"') == "engine/maths/eigen.h") decided = true;
      if (!included(line.text, '<', '>').starts_with("Eigen/")) continue;
      EXPECT_TRUE(decided) << line.place() << ": include engine/maths/eigen.h before";
    }
}

// The sanitizer builds, which few changes are tried with before they are pushed: clang 14 cannot read the ranges of
// libstdc++ 12 that return a part of a range, and ThreadSanitizer knows no fences.
TEST(Layering, WhatTheSanitizerBuildsCannotCompileIsNotUsed) {
  const std::regex refused(
      R"(ranges::(unique|remove|remove_if|partition|stable_partition|rotate|search|find_end|equal_range)\b|__builtin_shuffle\(|atomic_thread_fence)");
  EXPECT_TRUE(std::regex_search("std::ranges::unique(list)", refused));
  EXPECT_FALSE(std::regex_search("std::unique(list.begin(), list.end())", refused));
  for (const char* folder : {"engine", "pipeline", "dynamics", "profiling", "show", "bench", "cli", "tests"})
    for (const Line& line : linesBelow(folder))
      EXPECT_FALSE(std::regex_search(line.text, refused)) << line.place();
}

TEST(Layering, WhatIsSimulatedCallsNoFunctionThatDiffersBetweenMachines) {
  // sqrt and fabs, and what IEEE 754 or integers make exact (floor, ceil, ...), are the same everywhere.
  const std::regex call(
      R"((^|[^A-Za-z0-9_:.>]|std::|Eigen::numext::|::)(sin|cos|tan|sincos|asin|acos|atan|atan2|sinh|cosh|tanh|exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|hypot|fma|erf|lgamma|tgamma)[fl]?\s*\(\s*[^)\s])");
  const std::regex own(R"(det::\w+)");
  const std::regex hidden(
      R"(AngleAxis|Rotation2D|\.slerp\(|angularDistance|eulerAngles|setFromTwoVectors|FromTwoVectors)");
  for (const char* layer : {"engine", "dynamics"})
    for (const Line& line : linesBelow(layer)) {
      // rotations.cpp lies in the namespace of these functions and calls its neighbours.
      if (line.file.starts_with("engine/maths/")) continue;
      std::string code = line.text;
      if (code.find_first_of("(<") == std::string::npos) continue;
      if (code.find("det::") != std::string::npos) code = std::regex_replace(code, own, "det");
      EXPECT_FALSE(std::regex_search(code, call)) << line.place();
      EXPECT_FALSE(std::regex_search(code, hidden)) << line.place();
    }
  const std::regex fromLibrary(
      R"(std::(sin|cos|tan|a?sinh?|acos|atan2?|exp2?|expm1|log\w*|pow|cbrt|hypot|fma)\s*\()");
  for (const Line& line : linesBelow("engine/maths"))
    EXPECT_FALSE(std::regex_search(line.text, fromLibrary)) << line.place();
}

TEST(Layering, NothingStandsOutsideTheRepository) {
  std::vector<fs::path> files{kRoot / "stadion", kRoot / "CMakeLists.txt", kRoot / "CMakePresets.json",
                              kRoot / ".ci/run"};
  for (const char* folder :
       {"engine", "pipeline", "dynamics", "profiling", "show", "bench", "cli", "tests", "scripts", "walls"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder))
      if (std::set<std::string>{".h", ".cpp", ".txt", ".evs", ".walls", ".input", ".md"}.contains(
              entry.path().extension()))
        files.push_back(entry.path());
  for (const fs::path& file : files) {
    if (file.filename() == "layering_test.cpp") continue;  // names what it looks for
    std::ifstream in(file);
    std::string text;
    for (std::size_t n = 1; std::getline(in, text); ++n)
      for (const char* outside : {"/home/", "/root/", "/tmp/build"})
        EXPECT_EQ(text.find(outside), std::string::npos) << file << ":" << n << ": " << text;
  }
}

}  // namespace
