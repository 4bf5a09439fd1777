/// stadion-wall: draws one wall for a show, or in the plain look one view, in a process that may die.
///
/// Started by stadion with a socket as its standard input; it ends when the show closes that.

#include "pipeline/cpu_draw/cpu_renderer.h"
#include "pipeline/gl_draw/gl_renderer.h"
#include "pipeline/process/list_bytes.h"
#include "pipeline/process/protocol.h"
#include "pipeline/process/shared_meshes.h"
#include "pipeline/target/rasteriser_settings.h"
#include "pipeline/target/target.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <poll.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <thread>
#include <unistd.h>
#include <unordered_map>

namespace stadion::wall_process {
namespace {

constexpr int kSocket = STDIN_FILENO;

void answer(Order to, const std::string& text, bool failed, const ViewTotals& totals = {}) {
  AnswerHead head;
  head.to = to;
  head.failed = failed;
  head.totals = totals;
  head.textBytes = static_cast<std::uint32_t>(std::min(text.size(), kLongestText));
  iovec parts[] = {{&head, sizeof head}, {const_cast<char*>(text.data()), head.textBytes}};
  msghdr message{};
  message.msg_iov = parts;
  message.msg_iovlen = 2;
  while (::sendmsg(kSocket, &message, MSG_NOSIGNAL) < 0 && errno == EINTR) {
  }
}

void answer(Order to, const std::optional<Diagnostic>& problem, const ViewTotals& totals = {}) {
  answer(to, problem ? problem->message : std::string(), problem.has_value(), totals);
}

/// Receives the next order and its descriptors. Returns false when the show has ended.
bool receive(OrderHead& head, std::array<int, 3>& descriptors) {
  iovec part{&head, sizeof head};
  alignas(cmsghdr) char control[CMSG_SPACE(3 * sizeof(int))];
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  ssize_t got = 0;
  do got = ::recvmsg(kSocket, &message, MSG_CMSG_CLOEXEC);
  while (got < 0 && errno == EINTR);
  if (const cmsghdr* attached = got > 0 ? CMSG_FIRSTHDR(&message) : nullptr;
      attached && attached->cmsg_len == CMSG_LEN(sizeof descriptors))
    std::memcpy(descriptors.data(), CMSG_DATA(attached), sizeof descriptors);
  return got == static_cast<ssize_t>(sizeof head) && head.magic == kMagic && head.version == kVersion;
}

/// When the show has ended, this process ends, too, whatever its driver does.
void goWithTheShow() {
  std::thread([] {
    pollfd show{kSocket, POLLRDHUP, 0};
    while (poll(&show, 1, -1) < 0 || (show.revents & (POLLRDHUP | POLLHUP | POLLERR)) == 0) {
    }
    constexpr std::chrono::seconds kToTidyUp{2};
    std::this_thread::sleep_for(kToTidyUp);
    _exit(1);
  }).detach();
}

/// The wall, or the view of it, that this process draws.
class DrawnWall {
public:
  /// Returns the reason if it cannot open; else nothing.
  std::optional<std::string> open(const OrderHead& order, const std::array<int, 3>& segments);
  void draw(const OrderHead& order);
  void read() { answer(Order::Read, readPictures()); }
  std::string description() const { return renderer_->description(); }

private:
  using Access = SharedSegment::Access;

  std::optional<std::string> openCpu(const OrderHead& order);
  std::optional<std::string> openGl(const OrderHead& order);
  std::optional<Diagnostic> readPictures();
  void takeNews();
  void translateMeshIds(std::vector<DrawItem>& items) const;
  void renameStill();

