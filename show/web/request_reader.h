#pragma once
/// Reads one HTTP/1 request, piece by piece as it comes from the network, and refuses everything that the
/// operator's page never asks for.
///
/// It is strict, so that no part behind it ever sees hostile bytes: lines end with CR LF, a path has letters,
/// digits and `-._~/` and no `..`, headers are few and short, and a body has a stated length. Chunked bodies,
/// folded headers, `Expect` and two `Host` headers are refused.
///
/// Errors   status() is the HTTP status of the refusal, and why() the reason in words.
/// Threads  one thread at a time.
/// Sources  RFC 9110 and RFC 9112.

#include "show/web/web_request.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace stadion {

class RequestReader {
public:
  static constexpr std::size_t kMostHead = 8192, kMostBody = 4096;  ///< [bytes]
  static constexpr std::size_t kMostHeaders = 64, kMostPath = 256;

  enum class Progress { Reads, Complete, Refused };

  /// Takes further bytes. Expects that it still reads.
  Progress take(std::string_view bytes);
  Progress progress() const { return progress_; }

  /// Of a complete request.
  const WebRequest& request() const { return request_; }
  /// Of a refused one.
  int status() const { return status_; }
  const std::string& why() const { return why_; }

private:
  Progress refuse(int status, std::string why);
  Progress readHead(std::string_view head);
  bool readRequestLine(std::string_view line);
  bool readHeader(std::string_view line);
  bool keepHeader(const std::string& name, std::string_view value);

  Progress progress_ = Progress::Reads;
  std::string bytes_;
  std::size_t body_ = 0;  ///< where the body begins; 0: the head is not complete
  std::size_t length_ = 0;
  std::size_t headers_ = 0;
  bool hasLength_ = false, hasHost_ = false;
  WebRequest request_;
  int status_ = 0;
  std::string why_;
};

}  // namespace stadion
