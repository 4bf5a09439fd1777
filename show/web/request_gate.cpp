#include "show/web/request_gate.h"

#include "pipeline/platform/idle_priority.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <exception>
#include <utility>

namespace stadion {
namespace {

constexpr int kLookForLate = 100;                  ///< [ms]
constexpr std::chrono::milliseconds kLinger{500};  ///< for a client that still sends after its refusal
constexpr std::size_t kReadAtOnce = 4096;          ///< [bytes]

bool mayTryAgain() {
  return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
}

}  // namespace

RequestGate::RequestGate(Answer answer, Refusal refusal, GateLimits limits)
    : answer_(std::move(answer)), refusal_(std::move(refusal)), limits_(limits),
      bell_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)), waiting_([this] { wait(); }) {
  for (std::size_t i = 0; i < limits_.answering; ++i) answering_.emplace_back([this] { answerRequests(); });
}

RequestGate::~RequestGate() {
  stop();
}

void RequestGate::stop() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  asked_.notify_all();
  wake();
  if (waiting_.joinable()) waiting_.join();
  for (std::thread& thread : answering_)
    if (thread.joinable()) thread.join();
  for (const Connection& connection : connections_) ::close(connection.socket);
  connections_.clear();
  for (const int socket : adopted_) ::close(socket);
  adopted_.clear();
  if (bell_ >= 0) ::close(bell_);
  bell_ = -1;
}

GateCounts RequestGate::counts() const {
  return {answered_, refused_, slow_, replaced_, open_};
}

void RequestGate::wake() {
  const std::uint64_t one = 1;
  if (bell_ >= 0 && ::write(bell_, &one, sizeof one) < 0) return;  // full: it rings already
}

void RequestGate::adopt(int socket) {
  // A program that is started meanwhile must not keep the connection open.
  fcntl(socket, F_SETFD, FD_CLOEXEC);
  fcntl(socket, F_SETFL, fcntl(socket, F_GETFL) | O_NONBLOCK);
  {
    const std::lock_guard lock(mutex_);
    if (!ending_) adopted_.push_back(std::exchange(socket, -1));
  }
  if (socket >= 0) ::close(socket);
  wake();
}

void RequestGate::wait() {
  yieldToShow("web-gate");
  std::vector<pollfd> waiting;
  std::vector<Connections::iterator> whose;
  while (!ending_) {
    waiting.assign(1, pollfd{bell_, POLLIN, 0});
    whose.assign(1, connections_.end());
    for (auto c = connections_.begin(); c != connections_.end(); ++c) {
      if (c->phase == Phase::Answering) continue;
      const short what = c->phase == Phase::Writing ? POLLOUT : POLLIN;
      waiting.push_back({c->socket, what, 0});
      whose.push_back(c);
    }
    if (poll(waiting.data(), waiting.size(), connections_.empty() ? -1 : kLookForLate) < 0 && errno != EINTR)
      return;
    for (std::size_t i = 1; i < waiting.size(); ++i) {
      if (waiting[i].revents == 0) continue;
      Connection& c = *whose[i];
      if (c.phase == Phase::Reading)
        read(c);
      else if (c.phase == Phase::Writing)
        write(c);
      else
        linger(c);
    }
    closeLate();
    takeAnswers();
    if (waiting[0].revents != 0) takeAdopted();
  }
}

void RequestGate::takeAdopted() {
  std::uint64_t rung = 0;
  if (::read(bell_, &rung, sizeof rung) < 0 && !mayTryAgain()) return;
  std::vector<int> adopted;
  {
    const std::lock_guard lock(mutex_);
    adopted.swap(adopted_);
  }
  takeAnswers();
  for (const int socket : adopted) {
    makeRoom();
    if (connections_.size() >= limits_.connections) {
      ::close(socket);
      ++replaced_;
      continue;
    }
    Connection& made = connections_.emplace_back(socket);
    made.until = Clock::now() + limits_.reading;
    open_ = connections_.size();
    read(made);  // most requests are there already
  }
  closeLate();
}

/// The list is in the order of arrival.
void RequestGate::makeRoom() {
  if (connections_.size() < limits_.connections) return;
  for (const Phase phase : {Phase::Lingering, Phase::Reading, Phase::Writing}) {
    const auto oldest = std::ranges::find(connections_, phase, &Connection::phase);
    if (oldest == connections_.end()) continue;
    ++replaced_;
    return close(oldest);
  }
}

