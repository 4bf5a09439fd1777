#include "tests/programs/browser.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>

namespace stadion {
namespace {

using Message = nlohmann::json;

constexpr std::chrono::seconds kGoodTime{60};

/// A named pipe that this process may open before the other end is there.
int openPipe(const std::string& name) {
  return mkfifo(name.c_str(), 0600) == 0 ? open(name.c_str(), O_RDWR | O_CLOEXEC) : -1;
}

}  // namespace

std::unique_ptr<Browser> Browser::open(int width, int height) {
  if (runProgram({{"chromium", "--version"}}).status != 0) return nullptr;
  std::unique_ptr<Browser> browser(new Browser);
  const std::string to = browser->folder_.path() / "to", from = browser->folder_.path() / "from";
  browser->to_ = openPipe(to);
  browser->from_ = openPipe(from);
  // Chromium reads its orders from descriptor 3 and answers on descriptor 4.
  ProgramRun run;
  run.words = {"sh",
               "-c",
               "exec chromium --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --no-first-run "
               "--remote-debugging-pipe \"--user-data-dir=$1\" 3<\"$2\" 4>\"$3\"",
               "sh",
               browser->folder_.path() / "profile",
               to,
               from};
  browser->program_ = std::make_unique<RunningProgram>(run);
  const Message page = browser->ask("Target.createTarget", {{"url", "about:blank"}});
  if (!page.is_object()) return nullptr;
  const Message session =
      browser->ask("Target.attachToTarget", {{"targetId", page["targetId"]}, {"flatten", true}});
  if (!session.is_object()) return nullptr;
  browser->session_ = session["sessionId"];
  browser->ask("Emulation.setDeviceMetricsOverride",
               {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", true}});
  return browser;
}

Browser::~Browser() {
  if (program_) program_->kill();
  for (const int pipe : {to_, from_})
    if (pipe >= 0) close(pipe);
}

bool Browser::send(const std::string& text) {
  std::size_t sent = 0;
  while (sent <= text.size()) {  // the zero at the end as well
    const ssize_t count = write(to_, text.c_str() + sent, text.size() + 1 - sent);
    if (count <= 0) return false;
    sent += static_cast<std::size_t>(count);
  }
  return true;
}

std::string Browser::next() {
  const auto end = std::chrono::steady_clock::now() + kGoodTime;
  for (;;) {
    if (const std::size_t zero = read_.find('\0'); zero != std::string::npos) {
      std::string message = read_.substr(0, zero);
      read_.erase(0, zero + 1);
      return message;
    }
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    pollfd ready{from_, POLLIN, 0};
    if (left.count() <= 0 || poll(&ready, 1, static_cast<int>(left.count())) <= 0) return "";
    std::array<char, 65536> part{};
    const ssize_t count = read(from_, part.data(), part.size());
    if (count <= 0) return "";
    read_.append(part.data(), static_cast<std::size_t>(count));
  }
}

Message Browser::ask(const std::string& method, Message parameters) {
  Message order{{"id", ++asked_}, {"method", method}, {"params", std::move(parameters)}};
  if (!session_.empty()) order["sessionId"] = session_;
  if (!send(order.dump())) return nullptr;
  for (;;) {
    const std::string text = next();
    if (text.empty()) return nullptr;
    const Message answer = Message::parse(text, nullptr, false);
    if (answer.is_object() && answer.value("id", 0) == asked_) return answer.value("result", Message());
  }
}

void Browser::go(const std::string& address) {
  ask("Page.navigate", {{"url", address}});
}

Message Browser::value(const std::string& expression) {
  const Message answer = ask("Runtime.evaluate", {{"expression", expression}, {"returnByValue", true}});
  return answer.is_object() ? answer.value("result", Message::object()).value("value", Message()) : nullptr;
}

bool Browser::becomes(const std::string& expression) {
  return program_->waitUntil([&] { return value(expression) == true; });
}

void Browser::press(const std::string& key) {
  Message pressed{{"type", "keyDown"}, {"key", key}, {"code", key}, {"windowsVirtualKeyCode", 9}};
  if (key == "Enter") {
    pressed["windowsVirtualKeyCode"] = 13;
    pressed["text"] = "\r";
  } else if (key == "Space") {
    pressed["windowsVirtualKeyCode"] = 32;
    pressed["key"] = pressed["text"] = " ";
  }
  ask("Input.dispatchKeyEvent", pressed);
  pressed["type"] = "keyUp";
  pressed.erase("text");
  ask("Input.dispatchKeyEvent", pressed);
}

std::vector<SpokenElement> Browser::spoken() {
  const auto text = [](const Message& node, const char* part) {
    const Message found = node.value(part, Message::object()).value("value", Message());
    return found.is_string() ? found.get<std::string>() : std::string();
  };
  ask("Accessibility.enable", Message::object());
  const Message tree = ask("Accessibility.getFullAXTree", Message::object());
  std::vector<SpokenElement> all;
  if (tree.is_object())
    for (const Message& node : tree["nodes"])
      if (!node.value("ignored", false)) all.push_back({text(node, "role"), text(node, "name")});
  return all;
}

}  // namespace stadion
