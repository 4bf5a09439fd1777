#include "engine/asset/importer_process.h"

#include "engine/asset/importer_answer.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

extern char** environ;

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;

class Conversation {
public:
  Conversation(int socket, Clock::time_point deadline, const std::atomic<bool>* giveUp)
      : socket_(socket), deadline_(deadline), giveUp_(giveUp) {}

  Transfer write(const void* from, std::size_t size) {
    const auto* at = static_cast<const char*>(from);
    while (size > 0) {
      if (const Transfer t = wait(POLLOUT); t != Transfer::Done) return t;
      const ssize_t sent = ::send(socket_, at, size, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (sent < 0 && (errno == EINTR || errno == EAGAIN)) continue;
      if (sent <= 0) return Transfer::Broken;
      at += sent;
      size -= static_cast<std::size_t>(sent);
    }
    return Transfer::Done;
  }

  // The descriptor rides on the first byte of the head.
  Transfer writeWith(int descriptor, const RequestHead& head) {
    RequestHead copy = head;
    iovec part{&copy, sizeof copy};
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))] = {};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control;
    message.msg_controllen = sizeof control;
    cmsghdr* attached = CMSG_FIRSTHDR(&message);
    attached->cmsg_level = SOL_SOCKET;
    attached->cmsg_type = SCM_RIGHTS;
    attached->cmsg_len = CMSG_LEN(sizeof(int));
    std::memcpy(CMSG_DATA(attached), &descriptor, sizeof descriptor);
    ssize_t sent = 0;
    do {
      if (const Transfer t = wait(POLLOUT); t != Transfer::Done) return t;
      sent = ::sendmsg(socket_, &message, MSG_NOSIGNAL | MSG_DONTWAIT);
    } while (sent < 0 && (errno == EINTR || errno == EAGAIN));
    if (sent <= 0) return Transfer::Broken;
    const auto have = static_cast<std::size_t>(sent);
    return write(reinterpret_cast<const char*>(&copy) + have, sizeof copy - have);
  }

  Transfer read(void* to, std::size_t size) {
    auto* at = static_cast<char*>(to);
    while (size > 0) {
      if (const Transfer t = wait(POLLIN); t != Transfer::Done) return t;
      const ssize_t got = ::recv(socket_, at, size, MSG_DONTWAIT);
      if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
      if (got <= 0) return Transfer::Broken;
      at += got;
      size -= static_cast<std::size_t>(got);
    }
    return Transfer::Done;
  }

private:
  Transfer wait(short events) {
    for (;;) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline_ - Clock::now()).count();
      if (left <= 0 || (giveUp_ && *giveUp_)) return Transfer::Late;
      pollfd one{socket_, events, 0};
      const int ready = ::poll(&one, 1, static_cast<int>(std::min<long long>(left, giveUp_ ? 50 : 60'000)));
      if (ready > 0) return Transfer::Done;  // on a hang-up the transfer itself tells
      if (ready < 0 && errno != EINTR) return Transfer::Broken;
    }
  }

  int socket_;
  Clock::time_point deadline_;
  const std::atomic<bool>* giveUp_;
};

struct SpawnSettings {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;

  explicit SpawnSettings(int socket) {
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, socket, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_init(&attributes);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setpgroup(&attributes, 0);  // Ctrl-C is for the show, which then closes the socket
    posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
};

/// The environment of this process and, unless it says otherwise, large pages for large blocks of memory. assimp
/// fills 16 MiB again for each OBJ file and each of its libraries: with pages of 4 KiB that takes ten times as long.
class ImporterEnvironment {
public:
  ImporterEnvironment() {
    bool told = false;
    for (char** variable = environ; *variable; ++variable) {
      variables_.push_back(*variable);
      told |= std::strncmp(*variable, kTunables, std::strlen(kTunables)) == 0;
    }
    if (!told) variables_.push_back(largePages_.data());
    variables_.push_back(nullptr);
  }
  ImporterEnvironment(const ImporterEnvironment&) = delete;
  ImporterEnvironment& operator=(const ImporterEnvironment&) = delete;
  char* const* variables() const { return variables_.data(); }

private:
  static constexpr const char* kTunables = "GLIBC_TUNABLES=";
  std::string largePages_ = std::string(kTunables) + "glibc.malloc.hugetlb=1";
  std::vector<char*> variables_;
};

}  // namespace

// Empty, or why the program cannot be started.
std::string ImporterProcess::start() {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return std::strerror(errno);
  FileDescriptor ours(ends[0]), theirs(ends[1]);
  const SpawnSettings settings(theirs.get());
  std::string name = program_.string();
  char* arguments[] = {name.data(), nullptr};
  pid_t pid = 0;
  const ImporterEnvironment environment;
  const int error = ::posix_spawn(&pid, name.c_str(), &settings.files, &settings.attributes, arguments,
                                  environment.variables());
  if (error != 0) return std::strerror(error);
  pid_ = pid;
  socket_ = std::move(ours);
  ++started_;
  return {};
}

void ImporterProcess::stop() {
  socket_.close();
  if (pid_ == 0) return;
  ::kill(pid_, SIGKILL);
  while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
  pid_ = 0;
}

// The exchange broke off. The program's exit shows why.
ImporterProcess::Answer ImporterProcess::fault(End end) {
  Answer answer{end, {}, {}};
  if (end == End::Crashed && pid_ != 0) {
    socket_.close();
    int status = 0;
    pid_t ended = 0;
    for (int i = 0; i < 200 && (ended = ::waitpid(pid_, &status, WNOHANG)) == 0; ++i) ::usleep(5000);
    if (ended == pid_) {
      pid_ = 0;
      if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        answer.end = End::OutOfTime;
      else if (WIFEXITED(status) && WEXITSTATUS(status) == kOutOfMemoryExit)
        answer.end = End::OutOfMemory;
      else if (WIFSIGNALED(status))
        answer.text = ::strsignal(WTERMSIG(status));
    }
  }
  stop();
  return answer;
}

ImporterProcess::Answer ImporterProcess::ask(RequestHead head, int root, const std::string& path,
                                             const NodeSelection& nodes, std::chrono::milliseconds timeout,
                                             const std::atomic<bool>* giveUp) {
  if (pid_ != 0 && ::waitpid(pid_, nullptr, WNOHANG) == pid_) {
    pid_ = 0;
    socket_.close();
  }
  if (pid_ == 0)
    if (const std::string why = start(); !why.empty()) return {End::NotStarted, why, {}};
  Conversation talk(socket_.get(), Clock::now() + timeout, giveUp);
  const std::string selection = textOf(nodes);
  head.pathBytes = static_cast<std::uint32_t>(path.size());
  head.nodesBytes = static_cast<std::uint32_t>(selection.size());
  ImporterAnswer reply;
  Transfer t = talk.writeWith(root, head);
  if (t == Transfer::Done) t = talk.write(path.data(), path.size());
  if (t == Transfer::Done) t = talk.write(selection.data(), selection.size());
  if (t == Transfer::Done)
    t = readAnswer([&](void* to, std::size_t size) { return talk.read(to, size); }, reply);
  if (t == Transfer::Nonsense) return fault(End::Nonsense);
  if (t != Transfer::Done) return fault(t == Transfer::Late ? End::OutOfTime : End::Crashed);
  if (reply.status == ImportStatus::OutOfMemory) return fault(End::OutOfMemory);
  return {reply.status == ImportStatus::Loaded ? End::Loaded : End::Failed, std::move(reply.text),
          std::move(reply.mesh)};
}

}  // namespace stadion
