#include "engine/asset/importer_program/source/channel.h"

#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace stadion::importer {
namespace {

bool readAll(int socket, void* to, std::size_t size) {
  auto* at = static_cast<char*>(to);
  while (size > 0) {
    const ssize_t got = ::recv(socket, at, size, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

bool writeAll(int socket, const void* from, std::size_t size) {
  const auto* at = static_cast<const char*>(from);
  while (size > 0) {
    const ssize_t sent = ::send(socket, at, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    at += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

// The head comes with the asset root's descriptor attached to its first byte.
bool receiveHead(int socket, RequestHead& head, FileDescriptor& root) {
  iovec part{&head, sizeof head};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))] = {};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  ssize_t got = 0;
  do got = ::recvmsg(socket, &message, MSG_CMSG_CLOEXEC);
  while (got < 0 && errno == EINTR);
  if (got <= 0) return false;
  const cmsghdr* attached = CMSG_FIRSTHDR(&message);
  if (attached && attached->cmsg_type == SCM_RIGHTS && attached->cmsg_len == CMSG_LEN(sizeof(int))) {
    int fd = -1;
    std::memcpy(&fd, CMSG_DATA(attached), sizeof fd);
    root = FileDescriptor(fd);
  }
  const auto have = static_cast<std::size_t>(got);
  return readAll(socket, reinterpret_cast<char*>(&head) + have, sizeof head - have);
}

}  // namespace

std::optional<Request> receive(int socket) {
  Request request;
  if (!receiveHead(socket, request.head, request.root)) return std::nullopt;
  const RequestHead& head = request.head;
  if (head.magic != kImportMagic || head.version != kImportVersion || !request.root) return std::nullopt;
  if (head.pathBytes == 0 || head.pathBytes > kLongestPath) return std::nullopt;
  request.path.resize(head.pathBytes);
  if (!readAll(socket, request.path.data(), head.pathBytes)) return std::nullopt;
  if (head.nodesBytes > kLongestSelection) return std::nullopt;
  std::string nodes(head.nodesBytes, '\0');
  if (!readAll(socket, nodes.data(), nodes.size())) return std::nullopt;
  request.nodes = nodeSelectionOf(nodes);
  return request;
}

bool answer(int socket, ImportStatus status, const std::string& text, const std::vector<std::uint8_t>& mesh) {
  AnswerHead head;
  head.status = status;
  head.textBytes = static_cast<std::uint32_t>(std::min<std::size_t>(text.size(), kLongestText));
  head.meshBytes = mesh.size();
  return writeAll(socket, &head, sizeof head) && writeAll(socket, text.data(), head.textBytes) &&
         writeAll(socket, mesh.data(), mesh.size());
}

}  // namespace stadion::importer
