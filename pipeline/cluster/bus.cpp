#include "pipeline/cluster/bus.h"

#include "engine/base/late_library.h"
#include "pipeline/cluster/loopback_sockets.h"
#include "pipeline/platform/scoped_realtime_priority.h"

#include <dds/dds.h>
#include <fmt/format.h>

#include <arpa/inet.h>
#include <chrono>
#include <cmath>
#include <thread>
#include <type_traits>
#include <utility>

namespace stadion::cluster {
namespace {

const LateLibrary ddsLibrary(STADION_LIBDDSC, "libddsc0debian");
const LateFunction<decltype(::dds_create_domain)> dds_create_domain(ddsLibrary, "dds_create_domain");
const LateFunction<decltype(::dds_create_listener)> dds_create_listener(ddsLibrary, "dds_create_listener");
const LateFunction<decltype(::dds_create_participant)> dds_create_participant(ddsLibrary,
                                                                              "dds_create_participant");
const LateFunction<decltype(::dds_create_qos)> dds_create_qos(ddsLibrary, "dds_create_qos");
const LateFunction<decltype(::dds_create_reader)> dds_create_reader(ddsLibrary, "dds_create_reader");
const LateFunction<decltype(::dds_create_topic)> dds_create_topic(ddsLibrary, "dds_create_topic");
const LateFunction<decltype(::dds_create_writer)> dds_create_writer(ddsLibrary, "dds_create_writer");
const LateFunction<decltype(::dds_delete)> dds_delete(ddsLibrary, "dds_delete");
const LateFunction<decltype(::dds_delete_listener)> dds_delete_listener(ddsLibrary, "dds_delete_listener");
const LateFunction<decltype(::dds_delete_qos)> dds_delete_qos(ddsLibrary, "dds_delete_qos");
const LateFunction<decltype(::dds_get_publication_matched_status)>
    dds_get_publication_matched_status(ddsLibrary, "dds_get_publication_matched_status");
const LateFunction<decltype(::dds_lset_data_available)> dds_lset_data_available(ddsLibrary,
                                                                                "dds_lset_data_available");
const LateFunction<decltype(::dds_lset_liveliness_changed)>
    dds_lset_liveliness_changed(ddsLibrary, "dds_lset_liveliness_changed");
const LateFunction<decltype(::dds_qset_durability)> dds_qset_durability(ddsLibrary, "dds_qset_durability");
const LateFunction<decltype(::dds_qset_history)> dds_qset_history(ddsLibrary, "dds_qset_history");
const LateFunction<decltype(::dds_qset_ignorelocal)> dds_qset_ignorelocal(ddsLibrary, "dds_qset_ignorelocal");
const LateFunction<decltype(::dds_qset_liveliness)> dds_qset_liveliness(ddsLibrary, "dds_qset_liveliness");
const LateFunction<decltype(::dds_qset_partition)> dds_qset_partition(ddsLibrary, "dds_qset_partition");
const LateFunction<decltype(::dds_qset_reliability)> dds_qset_reliability(ddsLibrary, "dds_qset_reliability");
const LateFunction<decltype(::dds_return_loan)> dds_return_loan(ddsLibrary, "dds_return_loan");
const LateFunction<decltype(::dds_strretcode)> dds_strretcode(ddsLibrary, "dds_strretcode");
const LateFunction<decltype(::dds_take)> dds_take(ddsLibrary, "dds_take");
const LateFunction<decltype(::dds_wait_for_acks)> dds_wait_for_acks(ddsLibrary, "dds_wait_for_acks");
const LateFunction<decltype(::dds_write)> dds_write(ddsLibrary, "dds_write");

dds_duration_t durationOf(double seconds) {
  return static_cast<dds_duration_t>(seconds * 1e9);
}

/// Cyclone's own configuration. It ignores a silence of up to a second; our deadline judges silent hosts. A
/// reader asks for lost data again at once, because a host waits for it. A writer never waits for a reader
/// that does not acknowledge. Cyclone's default would wait after a kilobyte or two, and one crashed host
/// would then stop all others for a second.
std::string configurationOf(const ClusterFile& o) {
  in_addr address{};
  const bool byAddress = inet_pton(AF_INET, o.interface.c_str(), &address) == 1;
  const std::string interface = o.interface.empty()
                                    ? "name=\"lo\""
                                    : fmt::format("{}=\"{}\"", byAddress ? "address" : "name", o.interface);
  // The loopback interface has no multicast, so each participant is looked for one by one.
  const std::string found = o.interface.empty()
                                ? "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>31</"
                                  "MaxAutoParticipantIndex><Peers><Peer address=\"127.0.0.1\"/></Peers>"
                                : "";
  return fmt::format(
      "<Domain id=\"any\"><General><Interfaces><NetworkInterface {}/></Interfaces>"
      "<AllowMulticast>{}</AllowMulticast></General>"
      "<Discovery>{}<LeaseDuration>{}ms</LeaseDuration><SPDPInterval>250ms</SPDPInterval></Discovery>"
      "<Internal><NackDelay>1ms</NackDelay><HeartbeatInterval min=\"2ms\" minsched=\"5ms\" max=\"1s\">5ms"
      "</HeartbeatInterval><PreEmptiveAckDelay>5ms</PreEmptiveAckDelay>"
      "<Watermarks><WhcAdaptive>false</WhcAdaptive><WhcHighInit>2MB</WhcHighInit><WhcHigh>2MB</"
      "WhcHigh><WhcLow>1MB</WhcLow>"
      "</Watermarks></Internal></Domain>",
      interface, o.interface.empty() ? "false" : "true", found,
      static_cast<long>(std::ceil(1000 * std::max(1.0, 2 * o.deadline))));
}

struct Qos {
  Qos() : qos(dds_create_qos()) {}
  ~Qos() { dds_delete_qos(qos); }
  Qos(const Qos&) = delete;
  Qos& operator=(const Qos&) = delete;
  dds_qos_t* qos;
};

std::string reasonOf(dds_return_t code) {
  return dds_strretcode(-code);
}

void write(dds_entity_t writer, const void* sample) {
  dds_write(writer, sample);  // see Errors
}

}  // namespace

template <class T>
void Bus::take(dds_entity_t reader, void* of) {
  auto& bus = *static_cast<Bus*>(of);
  constexpr std::size_t kAtOnce = 16;
  std::array<void*, kAtOnce> samples{};  // null: the reader lends them
  std::array<dds_sample_info_t, kAtOnce> infos{};
  for (;;) {
    const dds_return_t count = dds_take(reader, samples.data(), infos.data(), kAtOnce, kAtOnce);
    if (count <= 0) return;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const T& sample = *static_cast<const T*>(samples[i]);
      if (!infos[i].valid_data) continue;
      if constexpr (std::is_same_v<T, Presence>) {
        if (infos[i].instance_state != DDS_IST_ALIVE) continue;  // its last sample is out of date
        const std::lock_guard lock(bus.speakersMutex_);
        bus.speakers_[infos[i].publication_handle] = {sample.node, sample.incarnation};
      }
      bus.listener_->receive(sample);
    }
    dds_return_loan(reader, samples.data(), count);
  }
}

