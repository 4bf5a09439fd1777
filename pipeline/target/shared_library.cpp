#include "pipeline/target/shared_library.h"

#include <cstring>
#include <string>

namespace stadion {

Result<SharedLibrary> SharedLibrary::open(const char* file, const char* package) {
  if (void* handle = dlopen(file, RTLD_NOW | RTLD_LOCAL)) return SharedLibrary(handle);
  const char* reason = dlerror();
  const std::string why = reason ? reason : "unknown reason";
  // The loader names the file it misses first: ours, or one that ours needs.
  if (why.rfind(file, 0) == 0 && why.find("No such file") != std::string::npos)
    return Result<SharedLibrary>::failure(std::string(file) + " is missing: apt-get install " + package);
  return Result<SharedLibrary>::failure(std::string(file) + " cannot be loaded: " + why);
}

}  // namespace stadion
