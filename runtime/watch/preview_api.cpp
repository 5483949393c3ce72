#include "runtime/watch/preview_api.hpp"

#include <array>

#include "base/text.hpp"
#include "runtime/watch/commands.hpp"
#include "runtime/watch/pages.hpp"

namespace scenec::runtime {

struct PreviewApi::Route {
  std::string_view method;
  std::string_view path;
  Access access;
  void (PreviewApi::*answer)(PreviewServer::RequestId, const HttpRequest&);
};

std::span<const PreviewApi::Route> PreviewApi::routes() {
  static constexpr std::array table{
      Route{"GET", "/alive", Access::read, &PreviewApi::alive},
      Route{"POST", "/wish", Access::write, &PreviewApi::wish},
      Route{"POST", "/probe", Access::write, &PreviewApi::probe},
      Route{"POST", "/source", Access::write, &PreviewApi::source},
      Route{"GET", "/picture.png", Access::read, &PreviewApi::send_picture},
      Route{"GET", "/picture.exr", Access::read, &PreviewApi::send_picture},
  };
  return table;
}

void PreviewApi::handle(PreviewServer::RequestId id, HttpRequest request) {
  for (const Route& route : routes()) {
    if (route.path != request.path) continue;
    if (auto refusal = refusal_of(gate_, request, route.access)) return reply_(id, *refusal);
    if (route.method != request.method) return reply_(id, text_response(405, "not this way\n"));
    return (this->*route.answer)(id, request);
  }
  // Nothing is told to strangers, not even which paths there are.
  if (auto refusal = refusal_of(gate_, request, Access::page)) return reply_(id, *refusal);
  const bool is_page = request.path == "/" || request.path.starts_with("/scene/");
  for (const PageFile& file : page_files()) {
    if (file.path != (is_page ? "/" : request.path)) continue;
    if (request.method != "GET") return reply_(id, text_response(405, "not this way\n"));
    HttpResponse response = text_response(200, std::string(file.bytes));
    response.type = file.type;
    return reply_(id, std::move(response));
  }
  reply_(id, text_response(404, "there is no such page\n"));
}

std::optional<std::size_t> PreviewApi::scene_of(const HttpRequest& request) const {
  const auto number = parse_int(request.parameter("scene").value_or("0"));
  if (!number || *number < 0) return std::nullopt;
  const auto scene = static_cast<std::size_t>(*number);
  return scene < loop_.scene_count() ? std::optional(scene) : std::nullopt;
}

void PreviewApi::alive(PreviewServer::RequestId id, const HttpRequest&) {
  reply_(id, json_response(200, "{}"));
}

void PreviewApi::wish(PreviewServer::RequestId id, const HttpRequest& request) {
  reply_(id, take_wish(loop_, request.body));
}

void PreviewApi::probe(PreviewServer::RequestId id, const HttpRequest& request) {
  reply_(id, probe_pixel(loop_, request.body));
}

void PreviewApi::source(PreviewServer::RequestId id, const HttpRequest& request) {
  jobs_.put([this, id, body = request.body] { reply_(id, write_back(loop_, body)); });
}

void PreviewApi::send_picture(PreviewServer::RequestId id, const HttpRequest& request) {
  const auto scene = scene_of(request);
  if (!scene) return reply_(id, text_response(404, "there is no such scene\n"));
  const bool is_png = request.path == "/picture.png";
  jobs_.put([this, id, is_png, shown = loop_.shown(*scene)] {
    if (!shown.picture) return reply_(id, text_response(404, "there is no picture yet\n"));
    HttpResponse response = text_response(
        200, backend::encode(*shown.picture, *shown.settings,
                             is_png ? backend::ImageFormat::png : backend::ImageFormat::exr, {}));
    response.type = is_png ? "image/png" : "image/x-exr";
    reply_(id, std::move(response));
  });
}

}  // namespace scenec::runtime
