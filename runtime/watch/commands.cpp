#include "runtime/watch/commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "backend/probe.hpp"
#include "base/text.hpp"
#include "runtime/watch/source_change.hpp"

namespace scenec::runtime {

namespace {

using Json = nlohmann::json;

constexpr double largest_coordinate = 1e12;
constexpr std::size_t longest_value = 4096;

// A mistake in a body; turned into an answer where the body came in.
struct BadRequest {
  std::string text;
};

Json parsed_body(const std::string& body) {
  Json json = Json::parse(body, nullptr, false);
  if (!json.is_object()) throw BadRequest{"the body is no JSON object"};
  return json;
}

std::size_t scene_in(const Json& json, const RenderLoop& loop) {
  const auto found = json.find("scene");
  if (found == json.end() || !found->is_number_unsigned() ||
      found->get<std::uint64_t>() >= loop.scene_count()) {
    throw BadRequest{"`scene` is no number of a scene"};
  }
  return found->get<std::size_t>();
}

ir::Vec3 vector_in(const Json& json, const char* key) {
  const auto found = json.find(key);
  const auto is_coordinate = [](const Json& number) {
    return number.is_number() && std::fabs(number.get<double>()) <= largest_coordinate;
  };
  if (found == json.end() || !found->is_array() || found->size() != 3 ||
      !std::all_of(found->begin(), found->end(), is_coordinate)) {
    throw BadRequest{fmt::format("`{}` is no list of three numbers", key)};
  }
  return {(*found)[0], (*found)[1], (*found)[2]};
}

RenderLoop::Need take_param(Wishes& wishes, const Json& param) {
  if (!param.is_object() || !param.contains("name") || !param["name"].is_string() ||
      !param.contains("value")) {
    throw BadRequest{"`param` needs a name and a value"};
  }
  const auto name = param["name"].get<std::string>();
  const Json& value = param["value"];
  if (value.is_null())
    return wishes.params.erase(name) > 0 ? RenderLoop::Need::attempt : RenderLoop::Need::nothing;
  if (!value.is_string() || value.get_ref<const std::string&>().size() > longest_value)
    throw BadRequest{"the value of a param is its text"};
  std::string& place = wishes.params[name];
  if (place == value.get_ref<const std::string&>()) return RenderLoop::Need::nothing;
  place = value.get<std::string>();
  return RenderLoop::Need::attempt;
}

RenderLoop::Need take_camera(Wishes& wishes, const Json& json, const Shown& shown) {
  ++wishes.camera_version;
  if (json.is_null()) {
    wishes.camera.reset();
    return RenderLoop::Need::picture;
  }
  if (!shown.attempt || !shown.settings) throw BadRequest{"there is no camera yet"};
  const ir::Vec3 eye = vector_in(json, "eye");
  const ir::Vec3 aim = vector_in(json, "aim");
  const ir::Vec3 up = vector_in(json, "up");
  if (eye == aim || (up.x == 0 && up.y == 0 && up.z == 0))
    throw BadRequest{"the camera looks nowhere"};
  ir::Camera camera = shown.attempt->world->scene->cameras[shown.settings->camera];
  std::visit(
      [&](ir::CameraFrame& frame) {
        frame.eye = {eye.x, eye.y, eye.z};
        frame.aim = ir::Point3{aim.x, aim.y, aim.z};
        frame.direction.reset();
        frame.up = {up.x, up.y, up.z};
      },
      camera.kind);
  wishes.camera = camera;
  return RenderLoop::Need::picture;
}

RenderLoop::Need take_region(Wishes& wishes, const Json& json) {
  if (json.is_null()) {
    wishes.region.reset();
    return RenderLoop::Need::picture;
  }
  const auto is_place = [](const Json& n) {
    return n.is_number_unsigned() && n.get<std::uint64_t>() <= 65535;
  };
  if (!json.is_array() || json.size() != 4 || !std::all_of(json.begin(), json.end(), is_place))
    throw BadRequest{"`region` is no list of four places"};
  const ir::Region region{json[0], json[1], json[2], json[3]};
  if (region.x0 >= region.x1 || region.y0 >= region.y1)
    throw BadRequest{"the region holds no pixel"};
  wishes.region = region;
  return RenderLoop::Need::picture;
}

std::string place_text(const SourceMap& sources, Span span) {
  const Span written = sources.resolve(span);
  if (!written.valid()) return {};
  const Position position = sources.position(written.file, written.begin);
  return fmt::format("{}:{}:{}", sources.path(written.file), position.line, position.column);
}

std::string line_text(const SourceMap& sources, Span span) {
  const Span written = sources.resolve(span);
  if (!written.valid()) return {};
  return printable(sources.line(written.file, sources.position(written.file, written.begin).line),
                   200);
}

// The item that was hit, as the author knows it, and the calls that led there.
void add_items(Json& json, const backend::ProbeResult& result, const Attempt& attempt) {
  const ir::Scene& scene = attempt.scene();
  const SourceMap& sources = attempt.sources();
  json["places"] = Json::array();
  for (auto step = result.path.rbegin(); step != result.path.rend(); ++step) {
    const std::vector<ir::Item>& items =
        step->proto ? scene.protos[*step->proto].items : scene.items;
    if (step->item >= items.size()) continue;
    const ir::Item& item = items[step->item];
    if (!json.contains("name"))
      json["name"] = item.name.valid() ? scene.names[item.name] : std::string();
    for (ir::OriginId at = item.origin; at.valid(); at = scene.origins[at].parent) {
      const Span span = scene.origins[at].span;
      json["places"].push_back(
          {{"place", place_text(sources, span)}, {"line", line_text(sources, span)}});
    }
  }
  if (result.material.valid() && result.material.value() < scene.material_names.size()) {
    const ir::Declared& material = scene.material_names[result.material];
    if (material.name.valid()) json["material"] = scene.names[material.name];
  }
}

template <class F>
HttpResponse answered(F&& f) {
  try {
    return f();
  } catch (const BadRequest& problem) {
    return text_response(422, problem.text + "\n");
  } catch (const Json::exception&) {
    return text_response(422, "the body has a value of another type\n");
  }
}

std::string text_in(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_string())
    throw BadRequest{fmt::format("`{}` is no text", key)};
  return found->get<std::string>();
}

}  // namespace

