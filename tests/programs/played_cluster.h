#pragma once
/// Clusters that are played on this machine, and what came of them.

#include "tests/programs/becomes.h"
#include "tests/programs/program.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <thread>

namespace stadion {

using Json = nlohmann::json;

const std::string kKick = STADION_SOURCE_DIR "/scripts/kick.evs";
inline constexpr const char* kFourNodes[] = {"front", "left", "right", "floor"};

/// A cluster file of four machines with a wall each. Tests run side by side: each has a partition of its own.
std::string fourNodes(const TestFolder& folder, const std::string& more = {});

Json summaryOf(const std::filesystem::path& folder);
/// The lines of all nodes' picture-hashes.txt below the folder, or of one run's.
std::set<std::string> hashesBelow(const std::filesystem::path& folder);
/// Returns the content of each picture below the folder, by file name.
std::map<std::string, std::string> picturesIn(const std::filesystem::path& folder);
/// Frame by frame, when that run has shown it [ns].
std::map<std::uint64_t, std::int64_t> swapTimesOf(const std::filesystem::path& folder);

/// The process that plays that node of that cluster; -1: there is none.
pid_t processOf(const std::string& clusterFile, const std::string& node);
/// Sends the signal; false if there is no such process. (To kill(), -1 means every process there is.)
bool signalTo(pid_t process, int signal);
/// Its exit status, or 128 + signal.
int endOf(pid_t child);

}  // namespace stadion
