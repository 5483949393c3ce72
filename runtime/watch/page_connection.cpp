#include "runtime/watch/page_connection.hpp"

#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "runtime/watch/gate.hpp"

namespace scenec::runtime {

namespace {

// More than a request is never taken in at once; the rest waits in the system's buffer.
constexpr std::size_t most_unread = most_head_bytes + most_body_bytes;

}  // namespace

bool PageConnection::read_available() {
  std::array<char, 16384> buffer;
  while (in_.size() < most_unread) {
    const ssize_t size = ::recv(socket_.number(), buffer.data(), buffer.size(), 0);
    if (size > 0) {
      if (in_.empty()) since_ = Clock::now();
      in_.append(buffer.data(), static_cast<std::size_t>(size));
      last_taken_ = Clock::now();
      continue;
    }
    if (size < 0 && errno == EINTR) continue;
    return size < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
  }
  return true;
}

bool PageConnection::write_available(Clock::time_point now) {
  while (!out_.empty()) {
    const std::string& bytes = *out_.front();
    const ssize_t size = ::send(socket_.number(), bytes.data() + out_offset_,
                                bytes.size() - out_offset_, MSG_NOSIGNAL);
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) return errno == EAGAIN || errno == EWOULDBLOCK;
    last_taken_ = now;
    out_offset_ += static_cast<std::size_t>(size);
    if (out_offset_ < bytes.size()) continue;
    out_offset_ = 0;
    out_.pop_front();
  }
  return !closing_;
}

std::optional<HttpRequest> PageConnection::next_request(Clock::time_point now) {
  if (answering_ || closing_ || is_stream_) return std::nullopt;
  switch (parser_.feed(in_)) {
    case HttpParser::State::incomplete:
      return std::nullopt;
    case HttpParser::State::broken:
      after_ = AfterResponse::close;
      in_.clear();
      answer(parser_.refusal(), now);
      return std::nullopt;
    case HttpParser::State::complete:
      break;
  }
  HttpRequest request = parser_.take();
  const bool close = request.header("connection").value_or("") == "close";
  after_ = close ? AfterResponse::close : AfterResponse::keep_open;
  return request;
}

void PageConnection::answer(const HttpResponse& response, Clock::time_point now) {
  answering_.reset();
  since_ = now;
  put(head_of(response, after_));
  put(response.body);
  closing_ = after_ == AfterResponse::close;
}

void PageConnection::become_stream(const HttpRequest& request, std::optional<std::size_t> scene) {
  HttpResponse response{.status = 101};
  response.headers = {
      {"Upgrade", "websocket"},
      {"Connection", "Upgrade"},
      {"Sec-WebSocket-Accept",
       websocket_accept_of(request.header("sec-websocket-key").value_or(""))},
      {"Sec-WebSocket-Protocol", std::string(websocket_protocol)},
  };
  put(head_of(response, AfterResponse::keep_open));
  is_stream_ = true;
  scene_ = scene;
  last_ping_ = Clock::now();
  // A small buffer in the system: what waits there is older than what could be sent instead.
  const int size = 256 * 1024;
  ::setsockopt(socket_.number(), SOL_SOCKET, SO_SNDBUF, &size, sizeof size);
}

bool PageConnection::read_messages() {
  while (true) {
    WebsocketMessage message;
    switch (read_websocket(in_, message)) {
      case WebsocketRead::incomplete:
        return true;
      case WebsocketRead::broken:
        return false;
      case WebsocketRead::complete:
        break;
    }
    if (message.kind == WebsocketKind::close) return false;
    if (message.kind == WebsocketKind::ping && out_.size() < 4)
      put_message(WebsocketKind::pong,
                  std::make_shared<const std::string>(std::move(message.payload)));
    if (message.kind == WebsocketKind::text) showing_ = false;  // the picture is on the screen
  }
}

void PageConnection::put_message(WebsocketKind kind, const Board::Bytes& bytes) {
  put(websocket_head(kind, bytes->size()));
  put(bytes);
}

void PageConnection::send_news(const Board& board) {
  if (!is_stream_ || !out_.empty()) return;
  const Board::List list = board.list();
  if (list.version > list_sent_) {
    list_sent_ = list.version;
    put_message(WebsocketKind::text, list.bytes);
  }
  states_sent_.resize(board.size(), 0);
  if (scene_) {
    send_scene(board, *scene_, true);
  } else {
    // A page that lists scenes shows none of them at work.
    for (std::size_t i = 0; i < states_sent_.size(); ++i) send_scene(board, i, !list.bytes);
  }
}

void PageConnection::send_scene(const Board& board, std::size_t scene, bool pictures) {
  const Board::Slot slot = board.slot(scene);
  if (slot.state && slot.state_version > states_sent_[scene]) {
    states_sent_[scene] = slot.state_version;
    put_message(WebsocketKind::text, slot.state);
  }
  if (pictures && !showing_ && slot.frame && slot.frame_version > frame_sent_) {
    frame_sent_ = slot.frame_version;
    showing_ = true;
    put_message(WebsocketKind::binary, slot.frame);
  }
}

void PageConnection::ping() {
  last_ping_ = Clock::now();
  if (out_.empty()) put_message(WebsocketKind::ping, std::make_shared<const std::string>("scenec"));
}

}  // namespace scenec::runtime
