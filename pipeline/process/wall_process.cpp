#include "pipeline/process/wall_process.h"

#include "engine/base/installed_files.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <string_view>
#include <sys/socket.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace stadion::wall_process {
namespace {

/// Asked many times a second while a wall is drawn: it allocates nothing.
ProcessStatus statusOf(int pid) {
  char text[1024];  // the longest line has some 400 characters
  std::snprintf(text, sizeof text, "/proc/%d/stat", pid);
  const FileDescriptor file(::open(text, O_RDONLY | O_CLOEXEC));
  const ssize_t size = file ? ::read(file.get(), text, sizeof text) : 0;
  std::string_view left(text, size > 0 ? static_cast<std::size_t>(size) : 0);
  const auto name = left.rfind(')');  // the program's name may hold blanks
  if (name == left.npos) return {};
  left.remove_prefix(std::min(name + 2, left.size()));
  constexpr int kState = 0, kUser = 11, kSystem = 12, kEnd = 49;  // the first of these is the third field
  ProcessStatus status;
  long ticks = 0, end = 0;
  for (int field = 0; !left.empty(); ++field) {
    const std::string_view word = left.substr(0, left.find_first_of(" \n"));
    left.remove_prefix(std::min(word.size() + 1, left.size()));
    long value = 0;
    std::from_chars(word.data(), word.data() + word.size(), value);
    if (field == kState && !word.empty()) status.state = word[0];
    if (field == kUser || field == kSystem) ticks += value;
    if (field == kEnd) end = value;
    if (field < kEnd) continue;
    status.processorSeconds = static_cast<double>(ticks) / static_cast<double>(sysconf(_SC_CLK_TCK));
    status.end = static_cast<int>(end);
    return status;
  }
  return {};
}

/// As ChildProcess::wait() has it.
std::string sentenceOf(int status) {
  constexpr int kSignalled = 128;
  if (status <= kSignalled) return "ended with exit code " + std::to_string(status);
  const int signal = status - kSignalled;
  return "was killed by signal " + std::to_string(signal) + " (" + ::strsignal(signal) + ")";
}

std::size_t pictureBytes(const WallProcessSetting& s) {
  return std::size_t{s.width} * s.height * 4;
}

}  // namespace

std::filesystem::path wallProgram() {
  return helperProgram("stadion-wall");
}

WallProcess::WallProcess(WallProcessSetting setting, const MeshStore& meshes, SharedMeshes& shared)
    : setting_(std::move(setting)), meshes_(meshes), sharedMeshes_(shared),
      listBytes_("stadion-list", kListReserve), pictures_("stadion-pictures", kPictureReserve) {
  pictures_.growTo(pictureBytes(setting_));
}

std::optional<std::string> WallProcess::start() {
  stop();
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) return std::strerror(errno);
  FileDescriptor ours(ends[0]);
  const FileDescriptor theirs(ends[1]);
  const ChildProcess::Streams streams{theirs.get(), -1, STDERR_FILENO};
  if (const auto error = process_->start({setting_.program.string()}, streams)) {
    state_ = State::Down;
    return setting_.program.string() + ": " + std::strerror(*error);
  }
  socket_ = std::move(ours);
  ++started_;
  state_ = State::Opening;
  OrderHead head;
  head.width = setting_.width;
  head.height = setting_.height;
  head.renderer = setting_.renderer;
  head.rasteriserThreads = setting_.rasteriserThreads;
  head.quality = setting_.quality;
  head.processors = setting_.processors;
  head.card = setting_.card;
  const std::array<int, 3> segments{listBytes_.descriptor(), sharedMeshes_.descriptor(),
                                    pictures_.descriptor()};
  order(head, segments);
  return {};
}

void WallProcess::stop() {
  socket_.close();
  std::erase_if(dying_, [](const auto& p) { return p->wait(std::chrono::milliseconds(0)).has_value(); });
  if (process_->running()) {
    process_->kill();
    dying_.push_back(std::exchange(process_, std::make_unique<ChildProcess>()));
  }
  for (const auto& [id, sent] : sent_) sharedMeshes_.giveBack(sent.place);
  sent_.clear();
  known_ = {};
  state_ = State::Down;
}

/// Sends an order. An order that cannot be sent is never answered; the wait for the answer reports why.
void WallProcess::order(const OrderHead& head, std::span<const int> descriptors) {
  OrderHead copy = head;
  iovec part{&copy, sizeof copy};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  alignas(cmsghdr) char control[CMSG_SPACE(3 * sizeof(int))] = {};
  if (!descriptors.empty()) {
    message.msg_control = control;
    message.msg_controllen = sizeof control;
    cmsghdr* attached = CMSG_FIRSTHDR(&message);
    attached->cmsg_level = SOL_SOCKET;
    attached->cmsg_type = SCM_RIGHTS;
    attached->cmsg_len = CMSG_LEN(descriptors.size_bytes());
    std::memcpy(CMSG_DATA(attached), descriptors.data(), descriptors.size_bytes());
  }
  while (::sendmsg(socket_.get(), &message, MSG_NOSIGNAL | MSG_DONTWAIT) < 0 && errno == EINTR) {
  }
}

