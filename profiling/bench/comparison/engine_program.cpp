#include "profiling/bench/comparison/engine_program.h"

#include "engine/asset/file_descriptor.h"

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>

namespace stadion::bench {
namespace {

std::string readAll(int fd) {
  std::string text;
  char part[4096];
  for (;;) {
    const ssize_t n = read(fd, part, sizeof part);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return text;
    text.append(part, static_cast<std::size_t>(n));
  }
}

/// Our environment, with all symbols bound at the start: else the first frame of an engine in shared
/// libraries pays for its linking.
std::vector<std::string> boundAtStart() {
  std::vector<std::string> settings{"LD_BIND_NOW=1"};
  for (char** entry = environ; *entry; ++entry) settings.emplace_back(*entry);
  return settings;
}

std::vector<char*> pointersTo(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// What the program prints, empty if it cannot be started.
std::string outputOf(std::vector<std::string> words) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return {};
  const FileDescriptor from(ends[0]);
  FileDescriptor to(ends[1]);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, to.get(), STDOUT_FILENO);
  std::vector<std::string> settings = boundAtStart();
  const std::vector<char*> arguments = pointersTo(words), environment = pointersTo(settings);
  pid_t child = 0;
  const int wrong =
      posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environment.data());
  posix_spawn_file_actions_destroy(&actions);
  to.close();
  if (wrong) return {};
  const std::string text = readAll(from.get());
  while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  return text;
}

std::vector<nlohmann::json> objectsIn(const std::string& text) {
  std::vector<nlohmann::json> objects;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
    if (json.is_object()) objects.push_back(std::move(json));
  }
  return objects;
}

}  // namespace

std::vector<EngineProgram> enginePrograms(const std::string& folder) {
  std::vector<EngineProgram> programs;
  for (const char* engine : {"stadion", "bullet", "ode", "mujoco"}) {
    EngineProgram p;
    p.path = folder + "/stadion-dyn-" + engine;
    p.ours = std::string(engine) == "stadion";
    if (!std::filesystem::exists(p.path)) continue;
    for (const nlohmann::json& line : objectsIn(outputOf({p.path, "--list"})))
      if (line.contains("engine")) p.variants.push_back(line["engine"]);
    programs.push_back(std::move(p));
  }
  return programs;
}

std::vector<ListedCase> casesOf(const EngineProgram& program) {
  std::vector<ListedCase> cases;
  for (const nlohmann::json& line : objectsIn(outputOf({program.path, "--list"})))
    if (line.contains("case")) cases.push_back({line["case"], line["steps"].get<std::vector<int>>()});
  return cases;
}

Measurement measure(const EngineProgram& program, const std::string& variant, const std::string& caseName,
                    int n, int limit) {
  std::istringstream lines(outputOf({program.path, caseName, "--exact", "--engine", variant, "--steps",
                                     std::to_string(n), "--limit", std::to_string(limit)}));
  for (std::string line; std::getline(lines, line);)
    if (const auto found = parseMeasurement(line)) return *found;
  Measurement none;
  none.engine = variant;
  none.caseName = caseName;
  none.n = n;
  none.crash = -1;
  return none;
}

}  // namespace stadion::bench
