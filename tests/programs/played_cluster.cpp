#include "tests/programs/played_cluster.h"

#include "tests/proc.h"

#include <csignal>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

namespace stadion {

std::string fourNodes(const TestFolder& folder, const std::string& more) {
  return folder.write("four.cluster",
                      "walls cave4\nnode front front\nnode left left\nnode right right\nnode floor floor\n"
                      "partition p" +
                          std::to_string(getpid()) + "\n" + more);
}

Json summaryOf(const std::filesystem::path& folder) {
  return Json::parse(fileContent(folder / "summary.json"));
}

std::set<std::string> hashesBelow(const std::filesystem::path& folder) {
  std::set<std::string> lines;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().filename() != "picture-hashes.txt") continue;
    std::ifstream in(entry.path());
    // One that was killed may have left half a line.
    for (std::string line; std::getline(in, line) && !in.eof();) lines.insert(line);
  }
  return lines;
}

std::map<std::string, std::string> picturesIn(const std::filesystem::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".png" && entry.path().filename() != "contact-sheet.png")
      all[entry.path().filename()] = fileContent(entry.path());
  return all;
}

std::map<std::uint64_t, std::int64_t> swapTimesOf(const std::filesystem::path& folder) {
  std::map<std::uint64_t, std::int64_t> times;
  std::ifstream in(folder / "swap-times.txt");
  std::uint64_t frame = 0;
  for (std::int64_t at = 0; in >> frame >> at;) times[frame] = at;
  return times;
}

pid_t processOf(const std::string& clusterFile, const std::string& node) {
  for (const pid_t process : procNumbers()) {
    const std::string words = procText(process, "cmdline");
    const std::string run = std::string("run") + '\0', is = std::string("--node") + '\0' + node + '\0';
    if (words.find(run) != words.npos && words.find(clusterFile) != words.npos &&
        words.find(is) != words.npos)
      return process;
  }
  return -1;
}

bool signalTo(pid_t process, int signal) {
  return process > 0 && kill(process, signal) == 0;
}

int endOf(pid_t child) {
  int status = -1;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace stadion
