#pragma once
/// The network between the hosts of a cluster: Eclipse Cyclone DDS, with the topics of wire.idl.
///
/// Every sample is delivered in order to every host that is connected. Session and Presence also reach hosts
/// that connect later. A host does not receive its own samples.
///
/// Ownership  owns the participant; the listener must outlive it.
/// Threads    send() from any. The network's own threads call the listener, several at a time for several
///            topics. The listener may call send(), and should return soon.
/// Errors     open() says why there is no network. A sample that cannot be delivered for a second is dropped,
///            since its reader has stopped. The caller watches which hosts are present.

#include "engine/base/diagnostic.h"
#include "pipeline/cluster/cluster_file.h"

#include <array>
#include <cstdint>
#include <dds/dds.h>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <wire.h>  // made from wire.idl

namespace stadion::cluster {

using Session = stadion_wire_Session;
using Presence = stadion_wire_Presence;
using Order = stadion_wire_Order;
using Drawn = stadion_wire_Drawn;
using Go = stadion_wire_Go;
using SceneHash = stadion_wire_SceneHash;
using Difference = stadion_wire_Difference;
using StatePart = stadion_wire_StatePart;

/// A host's phase, as its Presence reports it.
enum class Phase : std::uint8_t {
  Waiting,  ///< for a session, or opening the show
  Asking,   ///< the show is under way, and the host needs the scene's state
  Ready,    ///< the host has applied all orders that it knows of
  Leaving,  ///< the host plays no longer
};

/// No host; stands in place of a host's number (Session::giver).
constexpr std::uint8_t kNoNode = 255;

class BusListener {
public:
  virtual ~BusListener() = default;
  virtual void receive(const Session&) {}
  virtual void receive(const Presence&) {}
  virtual void receive(const Order&) {}
  virtual void receive(const Drawn&) {}
  virtual void receive(const Go&) {}
  virtual void receive(const SceneHash&) {}
  virtual void receive(const Difference&) {}
  virtual void receive(const StatePart&) {}
  /// The host's incarnation was silent for the deadline, or it said good-bye.
  virtual void left(std::uint8_t node, std::uint64_t incarnation) {
    (void)node;
    (void)incarnation;
  }
};

class Bus {
public:
  /// Uses the file's interface, domain, partition and deadline.
  static Result<std::unique_ptr<Bus>> open(const ClusterFile& cluster, BusListener& listener);
  /// Returns a bus without a network: nothing is sent or received.
  static std::unique_ptr<Bus> none() { return std::unique_ptr<Bus>(new Bus); }
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  void send(const Session& session);
  void send(const Presence& presence);
  void send(const Order& order);
  void send(const Drawn& drawn);
  void send(const Go& go);
  void send(const SceneHash& hash);
  void send(const Difference& difference);
  /// May take long. Returns false if the part cannot be delivered.
  bool send(const StatePart& part);
  /// Waits until every reader has received everything; a second at most.
  void flush();
  /// Waits until each connected host reads all our topics; a second at most. A new host is discovered topic
  /// by topic, and the scene's parts come last.
  void waitForReaders() const;
  /// Waits for listener calls that are running now. Afterwards the listener is called no more, and other
  /// hosts receive nothing.
  void close();

private:
  enum Channel : std::size_t {
    kSession,
    kPresence,
    kOrder,
    kDrawn,
    kGo,
    kSceneHash,
    kDifference,
    kStatePart,
    kChannels
  };

  Bus() = default;
  template <class T>
  bool add(Channel channel, const dds_topic_descriptor_t& type, const std::string& name,
           dds_listener_t* heard, dds_qos_t* qos);
  template <class T>
  static void take(dds_entity_t reader, void* bus);
  static void takeLiveliness(dds_entity_t reader, dds_liveliness_changed_status_t status, void* bus);

  BusListener* listener_ = nullptr;
  dds_entity_t domain_ = 0, participant_ = 0;
  std::array<dds_entity_t, kChannels> writers_{};
  /// The writer of a presence and the host that it writes for. Two programs may be the same host, and one of
  /// them may crash. Keyed by the network's handles.
  struct Speaker {
    std::uint8_t node = 0;
    std::uint64_t incarnation = 0;
  };
  std::mutex speakersMutex_;
  std::map<dds_instance_handle_t, Speaker> speakers_;
};

}  // namespace stadion::cluster
