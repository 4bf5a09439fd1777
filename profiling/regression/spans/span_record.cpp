#include "profiling/regression/spans/span_record.h"

#include <nlohmann/json.hpp>

namespace stadion::regression {
namespace {

using Json = nlohmann::ordered_json;

std::string text(const Json& row, const char* field) {
  return row.contains(field) && row[field].is_string() ? row[field].get<std::string>() : "";
}

double number(const Json& row, const char* field) {
  return row.contains(field) && row[field].is_number() ? row[field].get<double>() : 0;
}

std::map<std::uint64_t, double> microsecondsByFrame(const Json& row, const char* field) {
  std::map<std::uint64_t, double> values;
  if (!row.contains(field) || !row[field].is_object()) return values;
  for (const auto& [frame, us] : row[field].items())
    if (us.is_number()) values[std::strtoull(frame.c_str(), nullptr, 10)] = us.get<double>();
  return values;
}

SpanRow rowOf(const Json& j) {
  SpanRow row;
  row.path = text(j, "path");
  row.file = text(j, "file");
  row.stage = text(j, "stage");
  row.wall = text(j, "wall");
  row.eye = text(j, "eye");
  row.line = static_cast<std::uint32_t>(number(j, "line"));
  row.msMean = number(j, "ms_mean");
  row.count = static_cast<std::size_t>(number(j, "count"));
  row.instructions = number(j, "instructions");
  row.plantedUs = number(j, "planted_us");
  row.elapsedUs = number(j, "elapsed_us");
  row.frames = microsecondsByFrame(j, "frame_us");
  row.elapsed = microsecondsByFrame(j, "frame_elapsed_us");
  return row;
}

Json orNull(const std::string& value) {
  return value.empty() ? Json() : Json(value);
}

}  // namespace

std::string SpanRow::node() const {
  return path.empty() ? file.substr(file.rfind('/') + 1) + ":" + std::to_string(line) : path;
}

std::string SpanRow::name() const {
  const std::string in = stageName() + (eye.empty() ? "" : ", " + eye + " eye");
  if (isStage()) return in;
  const std::string where = line > 0 ? file + ":" + std::to_string(line) : file;
  if (path.empty()) return where + " in " + in;
  return path + (where.empty() ? "" : " (" + where + ")") + " in " + in;
}

std::vector<SpanRow> spanRows(const std::string& json) {
  const Json j = Json::parse(json, nullptr, false);
  const Json* rows = &j;
  for (const char* field : {"rows", "nodes"})
    if (j.is_object() && j.contains(field)) rows = &j[field];
  std::vector<SpanRow> all;
  if (rows->is_array())
    for (const Json& row : *rows)
      if (row.is_object()) all.push_back(rowOf(row));
  return all;
}

std::vector<SpanRow> stagesOfSummary(const std::string& summaryJson) try {
  const Json j = Json::parse(summaryJson);
  std::vector<SpanRow> all;
  for (const Json& s : j.at("stages")) {
    SpanRow row;
    row.stage = text(s, "stage");
    row.wall = text(s, "wall");
    row.msMean = number(s.at("ms"), "p50");
    row.count = static_cast<std::size_t>(number(s.at("ms"), "count"));
    all.push_back(std::move(row));
  }
  return all;
} catch (const Json::exception&) {
  return {};
}

std::vector<SpanRow> profileRows(const std::string& profileJson) {
  const Json j = Json::parse(profileJson, nullptr, false);
  std::vector<SpanRow> all;
  const auto add = [&](SpanRow row, const char* stage, const std::string& wall, const char* eye, double ms) {
    row.stage = stage;
    row.wall = wall;
    row.eye = eye;
    row.msMean = ms;
    all.push_back(std::move(row));
  };
  const auto list = [](const Json& of, const char* field) {
    return of.is_object() && of.contains(field) && of[field].is_array() ? of[field] : Json::array();
  };
  const Json nodes = list(j, "nodes"), stages = list(j, "stages");
  for (const Json& node : nodes) {
    SpanRow row;
    row.path = text(node, "path");
    row.file = text(node, "file");
    row.line = static_cast<std::uint32_t>(number(node, "line"));
    add(row, "app", "", "", number(node, "app_ms"));
    const Json walls = list(node, "walls");
    for (const Json& wall : walls) {
      add(row, "cull", text(wall, "wall"), "", number(wall, "cull_ms"));
      add(row, "draw", text(wall, "wall"), "left", number(wall, "draw_left_ms"));
      add(row, "draw", text(wall, "wall"), "right", number(wall, "draw_right_ms"));
    }
  }
  for (const Json& stage : stages) {
    const std::string name = text(stage, "stage");
    if (!text(stage, "part").empty()) continue;
    const std::size_t blank = name.find(' ');
    add({}, blank == name.npos ? name.c_str() : name.substr(0, blank).c_str(),
        blank == name.npos ? "" : name.substr(blank + 1), "", number(stage, "ms"));
  }
  return all;
}

void giveInstructions(std::vector<SpanRow>& rows, const std::map<std::string, double>& byLabel) {
  std::size_t frames = 1;
  for (const SpanRow& r : rows)
    if (r.isStage() && r.stage == "app")
      frames = std::max<std::size_t>(3, r.count) - 2;  // the first two are left out
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (const auto at = byLabel.find("row " + std::to_string(i)); at != byLabel.end())
      rows[i].instructions = at->second / static_cast<double>(frames);
  for (SpanRow& stage : rows)
    if (stage.isStage())
      for (const SpanRow& r : rows)
        if (!r.isStage() && r.stage == stage.stage && r.wall == stage.wall)
          stage.instructions += r.instructions;
}

std::string toJson(const std::vector<SpanRow>& rows) {
  Json all = Json::array();
  for (const SpanRow& r : rows) {
    Json j{{"path", r.isStage() ? Json() : Json(r.path)},
           {"file", orNull(r.file)},
           {"line", r.line > 0 ? Json(r.line) : Json()},
           {"stage", r.stage},
           {"wall", orNull(r.wall)},
           {"eye", orNull(r.eye)},
           {"ms_mean", r.msMean},
           {"count", r.count}};
    if (r.instructions > 0) j["instructions"] = r.instructions;
    if (r.elapsedUs > 0) j["elapsed_us"] = r.elapsedUs;
    if (r.plantedUs > 0) j["planted_us"] = r.plantedUs;
    for (const auto& [frame, us] : r.frames) j["frame_us"][std::to_string(frame)] = us;
    for (const auto& [frame, us] : r.elapsed) j["frame_elapsed_us"][std::to_string(frame)] = us;
    all.push_back(std::move(j));
  }
  return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace stadion::regression
