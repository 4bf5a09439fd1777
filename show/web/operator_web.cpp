#include "show/web/operator_web.h"

#include "engine/scene/scene.h"
#include "show/web/web_command.h"
#include "show/web/web_metrics.h"
#include "show/web/web_page.h"
#include "show/web/web_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

namespace stadion {
namespace {

constexpr std::chrono::milliseconds kStateKept{200};  ///< so long one text answers all clients
constexpr const char* kJson = "application/json";

WebAnswer refusedWith(int status, std::string why) {
  return {status, "text/plain; charset=utf-8", std::move(why) + "\n"};
}

/// The numbers in "/views/2/0" behind the name.
template <std::size_t N>
std::optional<std::array<std::uint64_t, N>> numbersBehind(std::string_view path, std::string_view name) {
  if (!path.starts_with(name)) return {};
  path.remove_prefix(name.size());
  std::array<std::uint64_t, N> numbers{};
  for (std::uint64_t& number : numbers) {
    if (!path.starts_with('/')) return {};
    path.remove_prefix(1);
    const auto [end, error] = std::from_chars(path.data(), path.data() + path.size(), number);
    if (error != std::errc()) return {};
    path.remove_prefix(static_cast<std::size_t>(end - path.data()));
  }
  return path.empty() ? std::optional(numbers) : std::nullopt;
}

/// HOST:PORT of "https://HOST:PORT".
std::string_view authorityOf(std::string_view origin) {
  const std::size_t slashes = origin.find("://");
  return slashes == std::string_view::npos ? std::string_view() : origin.substr(slashes + 3);
}

}  // namespace

std::unique_ptr<OperatorWeb> OperatorWeb::create(const WebSettings& settings, Reporter& reporter,
                                                 Diagnostics& findings) {
  if (settings.address.empty()) return nullptr;
  const auto address = WebAddress::parse(settings.address);
  if (!address) {
    findings.error({}, "--web: " + address.error().message);
    return nullptr;
  }
  auto token = settings.tokenFile.empty() ? WebToken::make() : WebToken::load(settings.tokenFile, findings);
  if (!token) {
    findings.add(token.error());
    return nullptr;
  }
  return std::unique_ptr<OperatorWeb>(new OperatorWeb(settings, address.value(), token.value(), reporter));
}

OperatorWeb::OperatorWeb(WebSettings settings, WebAddress address, WebToken token, Reporter& reporter)
    : settings_(std::move(settings)), address_(std::move(address)), token_(std::move(token)),
      reporter_(reporter) {}

OperatorWeb::~OperatorWeb() = default;

bool OperatorWeb::listen(OperatorQueue& queue, Diagnostics& findings) {
  if (server_) return true;
  queue_ = &queue;
  auto server = WebServer::open(address_, [this](const WebRequest& request) { return answer(request); });
  if (!server) {
    findings.error({}, "--web: " + server.error().message);
    return false;
  }
  server_ = std::move(server.value());
  address_ = server_->address();
  const std::string where = "http://" + address_.authority() + "/";
  reporter_.say("web: " + where);
  // The token is for the person at the terminal, and for no journal.
  if (settings_.tokenFile.empty()) reporter_.hint("web: open " + where + "#" + token_.text());
  if (!address_.isLoopback())
    reporter_.say(
        "web: other machines can reach the page, and nothing is encrypted: put a proxy with TLS in front");
  return true;
}

double OperatorWeb::uptime() const {
  return std::chrono::duration<double>(Clock::now() - opened_).count();
}

// What the show tells
// ------------------------------------------------------------------------------------------------

void OperatorWeb::say(const std::string& line) {
  log_.add(uptime(), line);
}

void OperatorWeb::say(const Diagnostics& findings) {
  for (const Diagnostic& d : findings.all()) {
    Diagnostic line = d;
    line.excerpt.clear();
    say(format(line));
  }
}

std::function<void(const FrameFacts&)> OperatorWeb::lateFunction(std::vector<std::string> walls) {
  return [this, walls = std::move(walls)](const FrameFacts& facts) {
    meter_.lateFrame(facts);
    lateLog_.add(uptime(), toText(facts, walls));
  };
}

void OperatorWeb::beginShow(BoardShow show, const BoardFrame& first) {
  std::vector<std::size_t> views;
  for (const BoardWall& wall : show.walls) views.push_back(wall.views.size());
  thumbnails_.setViews(std::move(views));
  frame_ = first;
  loadsSeen_ = 0;
  cues_.reset();
  board_.beginShow(std::move(show), first);
}

PictureSink& OperatorWeb::sinkBefore(PictureSink* sink) {
  tap_.passOnTo(sink);
  return tap_;
}

void OperatorWeb::see(const TimeSignature& now, std::uint64_t group, const OperatorState& state,
                      const Scene& scene) {
  frame_ = {now.frame, group, now.time, state};
  board_.publish(frame_);
  if (const std::uint64_t version = scene.tree().version(); std::exchange(loadsSeen_, version) != version)
    cues_ = cuesOf(scene);
  if (cues_ && board_.publishCues(*cues_)) cues_.reset();
}

void OperatorWeb::commanded(const OperatorState& state) {
  frame_.state = state;
  board_.publish(frame_);
}

void OperatorWeb::seeHosts(std::vector<BoardHost> hosts) {
  board_.publishHosts(hosts);
}

void OperatorWeb::endShow(bool isLast) {
  board_.setPhase(isLast ? BoardPhase::Over : BoardPhase::Opening);
}

// What the page asks
// -------------------------------------------------------------------------------------------------

bool OperatorWeb::isAllowed(const WebRequest& request, WebAnswer& refusal) const {
  if (!isOwnHost(request.host, settings_.names)) {
    refusal =
        refusedWith(421, "this page is known by its address, by localhost, and by the names of --web-name");
    return false;
  }
  if (request.method == "GET") return true;
  const std::string_view origin = authorityOf(request.origin);
  const bool sameOrigin = request.origin.empty() || origin == request.host ||
                          std::ranges::any_of(settings_.names, [&](const std::string& name) {
                            return origin.substr(0, origin.find(':')) == name;
                          });
  const bool sameSite =
      request.fetchSite.empty() || request.fetchSite == "same-origin" || request.fetchSite == "none";
  if (sameOrigin && sameSite) return true;
  refusal = refusedWith(403, "commands come from the page itself");
  return false;
}

WebAnswer OperatorWeb::answer(const WebRequest& request) {
  WebAnswer refusal;
  if (!isAllowed(request, refusal)) return refusal;
  // The page itself holds no secret. It asks for everything else with the token.
  if (request.method == "GET")
    if (const WebPageFile* file = webPageFile(request.path))
      return {200, file->type, std::string(file->text())};
  if (!token_.matches(request.token)) {
    ++unauthorized_;
    return refusedWith(
        401, "the token is missing or wrong; it stands behind # in the address that the program printed");
  }
  return request.method == "POST" ? command(request) : answerGet(request.path);
}

WebAnswer OperatorWeb::answerGet(const std::string& path) {
  if (path == "/state") return {200, kJson, stateJson()};
  if (path == "/metrics") return {200, "text/plain; version=0.0.4; charset=utf-8", metrics()};
  if (const auto after = numbersBehind<1>(path, "/log"))
    return {200, kJson, linesJson(log_.linesAfter((*after)[0]))};
  if (const auto after = numbersBehind<1>(path, "/late"))
    return {200, kJson, linesJson(lateLog_.linesAfter((*after)[0]))};
  if (const auto place = numbersBehind<2>(path, "/views")) {
    thumbnails_.look();
    std::string png = thumbnails_.png((*place)[0], (*place)[1]);
    return png.empty() ? refusedWith(404, "there is no picture of this view yet")
                       : WebAnswer{200, "image/png", std::move(png)};
  }
  return refusedWith(404, "there is nothing here");
}

WebAnswer OperatorWeb::command(const WebRequest& request) {
  if (request.path != "/command") return refusedWith(404, "commands go to /command");
  if (!request.contentType.starts_with(kJson)) return refusedWith(415, "a command is application/json");
  const WebCommand read = readWebCommand(request.body);
  if (!read.command) return refusedWith(400, read.complaint);
  if (!queue_->post(*read.command))
    return refusedWith(503, "too many commands wait; the show takes none at the moment");
  ++commands_;
  return {200, kJson, "{\"taken\":true}\n"};
}

std::string OperatorWeb::stateJson() {
  thumbnails_.look();
  const std::lock_guard lock(stateMutex_);
  const auto now = Clock::now();
  if (now - stateMade_ < kStateKept) return state_;
  stateMade_ = now;
  WebState state{board_.read(), meter_.now(), {}, 0, 0, uptime()};
  for (std::size_t w = 0; w < state.status.show.walls.size(); ++w) {
    std::vector<std::uint64_t>& versions = state.pictures.emplace_back();
    for (std::size_t v = 0; v < state.status.show.walls[w].views.size(); ++v)
      versions.push_back(thumbnails_.version(w, v));
  }
  state.lastLine = log_.newest();
  state.lastLate = lateLog_.newest();
  return state_ = toJson(state);
}

std::string OperatorWeb::metrics() const {
  const GateCounts gate = server_ ? server_->counts() : GateCounts{};
  return metricsText({board_.read(), meter_.now(), gate, commands_, unauthorized_, uptime()});
}

}  // namespace stadion
