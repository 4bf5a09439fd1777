/// `stadion run --web`: a live show and its page, by requests and in a real browser.

#include "tests/programs/browser.h"
#include "tests/programs/web_client.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <thread>

namespace stadion {
namespace {

using WebJson = nlohmann::json;

constexpr const char* kCuedShow = R"(forcelinear( name=gravity, direction="0, 0, -1" )
forcelinear( name=lift, direction="0, 0, 3", initstate=off, duration=0.5 )
object( name=floor, file=plane.3ds )
dynobject( name=ball, file=football.3ds, position="0, 4, 1", density=0.1, restitution=0.8, hook=gravity, hook=lift )
dynamics( collider=floor, collidee=ball )
cue( name=jump, number=2, label="The ball jumps", eventmessage="called, lift, enable" )
)";
constexpr const char* kToken = "a-token-for-the-tests";

/// A show with a page, beside the test.
class WebShow {
public:
  explicit WebShow(std::vector<std::string> more = {}) {
    show_ = folder_.write("show.evs", kCuedShow);
    const std::string token = folder_.write("token", std::string(kToken) + "\n");
    std::filesystem::permissions(token, std::filesystem::perms::owner_read);
    ProgramRun run;
    run.words = {stadionPath(), "run",        show_,    "--asset-root", assetFolder(),
                 "--walls",     "desktop",    "--size", "64x48",        "--look",
                 "plain",       "--no-sound", "--json", "--web",        std::to_string(port_),
                 "--web-token", token};
    run.words.insert(run.words.end(), more.begin(), more.end());
    program_ = std::make_unique<RunningProgram>(run);
  }

