#include "profiling/record/run_delay.h"

#include "engine/base/folder_names.h"

#include <algorithm>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <string>
#include <unistd.h>

namespace stadion {
namespace {

constexpr std::uint64_t kLookAgain = 256;  ///< calls between two searches for the rasteriser's threads

/// "ran waited slices", in nanoseconds but the last.
double delayIn(int file) {
  char text[96];
  const ssize_t size = file < 0 ? -1 : pread(file, text, sizeof text - 1, 0);
  if (size <= 0) return 0;
  text[size] = 0;
  char* rest = nullptr;
  std::strtoull(text, &rest, 10);
  return 1e-6 * static_cast<double>(std::strtoull(rest, nullptr, 10));
}

}  // namespace

RunDelay::~RunDelay() {
  for (const int file : files_)
    if (file >= 0) close(file);
}

/// Mesa names its threads llvmpipe-0, llvmpipe-1 and so on, the CPU renderer draw-pool-1 and so on.
void RunDelay::findRasteriser() {
  for (std::size_t i = 1; i < files_.size(); ++i)
    if (files_[i] >= 0) close(files_[i]);
  files_.resize(1);
  for (const std::string& number : namesIn("/proc/self/task")) {
    const std::string thread = "/proc/self/task/" + number;
    std::ifstream in(thread + "/comm");
    std::string name;
    if (std::getline(in, name) && (name.starts_with("llvmpipe-") || name.starts_with("draw-pool-")))
      files_.push_back(open((thread + "/schedstat").c_str(), O_RDONLY | O_CLOEXEC));
  }
}

int RunDelay::ownFile() {
  if (files_.empty()) files_.push_back(open("/proc/thread-self/schedstat", O_RDONLY | O_CLOEXEC));
  return files_.front();
}

double RunDelay::own() {
  return delayIn(ownFile());
}

const std::vector<double>& RunDelay::ofDrawing() {
  ownFile();
  if (looked_++ % kLookAgain == 0) findRasteriser();
  delays_.clear();
  for (const int file : files_) delays_.push_back(delayIn(file));
  return delays_;
}

double mostDelayed(const std::vector<double>& before, const std::vector<double>& now) {
  double most = 0;
  for (std::size_t i = 0; i < std::min(before.size(), now.size()); ++i)
    most = std::max(most, now[i] - before[i]);
  return most;
}

}  // namespace stadion
