// What the preview page can ask for: its own files, pictures as files, and the author's wishes.
// There is a fixed table of routes; no path from a request ever reaches the disk.
#pragma once

#include <functional>

#include "runtime/watch/gate.hpp"
#include "runtime/watch/job_queue.hpp"
#include "runtime/watch/preview_server.hpp"
#include "runtime/watch/render_loop.hpp"

namespace scenec::runtime {

class PreviewApi {
 public:
  using Reply = std::function<void(PreviewServer::RequestId, HttpResponse)>;
  PreviewApi(Gate gate, RenderLoop& loop, JobQueue& jobs, Reply reply)
      : gate_(std::move(gate)), loop_(loop), jobs_(jobs), reply_(std::move(reply)) {}

  // On the server's thread; slow work goes to the queue.
  void handle(PreviewServer::RequestId id, HttpRequest request);

 private:
  struct Route;
  [[nodiscard]] static std::span<const Route> routes();
  [[nodiscard]] std::optional<std::size_t> scene_of(const HttpRequest& request) const;

  void send_picture(PreviewServer::RequestId id, const HttpRequest& request);
  void alive(PreviewServer::RequestId id, const HttpRequest& request);
  void wish(PreviewServer::RequestId id, const HttpRequest& request);
  void probe(PreviewServer::RequestId id, const HttpRequest& request);
  void source(PreviewServer::RequestId id, const HttpRequest& request);

  Gate gate_;
  RenderLoop& loop_;
  JobQueue& jobs_;
  Reply reply_;
};

}  // namespace scenec::runtime