  bool plays() const {
    return program_->says("web: http://127.0.0.1:") && program_->says("playing until Ctrl-C");
  }
  bool says(const std::string& text) const { return program_->says(text); }
  std::uint16_t port() const { return port_; }
  std::string get(const std::string& path, const std::string& token = kToken) const {
    return webAnswer(port_, webRequestText("GET", path, "Authorization: Bearer " + token + "\r\n"));
  }
  int send(const std::string& body, const std::string& more = "") const {
    return webStatus(webAnswer(port_, webRequestText("POST", "/command",
                                                     std::string("Authorization: Bearer ") + kToken +
                                                         "\r\nContent-Type: application/json\r\n" + more,
                                                     body)));
  }
  WebJson state() const {
    const std::string answer = get("/state");
    const std::size_t body = answer.find("\r\n\r\n");
    return WebJson::parse(body == std::string::npos ? "" : answer.substr(body + 4), nullptr, false);
  }
  /// Waits until the state is so.
  bool becomes(const std::function<bool(const WebJson&)>& condition) const {
    return program_->waitUntil([&] {
      const WebJson now = state();
      return now.is_object() && condition(now);
    });
  }
  WebJson finish() {
    program_->waitUntil([&] { return send("{\"command\":\"end\"}"), !program_->runs(); });
    EXPECT_EQ(program_->status(), 0) << program_->err();
    return WebJson::parse(program_->out(), nullptr, false);
  }
  const std::string& show() const { return show_; }
  std::string file(const char* name) const { return folder_.path() / name; }
  std::string err() const { return program_->err(); }

private:
  TestFolder folder_;
  std::string show_;
  std::uint16_t port_ = freePort();
  std::unique_ptr<RunningProgram> program_;
};

TEST(ProgramWeb, CommandsOfThePageAreThoseOfTheConsoleAndAreRecorded) {
  const TestFolder records;
  const std::string record = records.path() / "visit.input";
  WebShow web({"--record-input", record, "--wait"});
  ASSERT_TRUE(web.plays()) << web.err();
  EXPECT_TRUE(web.becomes([](const WebJson& s) { return s["phase"] == "waiting"; }));
  EXPECT_EQ(web.send(R"({"command":"start"})"), 200);
  EXPECT_TRUE(web.becomes([](const WebJson& s) { return s["phase"] == "playing" && s["time"] > 0.2; }));
  EXPECT_EQ(web.send(R"({"command":"cue","value":2})"), 200);
  EXPECT_EQ(web.send(R"({"command":"cue","value":7})"), 200);
  EXPECT_TRUE(web.says("operator: cue 2 (The ball jumps)")) << web.err();
  EXPECT_TRUE(web.says("operator: the show has no cue 7")) << web.err();
  EXPECT_EQ(web.send(R"({"command":"black","value":1})"), 200);
  EXPECT_EQ(web.send(R"({"command":"test-pattern","value":true})"), 200);
  EXPECT_TRUE(web.becomes([](const WebJson& s) {
    return s["operator"]["black"] == true && s["operator"]["testPattern"] == true;
  }));
  EXPECT_EQ(web.send(R"({"command":"pause","value":1})"), 200);
  EXPECT_TRUE(web.becomes([](const WebJson& s) { return s["phase"] == "paused"; }));
  EXPECT_EQ(web.send(R"({"command":"pause","value":0})"), 200);
  EXPECT_TRUE(web.becomes([](const WebJson& s) { return s["phase"] == "playing"; }));
  const WebJson state = web.state();
  EXPECT_EQ(state["show"], "show.evs");
  EXPECT_EQ(state["cues"][0]["label"], "The ball jumps");
  EXPECT_EQ(state["walls"][0]["name"], "screen");
  const WebJson summary = web.finish();
  ASSERT_TRUE(summary.is_object()) << web.err();

  const std::string log = fileContent(record);
  EXPECT_TRUE(has(log, " test-pattern 1\n")) << log.substr(0, 2000);
  EXPECT_TRUE(has(log, "controls operator ")) << log.substr(0, 2000);
  const ProgramResult again = stadionProgram(
      {"hash", web.show(), "--input", record, "--asset-root", assetFolder(), "--walls", "desktop"});
  ASSERT_EQ(again.status, 0) << again.err;
  const std::string last = fmt::format("{} {}\n", summary.at("last_frame").get<int>(),
                                       summary.at("state_hash").get<std::string>());
  EXPECT_TRUE(again.out.ends_with(last)) << again.out.substr(again.out.size() - 60) << last;
}

TEST(ProgramWeb, WhatHasNoTokenOrIsWrongIsRefusedAndTheShowGoesOn) {
  WebShow web;
  ASSERT_TRUE(web.plays()) << web.err();
  EXPECT_EQ(webStatus(web.get("/")), 200) << "the page itself holds nothing";
  EXPECT_EQ(webStatus(web.get("/state", "")), 401);
  EXPECT_EQ(webStatus(web.get("/state", std::string(kToken) + "x")), 401);
  EXPECT_EQ(webStatus(web.get("/metrics", "wrong")), 401);
  EXPECT_EQ(webStatus(web.get("/nothing")), 404);
  EXPECT_EQ(webStatus(web.get("/views/0/0/0")), 404);
  EXPECT_EQ(webStatus(web.get("/views/99999999999999999999/0")), 404);
  const std::string bearer = std::string("Authorization: Bearer ") + kToken + "\r\n";
  EXPECT_EQ(
      webStatus(webAnswer(web.port(), "GET /state HTTP/1.1\r\nHost: evil.example\r\n" + bearer + "\r\n")),
      421);
  const std::string pause = R"({"command":"pause"})";
  EXPECT_EQ(web.send(pause, "Origin: http://evil.example\r\n"), 403);
  EXPECT_EQ(web.send(pause, "Sec-Fetch-Site: cross-site\r\n"), 403);
  EXPECT_EQ(web.send(pause, "Origin: http://127.0.0.1\r\nSec-Fetch-Site: same-origin\r\n"), 200);
  EXPECT_TRUE(web.becomes([](const WebJson& s) { return s["phase"] == "paused"; }));
  EXPECT_EQ(web.send("{"), 400);
  EXPECT_EQ(web.send(R"({"command":"explode"})"), 400);
  EXPECT_EQ(web.send(R"({"command":"volume","value":7})"), 400);
  EXPECT_EQ(web.send(R"({"command":"cue","value":1,"by":true})"), 400);
  EXPECT_EQ(web.send(std::string(4000, '[')), 400);
  EXPECT_EQ(webStatus(webAnswer(web.port(), webRequestText("POST", "/command", bearer, pause))), 415);
  EXPECT_TRUE(has(web.get("/metrics"), "stadion_web_unauthorized_total 3\n"));
  EXPECT_TRUE(has(web.get("/metrics"), "stadion_phase{phase=\"paused\"} 1\n"));
  web.finish();
  EXPECT_FALSE(has(web.err(), kToken)) << "a token from a file is not printed";
}

TEST(ProgramWeb, SmallPicturesComeOfEveryView) {
  WebShow web;
  ASSERT_TRUE(web.plays()) << web.err();
  ASSERT_TRUE(web.becomes([](const WebJson& s) {
    const WebJson& views = s["walls"][0]["views"];
    return views.size() == 2 && views[0]["picture"] > 0 && views[1]["picture"] > 0;
  }));
  const std::string answer = web.get("/views/0/1");
  EXPECT_TRUE(has(answer, "Content-Type: image/png")) << answer.substr(0, 300);
  EXPECT_TRUE(has(answer, "\r\n\r\n\x89PNG"));
  web.finish();
}

TEST(ProgramWeb, WrongOptionsSayWhatIsExpected) {
  const TestFolder folder;
  const std::string show = folder.write("show.evs", kCuedShow);
  const auto run = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"run",     show,      "--asset-root", assetFolder(),
                                   "--walls", "desktop", "--size",       "32x24"};
    words.insert(words.end(), more.begin(), more.end());
    return stadionProgram(words);
  };
  const ProgramResult address = run({"--web", "nowhere"});
  EXPECT_EQ(address.status, 2);
  EXPECT_TRUE(has(address.err, "--web: \"nowhere\" is not [HOST:]PORT")) << address.err;
  const ProgramResult token = run({"--web", "0", "--web-token", folder.write("short", "abc\n")});
  EXPECT_EQ(token.status, 2);
  EXPECT_TRUE(has(token.err, "short: error: a token has 16 to 256 characters")) << token.err;
  const ProgramResult frames = run({"--web", "0", "--frames", "3"});
  EXPECT_EQ(frames.status, 2);
  EXPECT_TRUE(has(frames.err, "--web is for live runs")) << frames.err;
}

