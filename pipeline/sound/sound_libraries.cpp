#include "pipeline/sound/sound_libraries.h"

#include "engine/base/shared_library.h"

#include <cstdlib>

namespace stadion {
namespace {

using AlsaHandler = void(const char* file, int line, const char* function, int error, const char* format,
                         ...);

extern "C" void sayNothing(const char*, int, const char*, int, const char*, ...) {}

}  // namespace

void quietOpenAl() {
  setenv("ALSOFT_LOGLEVEL", "0", 0);
}

void quietAlsa() {
  const auto alsa = SharedLibrary::open("libasound.so.2", "libasound2");
  if (!alsa) return;
  if (auto* set = alsa.value().find<int(AlsaHandler*)>("snd_lib_error_set_handler")) set(sayNothing);
}

}  // namespace stadion
