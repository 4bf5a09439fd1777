/// Requests as clients send them, and what is refused of them.

#include "show/web/request_reader.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using ReadProgress = RequestReader::Progress;

constexpr const char* kHost = "Host: 127.0.0.1:8080\r\n";

int refusalOf(const std::string& text) {
  RequestReader reader;
  return reader.take(text) == ReadProgress::Refused ? reader.status() : 0;
}

TEST(RequestReader, AGetHasItsPathAndTheHeadersThatCount) {
  RequestReader reader;
  const auto progress =
      reader.take("GET /views/0/1 HTTP/1.1\r\nhost: localhost:8080\r\nAuthorization: Bearer abc \r\n"
                  "Origin: http://localhost:8080\r\nSec-Fetch-Site: same-origin\r\n"
                  "Accept-Encoding: gzip\r\n\r\n");
  ASSERT_EQ(progress, ReadProgress::Complete) << reader.why();
  const WebRequest& r = reader.request();
  EXPECT_EQ(r.method, "GET");
  EXPECT_EQ(r.path, "/views/0/1");
  EXPECT_EQ(r.host, "localhost:8080");
  EXPECT_EQ(r.token, "abc");
  EXPECT_EQ(r.origin, "http://localhost:8080");
  EXPECT_EQ(r.fetchSite, "same-origin");
}

TEST(RequestReader, ARequestMayComeByteAfterByte) {
  const std::string text =
      std::string("POST /command HTTP/1.1\r\n") + kHost + "Content-Length: 5\r\n\r\nhello";
  RequestReader reader;
  for (std::size_t i = 0; i + 1 < text.size(); ++i)
    ASSERT_EQ(reader.take(text.substr(i, 1)), ReadProgress::Reads) << i << ": " << reader.why();
  EXPECT_EQ(reader.take(text.substr(text.size() - 1)), ReadProgress::Complete);
  EXPECT_EQ(reader.request().body, "hello");
}

TEST(RequestReader, WhatThePageNeverAsksIsRefused) {
  const std::string host = kHost;
  EXPECT_EQ(refusalOf("DELETE / HTTP/1.1\r\n" + host + "\r\n"), 405);
  EXPECT_EQ(refusalOf("GET / HTTP/2.0\r\n" + host + "\r\n"), 505);
  EXPECT_EQ(refusalOf("GET /\r\n\r\n"), 400);
  EXPECT_EQ(refusalOf("\r\n\r\n"), 400);
  EXPECT_EQ(refusalOf("GET / HTTP/1.1\r\n\r\n"), 400) << "no Host";
  EXPECT_EQ(refusalOf("GET / HTTP/1.1\r\n" + host + host + "\r\n"), 400) << "two Hosts";
  EXPECT_EQ(refusalOf("GET / HTTP/1.1\r\n" + host + "Content-Length: 3\r\n\r\nabc"), 400);
  EXPECT_EQ(refusalOf("POST / HTTP/1.1\r\n" + host + "\r\n"), 411);
  EXPECT_EQ(refusalOf("POST / HTTP/1.1\r\n" + host + "Content-Length: 4097\r\n\r\n"), 413);
  EXPECT_EQ(refusalOf("POST / HTTP/1.1\r\n" + host + "Content-Length: 99999999999999999999999\r\n\r\n"), 413);
  EXPECT_EQ(refusalOf("POST / HTTP/1.1\r\n" + host + "Content-Length: -1\r\n\r\n"), 400);
  EXPECT_EQ(refusalOf("POST / HTTP/1.1\r\n" + host + "Content-Length: 1\r\nContent-Length: 1\r\n\r\n"), 400);
  EXPECT_EQ(refusalOf("POST / HTTP/1.1\r\n" + host + "Transfer-Encoding: chunked\r\n\r\n"), 501);
  EXPECT_EQ(refusalOf("POST / HTTP/1.1\r\n" + host + "Expect: 100-continue\r\nContent-Length: 1\r\n\r\n"),
            417);
  EXPECT_EQ(refusalOf("GET / HTTP/1.1\r\n" + host + " folded: 1\r\n\r\n"), 400);
  EXPECT_EQ(refusalOf("GET / HTTP/1.1\r\n" + host + "no colon\r\n\r\n"), 400);
  EXPECT_EQ(refusalOf("GET / HTTP/1.1\r\n" + host + "a: b\nc: d\r\n\r\n"), 400) << "a bare line feed";
  EXPECT_EQ(refusalOf("GET / HTTP/1.1\r\n" + host + std::string("a: \0b\r\n\r\n", 10)), 400);
}

TEST(RequestReader, PathsThatLeadElsewhereAreRefused) {
  for (const char* path : {"/../etc/passwd", "/views/../../etc/passwd", "/%2e%2e/etc/passwd", "//etc/passwd",
                           "/a\\b", "/?token=x", "/#x", "http://127.0.0.1/", "*", "/a b"}) {
    const int status = refusalOf(std::string("GET ") + path + " HTTP/1.1\r\n" + kHost + "\r\n");
    EXPECT_EQ(status, 400) << path;
  }
  EXPECT_EQ(refusalOf("GET /" + std::string(300, 'a') + " HTTP/1.1\r\n" + kHost + "\r\n"), 414);
}

TEST(RequestReader, HugeHeadsEndEarly) {
  RequestReader endless;
  std::size_t sent = 0;
  while (endless.take(std::string(1000, 'a')) == ReadProgress::Reads && sent < 100'000) sent += 1000;
  EXPECT_EQ(endless.status(), 431);
  EXPECT_LT(sent, 10'000u);
  std::string many = std::string("GET / HTTP/1.1\r\n") + kHost;
  for (int i = 0; i < 100; ++i) many += "a: b\r\n";
  EXPECT_EQ(refusalOf(many + "\r\n"), 431);
  EXPECT_EQ(refusalOf("GET / HTTP/1.1\r\nRange: bytes=" + std::string(9000, '0') + "\r\n\r\n"), 431);
}

}  // namespace
}  // namespace stadion
