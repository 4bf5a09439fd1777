/// The server over real sockets: clients that are many, slow, wrong or rude.

#include "show/web/web_server.h"
#include "tests/programs/program.h"
#include "tests/programs/web_client.h"

#include <gtest/gtest.h>

#include <thread>

namespace stadion {
namespace {

std::unique_ptr<WebServer> echoServer(GateLimits limits = {}) {
  auto server = WebServer::open(
      {},
      [](const WebRequest& r) {
        return WebAnswer{200, "text/plain", r.method + " " + r.path + " " + r.body};
      },
      limits);
  return server ? std::move(server.value()) : nullptr;
}

std::string get(const WebServer& server, const std::string& path) {
  return webAnswer(server.address().port, webRequestText("GET", path, ""));
}

TEST(ThreadsWebServer, AnswersWithItsHeadersAndCloses) {
  const auto server = echoServer();
  ASSERT_TRUE(server);
  const std::string answer = get(*server, "/a/b");
  EXPECT_EQ(webStatus(answer), 200) << answer;
  EXPECT_TRUE(answer.ends_with("\r\n\r\nGET /a/b ")) << answer;
  EXPECT_TRUE(has(answer, "Content-Security-Policy: default-src 'none'"));
  EXPECT_TRUE(has(answer, "X-Content-Type-Options: nosniff"));
  const std::string posted = webAnswer(server->address().port, webRequestText("POST", "/c", "", "body"));
  EXPECT_TRUE(posted.ends_with("POST /c body")) << posted;
}

TEST(ThreadsWebServer, ATakenPortIsAnErrorAndAFreeOneIsTold) {
  const auto server = echoServer();
  ASSERT_TRUE(server);
  EXPECT_NE(server->address().port, 0);
  const auto second = WebServer::open(server->address(), [](const WebRequest&) { return WebAnswer{}; });
  ASSERT_FALSE(second);
  EXPECT_TRUE(has(second.error().message, "cannot listen on 127.0.0.1:")) << second.error().message;
  EXPECT_FALSE(WebServer::open({"192.0.2.1", 8080}, [](const WebRequest&) { return WebAnswer{}; }))
      << "not ours";
}

TEST(ThreadsWebServer, WrongRequestsGetTheirStatus) {
  const auto server = echoServer();
  ASSERT_TRUE(server);
  const std::uint16_t port = server->address().port;
  EXPECT_EQ(webStatus(webAnswer(port, "GET /../etc/passwd HTTP/1.1\r\nHost: localhost\r\n\r\n")), 400);
  EXPECT_EQ(webStatus(webAnswer(port, "\x16\x03\x01 hello in TLS\r\n\r\n")), 400);
  EXPECT_EQ(webStatus(webAnswer(port, "PUT / HTTP/1.1\r\nHost: localhost\r\n\r\n")), 405);
  EXPECT_EQ(webStatus(webAnswer(port, webRequestText("POST", "/", "", std::string(5000, 'x')))), 413);
  EXPECT_EQ(webStatus(webAnswer(port, "GET / HTTP/1.1\r\nX: " + std::string(1'000'000, 'a'))), 431);
  EXPECT_EQ(webStatus(get(*server, "/still-there")), 200);
  EXPECT_GE(server->counts().refused, 5u);
}

TEST(ThreadsWebServer, SlowClientsDelayNoOther) {
  GateLimits limits;
  limits.connections = 20;
  const auto server = echoServer(limits);
  ASSERT_TRUE(server);
  std::vector<std::unique_ptr<WebClient>> slow;
  for (int i = 0; i < 19; ++i) {
    slow.push_back(std::make_unique<WebClient>(server->address().port));
    slow.back()->send("GET / HT");
  }
  EXPECT_EQ(webStatus(get(*server, "/quick")), 200);
  for (int i = 0; i < 40; ++i) {  // more than there is room for
    slow.push_back(std::make_unique<WebClient>(server->address().port));
    slow.back()->send("GET / HT");
  }
  EXPECT_EQ(webStatus(get(*server, "/quick")), 200);
  EXPECT_GT(server->counts().replaced, 0u);
  EXPECT_LE(server->counts().open, 20u);
}

TEST(ThreadsWebServer, AClientThatNeverFinishesIsToldAndDropped) {
  GateLimits limits;
  limits.reading = std::chrono::milliseconds(100);
  const auto server = echoServer(limits);
  ASSERT_TRUE(server);
  const WebClient client(server->address().port);
  client.send("GET / HTTP/1.1\r\nHost: localhost\r\n");
  EXPECT_EQ(webStatus(client.answer()), 408);
  EXPECT_EQ(server->counts().slow, 1u);
}

TEST(ThreadsWebServer, ManyClientsAtOnceAllGetTheirOwnAnswer) {
  const auto server = echoServer();
  ASSERT_TRUE(server);
  std::vector<std::thread> clients;
  std::atomic<int> right = 0;
  for (int c = 0; c < 50; ++c)
    clients.emplace_back([&, c] {
      for (int i = 0; i < 4; ++i) {
        const std::string path = "/" + std::to_string(c) + "/" + std::to_string(i);
        if (get(*server, path).ends_with("GET " + path + " ")) ++right;
      }
    });
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(right, 200);
  EXPECT_EQ(server->counts().answered, 200u);
}

TEST(ThreadsWebServer, EndsWhileClientsAreConnected) {
  auto server = echoServer();
  ASSERT_TRUE(server);
  const WebClient idle(server->address().port), half(server->address().port);
  half.send("GET / ");
  server.reset();
  EXPECT_EQ(half.answer(), "");
}

}  // namespace
}  // namespace stadion
