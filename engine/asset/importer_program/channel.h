#pragma once
/// The importer program's end of the conversation (see importer_protocol.h).

#include "engine/asset/importer_protocol.h"
#include "engine/base/file_descriptor.h"

#include <optional>
#include <string>

namespace stadion::importer {

struct Request {
  RequestHead head;
  FileDescriptor root;  ///< the asset root
  std::string path;     ///< below it
};

/// The next request, or nothing when the show has gone or talks nonsense.
std::optional<Request> receive(int socket);

/// False if the show has gone.
bool answer(int socket, ImportStatus status, const std::string& text, const std::vector<std::uint8_t>& mesh);

}  // namespace stadion::importer