HttpResponse take_wish(RenderLoop& loop, const std::string& body) {
  return answered([&] {
    const Json json = parsed_body(body);
    const std::size_t scene = scene_in(json, loop);
    const Shown shown = loop.shown(scene);
    loop.wish(scene, [&](Wishes& wishes) {
      if (json.contains("param")) return take_param(wishes, json["param"]);
      if (json.contains("params")) {
        const bool any = !wishes.params.empty();
        wishes.params.clear();
        return any ? RenderLoop::Need::attempt : RenderLoop::Need::nothing;
      }
      if (json.contains("camera")) return take_camera(wishes, json["camera"], shown);
      if (json.contains("region")) return take_region(wishes, json["region"]);
      if (json.contains("paused")) {
        wishes.paused = json["paused"].get<bool>();
        return RenderLoop::Need::picture;
      }
      throw BadRequest{"there is nothing that is wished for"};
    });
    return json_response(200, "{}");
  });
}

HttpResponse probe_pixel(const RenderLoop& loop, const std::string& body) {
  return answered([&] {
    const Json json = parsed_body(body);
    const Shown shown = loop.shown(scene_in(json, loop));
    if (!shown.attempt || !shown.settings || !shown.picture || !shown.world)
      throw BadRequest{"there is no picture yet"};
    const auto x = json.value("x", std::int64_t{-1});
    const auto y = json.value("y", std::int64_t{-1});
    const ir::ImageSize size = shown.settings->size;
    if (x < 0 || y < 0 || x >= size.width || y >= size.height)
      throw BadRequest{"the place lies outside of the picture"};
    Json answer{{"x", x}, {"y", y}};
    const ir::Region region = shown.frame.region;
    const std::int64_t column = (x - region.x0) / shown.frame.step;
    const std::int64_t row = (y - region.y0) / shown.frame.step;
    if (x >= region.x0 && y >= region.y0 && column < shown.picture->width &&
        row < shown.picture->height) {
      const float* const rgb =
          shown.picture->rgb.data() + 3 * (row * shown.picture->width + column);
      answer["value"] = {rgb[0], rgb[1], rgb[2]};
      answer["samples"] = shown.picture->samples;
    }
    const auto hit = backend::probe(*shown.world->built, *shown.settings, x, y,
                                    shown.camera ? &*shown.camera : nullptr);
    if (hit) {
      answer["distance"] = hit->distance;
      answer["point"] = {hit->point.x, hit->point.y, hit->point.z};
      answer["normal"] = {hit->normal.x, hit->normal.y, hit->normal.z};
      if (shown.attempt->world == shown.world) add_items(answer, *hit, *shown.attempt);
    }
    return json_response(200, answer.dump(-1, ' ', false, Json::error_handler_t::replace));
  });
}

HttpResponse write_back(const RenderLoop& loop, const std::string& body) {
  return answered([&] {
    const Json json = parsed_body(body);
    const Shown shown = loop.shown(scene_in(json, loop));
    if (!shown.latest) throw BadRequest{"there is no scene yet"};
    const std::string name = text_in(json, "name");
    const auto change = change_of_param(*shown.latest, name, text_in(json, "value"));
    if (!change) throw BadRequest{change.error()};
    const SourceChange& made = change.value();
    if (json.value("apply", false)) {
      if (const auto problem = apply_change(made, text_in(json, "hash")))
        return text_response(409, *problem + "\n");
    }
    return json_response(200, Json{{"diff", made.diff}, {"hash", made.before.hex()}}.dump(
                                  -1, ' ', false, Json::error_handler_t::replace));
  });
}

}  // namespace scenec::runtime