void Bus::takeLiveliness(dds_entity_t, dds_liveliness_changed_status_t status, void* of) {
  auto& bus = *static_cast<Bus*>(of);
  const bool leaves = status.alive_count_change < 0;
  const bool isGone = status.not_alive_count_change < (leaves ? 1 : 0);  // else it may come back
  Speaker gone;
  {
    const std::lock_guard lock(bus.speakersMutex_);
    const auto at = bus.speakers_.find(status.last_publication_handle);
    if (at == bus.speakers_.end() || status.alive_count_change > 0) return;
    gone = at->second;
    if (isGone) bus.speakers_.erase(at);
  }
  if (!leaves) return;
  bus.listener_->left(gone.node, gone.incarnation);
}

template <class T>
bool Bus::add(Channel channel, const dds_topic_descriptor_t& type, const std::string& name,
              dds_listener_t* heard, dds_qos_t* qos) {
  const dds_entity_t topic = dds_create_topic(participant_, &type, name.c_str(), nullptr, nullptr);
  if (topic < 0) return false;
  dds_lset_data_available(heard, &Bus::take<T>);
  const bool ofPresences = std::is_same_v<T, Presence>;
  dds_lset_liveliness_changed(heard, ofPresences ? &Bus::takeLiveliness : nullptr);
  writers_[channel] = dds_create_writer(participant_, topic, qos, nullptr);
  return writers_[channel] > 0 && dds_create_reader(participant_, topic, qos, heard) > 0;
}