void RequestGate::close(Connections::iterator connection) {
  ::close(connection->socket);
  connections_.erase(connection);
  open_ = connections_.size();
}

/// Closes connections that are over or out of time. `until` of the former is the epoch.
void RequestGate::closeLate() {
  const auto now = Clock::now();
  for (auto c = connections_.begin(); c != connections_.end();) {
    const auto next = std::next(c);
    if (c->phase != Phase::Answering && c->until <= now) {
      const bool isOver = c->until == Clock::time_point{};
      if (!isOver && c->phase != Phase::Lingering) ++slow_;
      if (!isOver && c->phase == Phase::Reading) {
        // The client may be slow rather than gone. Its answer fits into the socket's buffer.
        const std::string late = refusal_(408, "the request took too long");
        if (send(c->socket, late.data(), late.size(), MSG_NOSIGNAL | MSG_DONTWAIT) < 0)
          shutdown(c->socket, SHUT_RDWR);
      }
      close(c);
    }
    c = next;
  }
}

void RequestGate::read(Connection& connection) {
  std::array<char, kReadAtOnce> bytes;
  for (;;) {
    const ssize_t count = recv(connection.socket, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (count < 0 && mayTryAgain()) return;
    if (count <= 0) {
      connection.until = {};
      return;
    }
    const auto progress = connection.reader.take({bytes.data(), static_cast<std::size_t>(count)});
    if (progress == RequestReader::Progress::Refused) {
      ++refused_;
      return finish(connection, refusal_(connection.reader.status(), connection.reader.why()));
    }
    if (progress == RequestReader::Progress::Reads) continue;
    connection.phase = Phase::Answering;
    {
      const std::lock_guard lock(mutex_);
      requests_.push_back(&connection);
    }
    return asked_.notify_one();
  }
}

/// Begins to write an answer.
void RequestGate::finish(Connection& connection, std::string answer) {
  connection.answer = std::move(answer);
  connection.phase = Phase::Writing;
  connection.until = Clock::now() + limits_.writing;
  write(connection);
}

void RequestGate::write(Connection& connection) {
  while (connection.written < connection.answer.size()) {
    const ssize_t count = send(connection.socket, connection.answer.data() + connection.written,
                               connection.answer.size() - connection.written, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0 && mayTryAgain()) return;
    if (count <= 0) {
      connection.until = {};
      return;
    }
    connection.written += static_cast<std::size_t>(count);
  }
  // Closing a socket with unread bytes would tear the answer from a client that has not read it yet.
  shutdown(connection.socket, SHUT_WR);
  connection.phase = Phase::Lingering;
  connection.until = Clock::now() + kLinger;
  linger(connection);
}

/// Drops what the client still sends, until it closes.
void RequestGate::linger(Connection& connection) {
  std::array<char, kReadAtOnce> bytes;
  for (int i = 0; i < 16; ++i) {
    const ssize_t count = recv(connection.socket, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (count < 0 && mayTryAgain()) return;
    if (count > 0) continue;
    connection.until = {};
    return;
  }
}

void RequestGate::takeAnswers() {
  std::vector<std::pair<Connection*, std::string>> answers;
  {
    const std::lock_guard lock(mutex_);
    answers.swap(answers_);
  }
  for (auto& [connection, answer] : answers) {
    ++answered_;
    finish(*connection, std::move(answer));
  }
  if (!answers.empty()) closeLate();
}

void RequestGate::answerRequests() {
  yieldToShow("web-answer");
  for (;;) {
    Connection* connection = nullptr;
    {
      std::unique_lock lock(mutex_);
      asked_.wait(lock, [&] { return ending_ || !requests_.empty(); });
      if (ending_) return;
      connection = requests_.front();
      requests_.pop_front();
    }
    std::string answer;
    try {
      answer = answer_(connection->reader.request());
    } catch (const std::exception&) {
      answer = refusal_(500, "the answer could not be made");
    }
    {
      const std::lock_guard lock(mutex_);
      answers_.emplace_back(connection, std::move(answer));
    }
    wake();
  }
}

}  // namespace stadion
