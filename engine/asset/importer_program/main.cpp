/// stadion-import: reads model files for a show, in a process that may crash.
///
/// The show starts it (see engine/asset/importer_process.h) with a socket as standard input. It answers one
/// request after another, and ends when the show closes its end. A hostile file can thus only harm this
/// process, under limits, and not the show.

#include "engine/asset/importer_program/import_model.h"
#include "engine/asset/importer_program/source/source_scene.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <new>

namespace {

using namespace stadion;

void limitThisProcess(const RequestHead& head) {
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  rlimit memory{head.addressSpace, RLIM_INFINITY};
  ::setrlimit(RLIMIT_AS, &memory);
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const auto spent = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec);
  rlimit cpu{spent + head.cpuSeconds + 1, RLIM_INFINITY};
  ::setrlimit(RLIMIT_CPU, &cpu);
}

// After a failed allocation nothing is certain any more: say so and end; the show starts another.
[[noreturn]] void endOutOfMemory(int socket) {
  static const std::vector<std::uint8_t> nothing;
  importer::answer(socket, ImportStatus::OutOfMemory, {}, nothing);
  ::_exit(kOutOfMemoryExit);
}

bool serve(int socket, const importer::Request& request) {
  std::string text;
  std::vector<std::uint8_t> bytes;
  ImportStatus status = ImportStatus::Failed;
  try {
    importer::ImportedModel imported = importer::importModel(request);
    bytes = encode(imported.mesh);
    text = imported.inventory.asText(kLongestText);
    status = ImportStatus::Loaded;
  } catch (const std::bad_alloc&) {
    endOutOfMemory(socket);
  } catch (const std::length_error&) {
    endOutOfMemory(socket);
  } catch (const importer::Refusal& refusal) {
    text = refusal.what();
  } catch (const std::exception& fault) {
    text = std::string("cannot be read: ") + fault.what();
  }
  return importer::answer(socket, status, text, bytes);
}

}  // namespace

int main() {
  int kind = 0;
  socklen_t size = sizeof kind;
  if (::getsockopt(STDIN_FILENO, SOL_SOCKET, SO_TYPE, &kind, &size) != 0) {
    std::fputs("stadion-import is started by stadion; there is nothing to run by hand\n", stderr);
    return 2;
  }
  ::close_range(3, ~0u, 0);
  while (const auto request = importer::receive(STDIN_FILENO)) {
    limitThisProcess(request->head);
    if (!serve(STDIN_FILENO, *request)) break;
  }
  return 0;
}