Result<std::unique_ptr<Bus>> Bus::open(const ClusterFile& o, BusListener& listener) {
  const auto wrong = [&](const std::string& why) {
    return Diagnostic{Severity::Error, {}, "the cluster's network cannot be opened: " + why, {}};
  };
  if (const auto missing = ddsLibrary.load()) return wrong(missing->message);
  std::unique_ptr<Bus> bus(new Bus);
  bus->listener_ = &listener;
  const ScopedRealtimePriority prompt(ScopedRealtimePriority::For::ThoseItStarts);  // Cyclone's own
  const LoopbackSockets sockets;
  bus->domain_ = dds_create_domain(o.domain, configurationOf(o).c_str());
  if (bus->domain_ < 0) return wrong(reasonOf(bus->domain_));
  bus->participant_ = dds_create_participant(o.domain, nullptr, nullptr);
  if (bus->participant_ < 0) return wrong(reasonOf(bus->participant_));
  if (o.interface.empty())
    if (const std::string why = sockets.bind(); !why.empty()) return wrong(why);

  Qos every, kept, present;
  const char* partition = o.partition.c_str();
  for (dds_qos_t* qos : {every.qos, kept.qos, present.qos}) {
    dds_qset_partition(qos, 1, &partition);
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, durationOf(1));
    dds_qset_ignorelocal(qos, DDS_IGNORELOCAL_PARTICIPANT);
    dds_qset_history(qos, qos == every.qos ? DDS_HISTORY_KEEP_ALL : DDS_HISTORY_KEEP_LAST, 1);
    if (qos != every.qos) dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  }
  dds_qset_liveliness(present.qos, DDS_LIVELINESS_AUTOMATIC, durationOf(o.deadline));
  dds_listener_t* heard = dds_create_listener(bus.get());
  const bool well =
      bus->add<Session>(kSession, stadion_wire_Session_desc, "stadion_session", heard, kept.qos) &&
      bus->add<Presence>(kPresence, stadion_wire_Presence_desc, "stadion_presence", heard, present.qos) &&
      bus->add<Order>(kOrder, stadion_wire_Order_desc, "stadion_order", heard, every.qos) &&
      bus->add<Drawn>(kDrawn, stadion_wire_Drawn_desc, "stadion_drawn", heard, every.qos) &&
      bus->add<Go>(kGo, stadion_wire_Go_desc, "stadion_go", heard, every.qos) &&
      bus->add<SceneHash>(kSceneHash, stadion_wire_SceneHash_desc, "stadion_scene_hash", heard, every.qos) &&
      bus->add<Difference>(kDifference, stadion_wire_Difference_desc, "stadion_difference", heard,
                           every.qos) &&
      bus->add<StatePart>(kStatePart, stadion_wire_StatePart_desc, "stadion_state_part", heard, every.qos);
  dds_delete_listener(heard);
  if (!well) return wrong("Cyclone DDS does not take a topic");
  return bus;
}

Bus::~Bus() {
  close();
}

void Bus::close() {
  if (participant_ > 0) dds_delete(std::exchange(participant_, 0));
  if (domain_ > 0) dds_delete(std::exchange(domain_, 0));
}

void Bus::send(const Session& session) {
  write(writers_[kSession], &session);
}
void Bus::send(const Presence& presence) {
  write(writers_[kPresence], &presence);
}
void Bus::send(const Order& order) {
  write(writers_[kOrder], &order);
}
void Bus::send(const Drawn& drawn) {
  write(writers_[kDrawn], &drawn);
}
void Bus::send(const Go& go) {
  write(writers_[kGo], &go);
}
void Bus::send(const SceneHash& hash) {
  write(writers_[kSceneHash], &hash);
}
void Bus::send(const Difference& difference) {
  write(writers_[kDifference], &difference);
}
// A reader that acknowledges a large state slowly delays its parts, each by a second.
bool Bus::send(const StatePart& part) {
  constexpr int kMostTries = 10;
  for (int tries = 0; tries < kMostTries; ++tries) {
    const dds_return_t told = dds_write(writers_[kStatePart], &part);
    if (told != DDS_RETCODE_TIMEOUT) return told == DDS_RETCODE_OK;
  }
  return false;
}

void Bus::waitForReaders() const {
  const auto readers = [this](Channel channel) {
    dds_publication_matched_status_t status{};
    dds_get_publication_matched_status(writers_[channel], &status);
    return status.current_count;
  };
  for (int i = 0; i < 100 && readers(kStatePart) < readers(kSession); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

void Bus::flush() {
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(1);
  for (const dds_entity_t writer : writers_) {
    const std::chrono::duration<double> left = until - std::chrono::steady_clock::now();
    dds_wait_for_acks(writer, durationOf(std::max(0.0, left.count())));
  }
}

}  // namespace stadion::cluster
