#include "pipeline/target/session_bus.h"

#include "engine/base/shared_library.h"

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <unistd.h>

namespace stadion {
namespace {

// libdbus's own types and numbers, as its ABI defines them: its headers need not be installed.
struct DBusConnection;
struct DBusMessage;
struct DBusError {
  const char* name = nullptr;
  const char* message = nullptr;
  unsigned flags = 0;
  void* padding = nullptr;
};
constexpr int kSessionBus = 0, kString = 's', kUnsigned = 'u', kEnd = 0;

constexpr int kPatience = 500;  ///< [ms]
constexpr const char* kService = "org.freedesktop.ScreenSaver";
constexpr const char* kPath = "/org/freedesktop/ScreenSaver";

#define STADION_DBUS_FUNCTIONS(X)                                                                            \
  X(bus_get_private, DBusConnection*(int, DBusError*))                                                       \
  X(connection_set_exit_on_disconnect, void(DBusConnection*, std::uint32_t))                                 \
  X(connection_send_with_reply_and_block, DBusMessage*(DBusConnection*, DBusMessage*, int, DBusError*))      \
  X(connection_close, void(DBusConnection*))                                                                 \
  X(connection_unref, void(DBusConnection*))                                                                 \
  X(message_new_method_call, DBusMessage*(const char*, const char*, const char*, const char*))               \
  X(message_set_auto_start, void(DBusMessage*, std::uint32_t))                                               \
  X(message_append_args, std::uint32_t(DBusMessage*, int, ...))                                              \
  X(message_get_args, std::uint32_t(DBusMessage*, DBusError*, int, ...))                                     \
  X(message_unref, void(DBusMessage*))                                                                       \
  X(error_free, void(DBusError*))

struct Dbus {
#define STADION_DBUS_MEMBER(name, type) std::add_pointer_t<type> name = nullptr;
  STADION_DBUS_FUNCTIONS(STADION_DBUS_MEMBER)
#undef STADION_DBUS_MEMBER
};

std::optional<Dbus> loadDbus() {
  const auto library = SharedLibrary::open("libdbus-1.so.3", "libdbus-1-3");
  if (!library) return {};
  Dbus dbus;
  bool whole = true;
#define STADION_DBUS_LOAD(name, type)                                                                        \
  dbus.name = library.value().find<type>("dbus_" #name);                                                     \
  whole = whole && dbus.name;
  STADION_DBUS_FUNCTIONS(STADION_DBUS_LOAD)
#undef STADION_DBUS_LOAD
  return whole ? std::optional(dbus) : std::nullopt;
}

/// Checks that there is a bus: libdbus would otherwise start one.
bool busIsThere() {
  if (const char* address = std::getenv("DBUS_SESSION_BUS_ADDRESS")) return *address != 0;
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  return runtime && access((std::string(runtime) + "/bus").c_str(), F_OK) == 0;
}

}  // namespace

struct SessionInhibition::Bus {
  Dbus dbus;
  DBusConnection* connection = nullptr;
  std::uint32_t cookie = 0;

  ~Bus() {
    if (!connection) return;
    dbus.connection_close(connection);
    dbus.connection_unref(connection);
  }

  bool inhibit() {
    DBusMessage* call = dbus.message_new_method_call(kService, kPath, kService, "Inhibit");
    if (!call) return false;
    const char *program = "Stadion", *why = "a show is being played";
    dbus.message_set_auto_start(call, 0);
    DBusError error;
    DBusMessage* answer = nullptr;
    if (dbus.message_append_args(call, kString, &program, kString, &why, kEnd))
      answer = dbus.connection_send_with_reply_and_block(connection, call, kPatience, &error);
    dbus.message_unref(call);
    const bool granted = answer && dbus.message_get_args(answer, &error, kUnsigned, &cookie, kEnd);
    if (answer) dbus.message_unref(answer);
    dbus.error_free(&error);
    return granted;
  }
};

// The end of the connection ends the inhibition: no further call is needed.
SessionInhibition::SessionInhibition() {
  if (!busIsThere()) return;
  const auto dbus = loadDbus();
  if (!dbus) return;
  auto bus = std::make_unique<Bus>();
  bus->dbus = *dbus;
  DBusError error;
  bus->connection = dbus->bus_get_private(kSessionBus, &error);
  dbus->error_free(&error);
  if (!bus->connection) return;
  dbus->connection_set_exit_on_disconnect(bus->connection, 0);
  if (bus->inhibit()) bus_ = std::move(bus);
}

SessionInhibition::~SessionInhibition() = default;

}  // namespace stadion
