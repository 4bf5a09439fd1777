#pragma once
/// A request to the operator's page and its answer, without the protocol around them.
///
/// Threads  plain values.

#include <string>

namespace stadion {

struct WebRequest {
  std::string method;  ///< GET or POST
  std::string path;    ///< begins with /
  std::string host;    ///< headers, empty if they were not sent
  std::string token;   ///< of `Authorization: Bearer TOKEN`
  std::string origin;
  std::string fetchSite;  ///< Sec-Fetch-Site: from where a browser asks
  std::string contentType;
  std::string body;
};

struct WebAnswer {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
};

}  // namespace stadion
