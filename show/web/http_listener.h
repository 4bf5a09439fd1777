#pragma once
/// What cpp-httplib does for the operator's page. It stands behind an interface, in a library of its own
/// (libstadion-http.so), because only shows with a page need it and OpenSSL.
///
/// Ownership  the caller of stadionMakeHttpListener owns the listener.
/// Threads    answer() and refusal() from any thread, several at a time; the rest from one.

#include "show/web/web_request.h"

#include <cstdint>
#include <functional>
#include <string>

namespace stadion {

/// What the listener calls.
struct HttpDuties {
  std::function<WebAnswer(const WebRequest&)> answer;  ///< on the threads that call HttpListener::answer
  std::function<void(int socket)> adopt;  ///< takes over a connected socket, on the accepting thread
  std::function<void()> begin;            ///< first on the accepting thread
};

class HttpListener {
public:
  HttpListener() = default;
  HttpListener(const HttpListener&) = delete;
  HttpListener& operator=(const HttpListener&) = delete;
  /// Stops.
  virtual ~HttpListener() = default;

  /// Accepts connections from now on, on a thread of its own. Returns the port, any free one for 0; 0 if it cannot
  /// listen there.
  virtual int listenAt(const std::string& host, std::uint16_t port) = 0;
  /// Accepts nothing more.
  virtual void stop() = 0;
  /// Returns all bytes of the answer to a request, with its head.
  virtual std::string answer(const WebRequest& request) = 0;
  /// Returns all bytes of the answer to a request that cannot be read.
  virtual std::string refusal(int status, const std::string& why) = 0;
};

/// The library's one function, "stadionMakeHttpListener".
using MakeHttpListener = HttpListener*(HttpDuties& duties);

}  // namespace stadion