  std::unique_ptr<SharedSegment> bytes_, sharedMeshes_, pictures_;
  std::unique_ptr<GlProvider> provider_;
  std::unique_ptr<Target> target_;
  MeshStore meshes_;
  std::unique_ptr<DrawPool> pool_;
  std::unique_ptr<CpuRoom> room_;
  std::unique_ptr<Renderer> renderer_;
  std::size_t pictureBytes_ = 0;
  DrawList list_;
  ListNews news_;
  /// The mesh's id in this process, by its id in the show. They are equal, but for a collision of hashes.
  std::unordered_map<MeshId, MeshId> ids_;
  std::array<std::shared_ptr<const std::vector<DrawItem>>, kShadowRings> still_;  ///< renamed
  std::uint64_t frames_ = 0;
};

std::optional<std::string> DrawnWall::open(const OrderHead& order, const std::array<int, 3>& segments) {
  bytes_ = std::make_unique<SharedSegment>(segments[0], kListReserve, Access::Read);
  sharedMeshes_ = std::make_unique<SharedSegment>(segments[1], kMeshReserve, Access::Read);
  pictures_ = std::make_unique<SharedSegment>(segments[2], kPictureReserve, Access::Write);
  if (!order.processors.empty()) order.processors.bindThisThread();  // others will start from here
  goWithTheShow();
  pictureBytes_ = std::size_t{order.width} * order.height * 4;
  return order.renderer == RendererKind::Cpu ? openCpu(order) : openGl(order);
}

/// The threads of the pool run on the processors of the wall, as this one does.
std::optional<std::string> DrawnWall::openCpu(const OrderHead& order) {
  keepFreedMemory();
  const PictureRung rung = PictureRung::of(order.quality);
  const std::size_t threads = order.processors.empty() ? order.rasteriserThreads : order.processors.size();
  pool_ = std::make_unique<DrawPool>(threads);
  room_ = std::make_unique<CpuRoom>(meshes_, rung.look, *pool_);
  auto renderer = CpuRenderer::create(*room_, order.width, order.height, rung);
  if (!renderer) return renderer.error().message;
  renderer_ = std::move(renderer.value());
  return {};
}

std::optional<std::string> DrawnWall::openGl(const OrderHead& order) {
  setRasteriserThreads(order.rasteriserThreads);
  if (const auto why = pinRasteriser()) return why->message;
  auto provider =
      openGlProvider(order.renderer == RendererKind::Egl ? GlProviderKind::Egl : GlProviderKind::OsMesa);
  if (!provider) return provider.error().message;
  provider_ = std::move(provider.value());
  auto target = provider_->createOn(order.card, order.width, order.height);
  if (!target) return target.error().message;
  target_ = std::move(target.value());
  if (const auto why = target_->makeCurrent()) return why->message;
  auto renderer =
      GlRenderer::create(target_->gl(), target_->turns(), meshes_, order.width, order.height, order.quality);
  if (!renderer) return renderer.error().message;
  renderer_ = std::move(renderer.value());
  return {};
}

void DrawnWall::takeNews() {
  ++frames_;
  for (const MeshId gone : news_.gone)
    if (const auto at = ids_.find(gone); at != ids_.end()) {
      meshes_.release(at->second, frames_ - 1);
      ids_.erase(at);
    }
  meshes_.collect(frames_);
  for (const SharedMeshPlace& place : news_.meshes)
    if (auto mesh = meshOf({sharedMeshes_->data() + place.offset, place.bytes}))
      ids_[place.id] = meshes_.add(std::move(mesh));
}

void DrawnWall::translateMeshIds(std::vector<DrawItem>& items) const {
  for (DrawItem& item : items)
    if (const auto at = ids_.find(item.mesh); at != ids_.end()) item.mesh = at->second;
}

/// Renames the meshes of objects that stand still, which may have come with an earlier list.
void DrawnWall::renameStill() {
  for (std::size_t i = 0; i < kShadowRings; ++i) {
    auto& still = list_.shadows.rings[i].still;
    if (!still || still == still_[i]) continue;
    auto renamed = std::make_shared<std::vector<DrawItem>>(*still);
    translateMeshIds(*renamed);
    still = still_[i] = std::move(renamed);
  }
}

void DrawnWall::draw(const OrderHead& order) {
  if (!wall_process::read({bytes_->data(), order.listBytes}, list_, news_))
    return answer(Order::Draw, "the draw list is damaged", true);
  takeNews();
  if (const auto at = ids_.find(list_.sky.environment.picture); at != ids_.end())
    list_.sky.environment.picture = at->second;
  translateMeshIds(list_.opaque);
  translateMeshIds(list_.transparent);
  for (DrawShadowRing& ring : list_.shadows.rings) translateMeshIds(ring.moving);
  renameStill();
  auto problem = order.warmUp ? renderer_->warmUp(list_, {}) : renderer_->draw(list_, {}, nullptr);
  if (!problem && order.read) problem = readPictures();
  answer(Order::Draw, problem, renderer_->totals());
}

std::optional<Diagnostic> DrawnWall::readPictures() {
  for (std::uint32_t view = 0; view < list_.viewCount; ++view) {
    auto* at = reinterpret_cast<std::uint8_t*>(pictures_->data() + view * pictureBytes_);
    if (auto problem = renderer_->read(view, {at, pictureBytes_})) return problem;
  }
  return {};
}

int work() {
  std::signal(SIGINT, SIG_IGN);   // Ctrl-C is for the show
  std::signal(SIGPIPE, SIG_IGN);  // OpenGL may write without a reader
  DrawnWall wall;
  OrderHead order;
  std::array<int, 3> segments{-1, -1, -1};
  if (!receive(order, segments) || order.order != Order::Open || segments[0] < 0) {
    std::fputs("stadion-wall is started by stadion; there is nothing to run by hand\n", stderr);
    return 2;
  }
  const auto why = wall.open(order, segments);
  answer(Order::Open, why ? *why : wall.description(), why.has_value());
  while (!why && receive(order, segments)) {
    if (order.order == Order::Draw) wall.draw(order);
    if (order.order == Order::Read) wall.read();
  }
  return 0;
}

}  // namespace
}  // namespace stadion::wall_process

int main() {
  return stadion::wall_process::work();
}
