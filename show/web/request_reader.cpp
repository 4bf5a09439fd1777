#include "show/web/request_reader.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <utility>

namespace stadion {
namespace {

constexpr std::string_view kLineEnd = "\r\n", kHeadEnd = "\r\n\r\n", kBearer = "Bearer ";

bool isWordCharacter(char c) {
  const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  return letter || (c != 0 && std::strchr("!#$%&'*+-.^_`|~", c) != nullptr);
}

bool isPathCharacter(char c) {
  const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  return letter || (c != 0 && std::strchr("-._~/", c) != nullptr);
}

bool isValueCharacter(char c) {
  return c == '\t' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f);
}

bool isWord(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, isWordCharacter);
}

std::string_view withoutBlanks(std::string_view text) {
  const auto isBlank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

std::string inLowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

}  // namespace

RequestReader::Progress RequestReader::refuse(int status, std::string why) {
  status_ = status;
  why_ = std::move(why);
  bytes_.clear();
  return progress_ = Progress::Refused;
}

RequestReader::Progress RequestReader::take(std::string_view bytes) {
  if (progress_ != Progress::Reads) return progress_;
  const std::size_t most = body_ > 0 ? body_ + length_ : kMostHead + kMostBody;
  const std::size_t from = bytes_.size() < kHeadEnd.size() ? 0 : bytes_.size() - kHeadEnd.size();
  bytes_.append(bytes.substr(0, most - std::min(most, bytes_.size())));
  if (body_ == 0) {
    const std::size_t end = bytes_.find(kHeadEnd, from);
    const std::size_t head = std::min(end, bytes_.size());
    if (head > kMostHead) return refuse(431, "the head of the request is too long");
    if (end == std::string::npos) return progress_;
    body_ = end + kHeadEnd.size();
    if (readHead(std::string_view(bytes_).substr(0, end)) == Progress::Refused) return progress_;
  }
  if (bytes_.size() < body_ + length_) return progress_;
  request_.body = bytes_.substr(body_, length_);
  bytes_.clear();
  return progress_ = Progress::Complete;
}

RequestReader::Progress RequestReader::readHead(std::string_view head) {
  for (bool first = true; first || !head.empty(); first = false) {
    const std::size_t end = std::min(head.find(kLineEnd), head.size());
    const std::string_view line = head.substr(0, end);
    head.remove_prefix(std::min(head.size(), end + kLineEnd.size()));
    if (!(first ? readRequestLine(line) : readHeader(line))) return progress_;
  }
  if (!hasHost_) return refuse(400, "there is no Host");
  if (request_.method == "GET" && length_ > 0) return refuse(400, "a GET has no body");
  if (request_.method == "POST" && !hasLength_) return refuse(411, "the length of the body is missing");
  return progress_;
}

bool RequestReader::readRequestLine(std::string_view line) {
  const auto refused = [&](int status, const char* why) {
    refuse(status, why);
    return false;
  };
  const std::size_t first = line.find(' '), last = line.rfind(' ');
  if (first == std::string_view::npos || first == last) return refused(400, "this is no request of HTTP/1");
  const std::string_view method = line.substr(0, first), version = line.substr(last + 1);
  std::string_view target = line.substr(first + 1, last - first - 1);
  if (!isWord(method) || !version.starts_with("HTTP/")) return refused(400, "this is no request of HTTP/1");
  if (version != "HTTP/1.1" && version != "HTTP/1.0") return refused(505, "only HTTP/1 is spoken here");
  if (method != "GET" && method != "POST") return refused(405, "only GET and POST are known here");
  if (target.size() > kMostPath) return refused(414, "the path is too long");
  if (!target.starts_with('/') || !std::ranges::all_of(target, isPathCharacter) ||
      target.find("..") != std::string_view::npos || target.find("//") != std::string_view::npos)
    return refused(400, "the path has signs that no path of this page has");
  request_.method = method;
  request_.path = target;
  return true;
}

bool RequestReader::readHeader(std::string_view line) {
  const std::size_t colon = line.find(':');
  const std::string_view name = line.substr(0, std::min(colon, line.size()));
  if (++headers_ > kMostHeaders) {
    refuse(431, "there are too many headers");
    return false;
  }
  if (colon == std::string_view::npos || !isWord(name) || !std::ranges::all_of(line, isValueCharacter)) {
    refuse(400, "a header is malformed");
    return false;
  }
  return keepHeader(inLowerCase(name), withoutBlanks(line.substr(colon + 1)));
}

bool RequestReader::keepHeader(const std::string& name, std::string_view value) {
  const auto refused = [&](int status, const char* why) {
    refuse(status, why);
    return false;
  };
  if (name == "host") {
    if (std::exchange(hasHost_, true)) return refused(400, "there are two Hosts");
    request_.host = value;
  } else if (name == "authorization") {
    if (value.starts_with(kBearer)) request_.token = withoutBlanks(value.substr(kBearer.size()));
  } else if (name == "origin") {
    request_.origin = value;
  } else if (name == "sec-fetch-site") {
    request_.fetchSite = value;
  } else if (name == "content-type") {
    request_.contentType = value;
  } else if (name == "content-length") {
    if (std::exchange(hasLength_, true)) return refused(400, "the length of the body is stated twice");
    const auto [end, wrong] = std::from_chars(value.data(), value.data() + value.size(), length_);
    if (wrong == std::errc::result_out_of_range) return refused(413, "the body is too long");
    if (wrong != std::errc() || end != value.data() + value.size())
      return refused(400, "the length of the body is no number");
    if (length_ > kMostBody) return refused(413, "the body is too long");
  } else if (name == "transfer-encoding") {
    return refused(501, "a body has a stated length here, and is not sent in chunks");
  } else if (name == "expect") {
    return refused(417, "nothing is expected here");
  }
  return true;
}

}  // namespace stadion
