#include "pipeline/platform/process_figures.h"

#include <cstdio>
#include <dirent.h>
#include <malloc.h>
#include <string_view>
#include <unistd.h>

namespace stadion {
namespace {

std::size_t entriesIn(const char* folder) {
  DIR* const dir = opendir(folder);
  if (!dir) return 0;
  std::size_t count = 0;
  while (const dirent* entry = readdir(dir))
    count += std::string_view(entry->d_name).starts_with('.') ? 0 : 1;
  closedir(dir);
  return count;
}

std::uint64_t residentPages() {
  std::FILE* const file = std::fopen("/proc/self/statm", "re");
  if (!file) return 0;
  unsigned long all = 0, resident = 0;
  const int read = std::fscanf(file, "%lu %lu", &all, &resident);
  std::fclose(file);
  return read == 2 ? resident : 0;
}

}  // namespace

ProcessFigures processFigures() {
  ProcessFigures f;
  f.residentBytes = residentPages() * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  const struct mallinfo2 heap = mallinfo2();
  f.heapBytes = heap.uordblks + heap.hblkhd;
  f.threads = entriesIn("/proc/self/task");
  const std::size_t handles = entriesIn("/proc/self/fd");
  f.handles = handles > 0 ? handles - 1 : 0;  // one handle is the open folder itself
  return f;
}

}  // namespace stadion
