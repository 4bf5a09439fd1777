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
  NodeSelection nodes{};
};

/// Returns the next request, or nothing if the show has ended or sent an invalid request.
std::optional<Request> receive(int socket);

/// Returns false if the show has ended.
bool answer(int socket, ImportStatus status, const std::string& text, const std::vector<std::uint8_t>& mesh);

}  // namespace stadion::importer