void WallProcess::draw(const DrawList& list, bool read) {
  OrderHead head;
  head.read = read;
  draw(list, head);
}

void WallProcess::warmUp(const DrawList& list) {
  OrderHead head;
  head.warmUp = 1;
  draw(list, head);
}

void WallProcess::draw(const DrawList& list, OrderHead head) {
  const ListNews news = newsFor(list);
  pictures_.growTo(list.viewCount * pictureBytes(setting_));
  head.order = Order::Draw;
  reads_ = head.read;
  holdsPictures_ = false;
  head.listBytes = write(list, news, known_, listBytes_);
  state_ = State::Busy;
  order(head);
}

void WallProcess::readPictures() {
  OrderHead head;
  head.order = Order::Read;
  reads_ = true;
  holdsPictures_ = false;
  state_ = State::Busy;
  order(head);
}

ListNews WallProcess::newsFor(const DrawList& list) {
  ListNews news;
  forgetFreed(news);
  if (list.sky.environment.picture != kNoMesh) add(list.sky.environment.picture, news);
  MeshId last = kNoMesh;
  const auto addAll = [&](const std::vector<DrawItem>& items) {
    for (const DrawItem& item : items)
      if (item.mesh != last) add(last = item.mesh, news);
  };
  addAll(list.opaque);
  addAll(list.transparent);
  if (list.shadows.light < 0) return news;
  for (std::size_t i = 0; i < kShadowRings; ++i) {
    const DrawShadowRing& ring = list.shadows.rings[i];
    addAll(ring.moving);
    if (ring.still && known_[i] != ring.stillKey) addAll(*ring.still);
  }
  return news;
}

void WallProcess::add(MeshId id, ListNews& news) {
  if (sent_.contains(id)) return;
  const Mesh* mesh = meshes_.find(id);
  if (!mesh) return;
  if (const auto place = sharedMeshes_.take(id, mesh->hash)) {
    sent_[id] = {*place, mesh->hash};
    news.meshes.push_back(*place);
  }
}

void WallProcess::forgetFreed(ListNews& news) {
  const std::uint64_t freed = meshes_.freedCount();
  if (freed == freedCount_) return;
  freedCount_ = freed;
  for (auto at = sent_.begin(); at != sent_.end();) {
    if (meshes_.holds(at->first, at->second.hash)) {
      ++at;
      continue;
    }
    news.gone.push_back(at->first);
    sharedMeshes_.giveBack(at->second.place);
    at = sent_.erase(at);
  }
  if (!news.gone.empty()) known_ = {};  // what stands still may name them
}

bool WallProcess::receive(std::chrono::milliseconds atMost) {
  if (state_ == State::Down || state_ == State::Idle) return false;
  pollfd one{socket_.get(), POLLIN, 0};
  const int ready = ::poll(&one, 1, static_cast<int>(atMost.count()));
  if (ready <= 0) {
    updateStatus();
    return false;
  }
  char bytes[sizeof(AnswerHead) + kLongestText];
  const ssize_t got = ::recv(socket_.get(), bytes, sizeof bytes, MSG_DONTWAIT);
  if (got < 0 && (errno == EINTR || errno == EAGAIN)) return false;
  if (got <= 0) {  // it is ending; the reason is known once it has ended
    if (const auto status = process_->wait(atMost)) noteEnd(sentenceOf(*status));
    return false;
  }
  AnswerHead head;
  const bool whole = got >= static_cast<ssize_t>(sizeof head);
  if (whole) std::memcpy(&head, bytes, sizeof head);
  if (!whole || head.magic != kMagic || head.textBytes != static_cast<std::size_t>(got) - sizeof head) {
    noteEnd("sent an invalid answer");
    return false;
  }
  answer_ = head;
  holdsPictures_ = reads_ && !head.failed && head.to != Order::Open;
  text_.assign(bytes + sizeof head, head.textBytes);
  state_ = State::Idle;
  return true;
}

/// Asks the system. A zombie has ended: its drawing thread is dead, although a thread of lowest priority may
/// live on for seconds.
void WallProcess::updateStatus() {
  status_ = statusOf(pid());
  if (status_.state != 'Z') return;
  noteEnd(sentenceOf(WIFSIGNALED(status_.end) ? 128 + WTERMSIG(status_.end) : WEXITSTATUS(status_.end)));
}

void WallProcess::noteEnd(const std::string& how) {
  end_ = how;
  stop();
}

std::span<const std::byte> WallProcess::picture(std::uint32_t view) const {
  return {pictures_.data() + view * pictureBytes(setting_), pictureBytes(setting_)};
}

}  // namespace stadion::wall_process
