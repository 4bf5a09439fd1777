#pragma once
/// The network between the machines of a cluster: Eclipse Cyclone DDS, with the topics of wire.idl.
///
/// Everything is delivered, in order, to everybody who is there; Session and Presence also to who comes
/// later. What a machine says does not come back to it.
///
/// Ownership  owns the participant; the listener must outlive it.
/// Threads    tell() from any. The listener is called on threads of the network's own, several at a time for
///            several topics; it may tell() something, and should return soon.
/// Errors     open() says why there is no network. What cannot be delivered for a second, because somebody no
///            longer listens, is left to who watches whether they are there.

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

/// What a node is at (Presence).
enum class Phase : std::uint8_t {
  Waiting,  ///< for a session, or opening the show
  Asking,   ///< the show is under way: it needs the scene's state
  Ready,    ///< it has obeyed all orders that it knows of
  Leaving,  ///< it plays no longer
};

/// In place of a node's number (Session::giver).
constexpr std::uint8_t kNobody = 255;

class BusListener {
public:
  virtual ~BusListener() = default;
  virtual void hear(const Session&) {}
  virtual void hear(const Presence&) {}
  virtual void hear(const Order&) {}
  virtual void hear(const Drawn&) {}
  virtual void hear(const Go&) {}
  virtual void hear(const SceneHash&) {}
  virtual void hear(const Difference&) {}
  virtual void hear(const StatePart&) {}
  /// Nobody has heard of that incarnation of the node for the deadline, or it said good-bye.
  virtual void left(std::uint8_t node, std::uint64_t incarnation) { (void)node, (void)incarnation; }
};

class Bus {
public:
  /// Interface, domain, partition and deadline of the file count.
  static Result<std::unique_ptr<Bus>> open(const ClusterFile& cluster, BusListener& listener);
  /// One that reaches nobody.
  static std::unique_ptr<Bus> none() { return std::unique_ptr<Bus>(new Bus); }
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  void tell(const Session& session);
  void tell(const Presence& presence);
  void tell(const Order& order);
  void tell(const Drawn& drawn);
  void tell(const Go& go);
  void tell(const SceneHash& hash);
  void tell(const Difference& difference);
  /// May take long. False: it cannot be delivered.
  bool tell(const StatePart& part);
  /// Waits until everybody has heard everything, a second at most.
  void flush();
  /// Waits until whoever hears anything of ours hears all of it, a second at most: who has just come is known
  /// channel by channel, the scene's parts last.
  void waitForReaders() const;
  /// Waits for whoever is in the listener just now; then it is called no more, and nobody hears anything.
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
  /// Who writes presences, and as whom: of two that are the same node one may die. By handles of the network.
  struct Speaker {
    std::uint8_t node = 0;
    std::uint64_t incarnation = 0;
  };
  std::mutex speakersMutex_;
  std::map<dds_instance_handle_t, Speaker> speakers_;
};

}  // namespace stadion::cluster