/// The page as Chromium leaves it, without a word on its console.
TEST(ProgramWeb, ABrowserShowsThePageWithoutAComplaint) {
  if (runProgram({{"chromium", "--version"}}).status != 0)
    GTEST_SKIP() << "there is no chromium: apt-get install chromium";
  WebShow web;
  ASSERT_TRUE(web.plays()) << web.err();
  const TestFolder folder;
  const ProgramResult r =
      runProgram({{"chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                   "--no-first-run", "--user-data-dir=" + (folder.path() / "browser").string(),
                   "--enable-logging=stderr", "--window-size=360,800", "--virtual-time-budget=6000",
                   "--dump-dom", fmt::format("http://127.0.0.1:{}/#{}", web.port(), kToken)}});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_FALSE(has(r.err, "CONSOLE")) << r.err;
  EXPECT_TRUE(has(r.out, "data-drawn=\"yes\"")) << "the page's script ended early\n" << r.out;
  EXPECT_TRUE(has(r.out, ">2 The ball jumps</button>")) << r.out;
  EXPECT_TRUE(has(r.out, "alt=\"View of screen, left eye\""));
  EXPECT_TRUE(has(r.out, "id=\"phase\" class=\"badge playing\"")) << r.out;
  EXPECT_FALSE(has(r.out, kToken)) << "the token has left the address";
  web.finish();
}

/// By keyboard alone, by ear, and on a phone.
TEST(ProgramWeb, ThePageServesKeyboardScreenReaderAndPhone) {
  const auto browser = Browser::open(360, 800);
  if (!browser) GTEST_SKIP() << "there is no chromium: apt-get install chromium";
  WebShow web;
  ASSERT_TRUE(web.plays()) << web.err();
  browser->go(fmt::format("http://127.0.0.1:{}/#{}", web.port(), kToken));
  ASSERT_TRUE(browser->becomes("!!document.querySelector('[data-drawn=yes]')"));
  ASSERT_TRUE(browser->becomes("document.querySelectorAll('#cues button').length === 1"));
  ASSERT_TRUE(browser->becomes(
      "[...document.querySelectorAll('#views img')].filter(i => i.naturalWidth > 0).length === 2"));

  EXPECT_LE(browser->value("document.documentElement.scrollWidth"), 360)
      << "the page is wider than the phone";
  EXPECT_EQ(browser->value("[...document.querySelectorAll('button')].filter(b => b.offsetParent && "
                           "b.getBoundingClientRect().height < 24).map(b => b.textContent)"),
            WebJson::array())
      << "too low for a finger";

  std::map<std::string, int> count;
  for (const SpokenElement& e : browser->spoken()) {
    ++count[e.role];
    for (const char* role : {"button", "textbox", "slider", "spinbutton", "combobox", "link", "image", "img",
                             "region", "columnheader", "heading"})
      if (e.role == role) {
        EXPECT_NE(e.name, "") << "a screen reader has no name for a " << role;
      }
  }
  EXPECT_GE(count["button"], 10);
  EXPECT_EQ(count["image"] + count["img"], 2);
  EXPECT_EQ(count["slider"], 1);
  EXPECT_EQ(count["combobox"], 1);
  EXPECT_GE(count["heading"], 6);

  const auto walkTo = [&](const std::string& element) {
    for (int step = 0; step < 40; ++step) {
      browser->press("Tab");
      EXPECT_EQ(browser->value("document.activeElement.matches(':focus-visible') && "
                               "getComputedStyle(document.activeElement).outlineStyle !== 'none'"),
                true)
          << "the place of the keyboard is not seen at "
          << browser->value("document.activeElement.outerHTML").dump();
      if (browser->value(fmt::format("document.activeElement.matches('{}')", element)) == true) return true;
    }
    return false;
  };
  ASSERT_TRUE(walkTo("[data-command=pause]"));
  browser->press("Space");
  EXPECT_TRUE(web.becomes([](const WebJson& s) { return s["phase"] == "paused"; }));
  EXPECT_TRUE(browser->becomes(
      "document.querySelector('[data-command=pause]').getAttribute('aria-pressed') === 'true'"));
  browser->press("Enter");
  EXPECT_TRUE(web.becomes([](const WebJson& s) { return s["phase"] == "playing"; }));
  ASSERT_TRUE(walkTo("#cues button"));
  browser->press("Enter");
  EXPECT_TRUE(web.says("operator: cue 2 (The ball jumps)")) << web.err();
  web.finish();
}

}  // namespace
}  // namespace stadion
