#include "runtime/watch/state_json.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/render_diagnostic.hpp"
#include "runtime/diagnostic_formats.hpp"
#include "runtime/effect_report.hpp"
#include "runtime/watch/camera_text.hpp"

namespace scenec::runtime {

namespace {

using Json = nlohmann::json;

constexpr std::size_t most_findings = 100;
constexpr std::size_t most_changes = 50;

Json findings_json(const Attempt& attempt) {
  Json list = Json::array();
  for (const Finding& finding : attempt.findings) {
    if (list.size() == most_findings) break;
    const SourceMap& sources = attempt.sources();
    Json one = Json::parse(json_line(finding, sources));
    one["text"] = render_terminal(finding.diagnostic, sources,
                                  {.color = false, .severity = finding.severity});
    list.push_back(std::move(one));
  }
  if (!attempt.problem.empty())
    list.push_back(
        {{"severity", "error"}, {"message", attempt.problem}, {"text", attempt.problem}});
  return list;
}

Json phases_json(const Attempt& attempt) {
  Json list = Json::array();
  for (const RunStats::Phase& phase : attempt.stats.phases)
    list.push_back({{"name", phase.name}, {"ms", phase.seconds * 1000}});
  return list;
}

Json reuse_json(const Reuse& reuse) {
  const auto of = [](const auto& counts) {
    return Json{{"kept", counts.reused}, {"made", counts.made}};
  };
  return {{"assets", of(reuse.assets)},
          {"mesh_trees", of(reuse.mesh_trees)},
          {"item_trees", of(reuse.item_trees)}};
}

Json effects_of(const WatchedScene& scene) {
  const World& world = *scene.shown()->world;
  return Json::parse(effects_json(*world.scene, *scene.settings(), scene.effects(),
                                  world.reading->session.sources()))["effects"];
}

Json curve_json(const WatchedScene& scene) {
  Json list = Json::array();
  for (const CurvePoint& point : scene.curve()) {
    list.push_back({point.seconds, point.samples, point.error.relative.value,
                    point.error.relative.low, point.error.relative.high});
  }
  return list;
}

std::string_view name_of(frontend::ParamInfo::Kind kind) {
  constexpr std::array<std::string_view, 6> names{"number", "integer", "boolean",
                                                  "color",  "string",  "other"};
  return names[static_cast<std::size_t>(kind)];
}

// The unit the author has used, and its size in SI.
void add_unit(Json& json, const frontend::ParamInfo& param) {
  const std::size_t digits = param.text.find_last_of("0123456789.");
  const std::string suffix = digits == std::string::npos ? "" : param.text.substr(digits + 1);
  const auto unit = find_unit(suffix);
  const bool fits = unit && unit->dimension == param.dimension;
  const std::string si = si_unit_of(param.dimension);
  json["unit"] = fits ? std::string(unit->suffix) : find_unit(si) ? si : std::string();
  json["unit_size"] = fits ? unit->multiply / unit->divide : 1.0;
}

Json params_json(const WatchedScene& scene, const Wishes& wishes) {
  Json list = Json::array();
  const Attempt& attempt = *scene.latest();
  // A broken scene may have lost its params; those of the last good one keep their place.
  const bool lost = attempt.failed() && attempt.reading->session.params().empty() && scene.shown();
  const Attempt& of = lost ? *scene.shown() : attempt;
  for (const frontend::ParamInfo& param : of.reading->session.params()) {
    Json one{{"name", param.name},          {"type", param.type},
             {"doc", param.documentation},  {"text", param.text},
             {"kind", name_of(param.kind)}, {"value", param.value},
             {"string", param.string_value}};
    if (param.low) one["low"] = *param.low;
    if (param.high) one["high"] = *param.high;
    const auto wished = wishes.params.find(param.name);
    one["wished"] = wished == wishes.params.end() ? Json() : Json(wished->second);
    add_unit(one, param);
    list.push_back(std::move(one));
  }
  return list;
}

Json camera_json(const WatchedScene& scene) {
  const ir::Scene& written = *scene.shown()->world->scene;
  const ir::CameraId id = scene.settings()->camera;
  const ir::Camera& camera = scene.camera() ? *scene.camera() : written.cameras[id];
  const ir::NameId name = written.camera_names[id].name;
  const std::string block = camera_text(camera, name.valid() ? written.names[name] : std::string());
  return std::visit(
      [&](const auto& kind) {
        const ir::CameraFrame& frame = kind;
        Json json{{"block", block},
                  {"eye", {frame.eye.x, frame.eye.y, frame.eye.z}},
                  {"up", {frame.up.x, frame.up.y, frame.up.z}}};
        if (frame.aim) json["aim"] = {frame.aim->x, frame.aim->y, frame.aim->z};
        if (frame.direction)
          json["direction"] = {frame.direction->x, frame.direction->y, frame.direction->z};
        if constexpr (requires { kind.fov; }) {
          constexpr double half_sensor = 0.012;  // metres, of a height of 24 mm
          json["half_height"] =
              kind.fov ? std::tan(kind.fov->value / 2) : half_sensor / kind.focal->value;
        }
        return json;
      },
      camera.kind);
}

std::string_view status_of(const WatchedScene& scene) {
  if (scene.latest()->failed()) return "broken";
  return scene.finished() ? "finished" : "rendering";
}

Json times_json(const WatchTimes& times) {
  Json json{{"made", times.made}};
  if (times.first_picture) json["first_picture"] = *times.first_picture;
  if (times.finished) json["finished"] = *times.finished;
  return json;
}

}  // namespace

nlohmann::json changes_json(const std::vector<ir::PartChange>& changes) {
  constexpr std::array<std::string_view, 3> whats{"added", "removed", "changed"};
  Json list = Json::array();
  for (const ir::PartChange& change : changes) {
    if (list.size() == most_changes) break;
    list.push_back({{"what", whats[static_cast<std::size_t>(change.what)]},
                    {"family", change.family},
                    {"kind", change.kind},
                    {"name", change.name},
                    {"count", change.count},
                    {"keys", change.keys}});
  }
  return list;
}

std::string list_json(const std::vector<ListedScene>& scenes,
                      const std::vector<std::string>& notices) {
  Json json{{"version", 1}, {"index", Json::array()}, {"notices", notices}};
  for (const ListedScene& one : scenes)
    json["index"].push_back({{"scene", one.number}, {"name", one.name}});
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string state_json(const WatchedScene& scene, const Wishes& wishes,
                       const WatchContext& context) {
  Json json{{"version", 1},
            {"scene", scene.number()},
            {"name", scene.path()},
            {"notices", context.notices},
            {"status", status_of(scene)},
            {"stale", scene.is_stale()},
            {"change", scene.change()},
            {"findings", findings_json(*scene.latest())},
            {"phases", phases_json(*scene.latest())},
            {"times", times_json(scene.times())},
            {"changes", changes_json(scene.changes())},
            {"reuse", reuse_json(scene.latest()->reuse)},
            {"params", params_json(scene, wishes)},
            {"paused", wishes.paused}};
  if (context.broken_off_ms) json["cancel_ms"] = *context.broken_off_ms;
  if (scene.settings()) {
    const ir::RenderSettings& settings = *scene.settings();
    const FrameInfo info = scene.frame_info();
    json["generation"] = info.generation;
    json["size"] = {settings.size.width, settings.size.height};
    json["region"] = {info.region.x0, info.region.y0, info.region.x1, info.region.y1};
    json["exposure"] = settings.exposure;
    json["curve_of"] = settings.film == ir::FilmKind::course   ? "course"
                       : settings.tonemap == ir::Tonemap::srgb ? "srgb"
                                                               : "linear";
    json["samples"] = scene.samples();
    json["sample_cap"] = scene.sample_cap();
    json["curve"] = curve_json(scene);
    json["effects"] = effects_of(scene);
    json["camera"] = camera_json(scene);
    json["moved"] = scene.camera().has_value();
    json["cropped"] = wishes.region.has_value();
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace scenec::runtime
