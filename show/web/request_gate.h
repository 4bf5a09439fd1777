#pragma once
/// The connections of the operator's page. One thread waits for all of them, and few others answer complete requests.
///
/// A connection carries one request. It costs a thread only while its request is answered, never while it is read or
/// written. So a slow client holds up no other one. Each connection has a limit of time, and the number of connections
/// is limited. If it is reached, the new connection replaces the one that has been incomplete for longest.
///
/// Ownership  owns the connections; stop() or its destructor closes them.
/// Threads    adopt() from any thread. `answer` is called on the gate's threads, several at a time. They run with
///            yieldToShow() and share no lock with the show.
/// Errors     a client that is slow, or that sends what RequestReader refuses, is answered with an error if it still
///            listens, and closed. It is counted.

#include "show/web/request_reader.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace stadion {

struct GateLimits {
  std::size_t connections = 128;
  std::size_t answering = 2;                  ///< threads
  std::chrono::milliseconds reading{3000};    ///< until the request is complete
  std::chrono::milliseconds writing{10'000};  ///< until the client has taken the answer
};

struct GateCounts {
  std::uint64_t answered = 0;
  std::uint64_t refused = 0;   ///< requests that RequestReader refused
  std::uint64_t slow = 0;      ///< connections that ran out of time
  std::uint64_t replaced = 0;  ///< connections that were closed for new ones
  std::uint64_t open = 0;      ///< connections at this moment
};

class RequestGate {
public:
  /// Makes all bytes of an answer, with its head.
  using Answer = std::function<std::string(const WebRequest&)>;
  /// Makes the answer to a request that was refused.
  using Refusal = std::function<std::string(int status, const std::string& why)>;

  RequestGate(Answer answer, Refusal refusal, GateLimits limits = {});
  ~RequestGate();
  RequestGate(const RequestGate&) = delete;
  RequestGate& operator=(const RequestGate&) = delete;

  /// Takes over a connected socket.
  void adopt(int socket);
  /// Closes all connections and ends the threads.
  void stop();
  GateCounts counts() const;

private:
  using Clock = std::chrono::steady_clock;
  enum class Phase { Reading, Answering, Writing, Lingering };

  struct Connection {
    explicit Connection(int opened) : socket(opened) {}
    int socket;
    Phase phase = Phase::Reading;
    Clock::time_point until{};
    RequestReader reader{};
    std::string answer{};
    std::size_t written = 0;
  };
  using Connections = std::list<Connection>;

  void wait();
  void takeAdopted();
  void takeAnswers();
  void makeRoom();
  void read(Connection& connection);
  void write(Connection& connection);
  void linger(Connection& connection);
  void finish(Connection& connection, std::string answer);
  void close(Connections::iterator connection);
  void closeLate();
  void answerRequests();
  void wake();

  Answer answer_;
  Refusal refusal_;
  GateLimits limits_;
  int bell_ = -1;  ///< an eventfd
  std::atomic<bool> ending_ = false;
  std::atomic<std::uint64_t> answered_ = 0, refused_ = 0, slow_ = 0, replaced_ = 0, open_ = 0;

  // Of the waiting thread.
  Connections connections_;

  // Between the threads.
  std::mutex mutex_;
  std::condition_variable asked_;
  std::vector<int> adopted_;
  std::deque<Connection*> requests_;
  std::vector<std::pair<Connection*, std::string>> answers_;

  std::thread waiting_;
  std::vector<std::thread> answering_;
};

}  // namespace stadion
