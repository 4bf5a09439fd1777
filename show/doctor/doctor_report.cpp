#include "show/doctor/doctor.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace stadion {

std::string toText(std::span<const DoctorFinding> findings) {
  std::string text;
  for (const DoctorFinding& f : findings) {
    text += fmt::format("{:<8} {:<12} {}\n", nameOf(f.health), f.topic, f.found);
    if (!f.lacks.empty()) text += fmt::format("{:21} so: {}\n", "", f.lacks);
    if (!f.mend.empty()) text += fmt::format("{:21} do: {}\n", "", f.mend);
  }
  for (const DoctorFinding& f : findings)
    if (f.asked && f.health != Health::Works)
      text += fmt::format("asked for, and cannot work: {} ({})\n", f.topic, f.found);
  return text;
}

std::string toJson(std::span<const DoctorFinding> findings) {
  nlohmann::ordered_json j{{"can_work", canWork(findings)}};
  j["findings"] = nlohmann::ordered_json::array();
  for (const DoctorFinding& f : findings)
    j["findings"].push_back({{"topic", f.topic},
                             {"health", nameOf(f.health)},
                             {"asked", f.asked},
                             {"found", f.found},
                             {"lacks", f.lacks},
                             {"mend", f.mend}});
  return j.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace stadion
