#pragma once
/// Chromium without a window, and what a person does with it: opens a page, presses keys, and asks what a screen reader
/// would say.
///
/// It is told through the DevTools protocol (https://chromedevtools.github.io/devtools-protocol/), whose messages go
/// through two pipes: JSON, each with a zero behind it.
///
/// Units    CSS pixels.
/// Threads  one.

#include "tests/programs/desk.h"

#include <nlohmann/json.hpp>

#include <memory>
#include <string>
#include <vector>

namespace stadion {

/// What a screen reader says of an element.
struct SpokenElement {
  std::string role, name;
};

class Browser {
public:
  /// Null if there is no Chromium, or if it does not answer.
  static std::unique_ptr<Browser> open(int width, int height);
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  void go(const std::string& address);
  /// Returns the value of an expression of JavaScript in the page; null if it fails.
  nlohmann::json value(const std::string& expression);
  /// Waits in good time until the expression is true.
  bool becomes(const std::string& expression);
  /// "Tab", "Enter" or "Space".
  void press(const std::string& key);
  /// All elements that are not hidden, in the order of the page.
  std::vector<SpokenElement> spoken();

private:
  Browser() = default;
  /// Returns "result" of the answer; null if none comes in good time.
  nlohmann::json ask(const std::string& method, nlohmann::json parameters);
  bool send(const std::string& text);
  /// Returns the next message; empty if none comes in good time.
  std::string next();

  TestFolder folder_;
  int to_ = -1, from_ = -1;
  std::string read_, session_;
  int asked_ = 0;
  std::unique_ptr<RunningProgram> program_;
};

}  // namespace stadion
