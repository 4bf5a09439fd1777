#include "show/output/output_folder.h"

#include "engine/base/plain_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <set>
#include <sstream>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace stadion {
namespace {

using Opened = Result<std::unique_ptr<OutputFolder>>;

constexpr const char* kList = ".stadion-files";
constexpr std::string_view kHeading = "stadion-files 1\n";
constexpr std::size_t kMostBytes = std::size_t{256} << 20;

/// Whether it is the name of a file in the folder itself.
bool isPlainName(const std::string& name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == name.npos &&
         name.find('\n') == name.npos;
}

std::vector<std::string> namesIn(const std::string& list) {
  std::vector<std::string> names;
  std::istringstream lines(list);
  std::string line;
  std::getline(lines, line);  // the heading
  while (std::getline(lines, line))
    if (isPlainName(line)) names.push_back(line);
  return names;
}

/// "front-left-000012.png", "track-ball.csv"
bool isNameOfRuns(std::string_view name) {
  if (name.starts_with("track-") && name.ends_with(".csv")) return true;
  constexpr std::size_t kDigits = 6;
  if (!name.ends_with(".png")) return false;
  name.remove_suffix(4);
  const std::size_t dash = name.rfind('-');
  return dash != name.npos && name.size() - dash > kDigits &&
         name.find_first_not_of("0123456789", dash + 1) == name.npos;
}

bool append(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

Opened OutputFolder::open(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) return Opened::failure("--out: cannot make the folder " + path + ": " + error.message());
  FileDescriptor folder(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder) return Opened::failure("--out: cannot open the folder " + path + ": " + std::strerror(errno));
  FileDescriptor list(
      ::openat(folder.get(), kList, O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666));
  if (!list)
    return Opened::failure("--out: cannot write into the folder " + path + ": " + std::strerror(errno));
  if (::flock(list.get(), LOCK_EX | LOCK_NB) != 0)
    return Opened::failure("--out: another run is writing into the folder " + path);

  const auto text = readPlainFile(list.get(), path + "/" + kList, kMostBytes);
  if (!text) return text.error();
  if (!text.value().empty() && !text.value().starts_with(kHeading))
    return Opened::failure("--out: " + path + "/" + kList +
                           " is not a list of files that a run has written; move it away");
  std::unique_ptr<OutputFolder> opened(new OutputFolder(path, std::move(folder), std::move(list)));
  opened->earlier_ = namesIn(text.value());
  return opened;
}

std::vector<std::string> OutputFolder::namesOfRuns(const std::string& path) {
  std::set<std::string> names{"summary.json", "contact-sheet.png", "video.mp4", "sound.wav"};
  if (const auto list = readPlainFile(path + "/" + kList, kMostBytes);
      list && list.value().starts_with(kHeading))
    for (std::string& name : namesIn(list.value())) names.insert(std::move(name));
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(path, none))
    if (const std::string name = entry.path().filename(); isNameOfRuns(name)) names.insert(name);
  return {names.begin(), names.end()};
}

std::size_t OutputFolder::clear() {
  std::size_t removed = 0;
  for (const std::string& name : earlier_) {
    struct stat about {};
    const bool plain =
        ::fstatat(folder_.get(), name.c_str(), &about, AT_SYMLINK_NOFOLLOW) == 0 && S_ISREG(about.st_mode);
    if (plain && ::unlinkat(folder_.get(), name.c_str(), 0) == 0) ++removed;
  }
  earlier_.clear();
  if (::ftruncate(list_.get(), 0) == 0) append(list_.get(), kHeading);
  return removed;
}

std::optional<Diagnostic> OutputFolder::note(const std::string& name) {
  if (!isPlainName(name) || append(list_.get(), name + "\n")) return {};
  Diagnostic d;
  d.where.file = pathOf(kList);
  d.message = std::string("cannot be written: ") + std::strerror(errno);
  return d;
}

}  // namespace stadion
