#pragma once
/// Reads /proc while the processes there come and go: what has ended reads as empty and is never an error.

#include <algorithm>
#include <dirent.h>
#include <fcntl.h>
#include <string>
#include <sys/types.h>
#include <unistd.h>
#include <vector>

namespace stadion {

/// The content of a file; empty if it is gone. A stream would throw when the process ends between open and
/// read.
inline std::string procText(const std::string& file) {
  std::string text;
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return text;
  char part[4096];
  for (ssize_t n = 0; (n = ::read(fd, part, sizeof part)) > 0;)
    text.append(part, static_cast<std::size_t>(n));
  ::close(fd);
  return text;
}
inline std::string procText(pid_t process, const std::string& file) {
  return procText("/proc/" + std::to_string(process) + "/" + file);
}

/// The names in a folder without those that begin with a dot; none if it is gone.
inline std::vector<std::string> procNames(const std::string& folder) {
  std::vector<std::string> names;
  DIR* const all = ::opendir(folder.c_str());
  if (!all) return names;
  while (const dirent* entry = ::readdir(all))
    if (entry->d_name[0] != '.') names.emplace_back(entry->d_name);
  ::closedir(all);
  return names;
}

/// The numbers among the names in a folder: the processes in /proc, the threads in /proc/PID/task.
inline std::vector<pid_t> procNumbers(const std::string& folder = "/proc") {
  std::vector<pid_t> numbers;
  for (const std::string& name : procNames(folder))
    if (name.find_first_not_of("0123456789") == name.npos) numbers.push_back(std::stoi(name));
  return numbers;
}

/// What stands in `stat` from the third field on, the state; empty if the process is gone.
inline std::vector<std::string> procStat(pid_t process) {
  std::vector<std::string> fields;
  const std::string text = procText(process, "stat");
  std::size_t at = text.rfind(") ");
  if (at == text.npos) return fields;
  for (at += 2; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
    fields.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return fields;
}

/// The process runs or waits; a zombie does not.
inline bool procRuns(pid_t process) {
  const std::vector<std::string> stat = procStat(process);
  return !stat.empty() && stat[0] != "Z" && stat[0] != "X";
}

/// The first child of a process; 0 if it has none.
inline pid_t procChild(pid_t process) {
  const std::string children = procText(process, "task/" + std::to_string(process) + "/children");
  return children.empty() ? 0 : std::stoi(children);
}

}  // namespace stadion
