// What arrives on a connection of the preview page: requests one after the other and, behind one
// for
// `/stream`, messages of a WebSocket. However the bytes are cut, the same must be understood.
#include <algorithm>
#include <string>
#include <string_view>

#include "runtime/watch/gate.hpp"
#include "runtime/watch/http_message.hpp"
#include "runtime/watch/websocket.hpp"
#include "tests/fuzz/require.hpp"
#include "tests/fuzz/targets.hpp"

namespace scenec::fuzz {

namespace {

using runtime::HttpParser;
using runtime::HttpRequest;

const runtime::Gate gate{.port = 7727, .token = "0123456789abcdef0123456789abcdef"};

bool is_lower(std::string_view name) {
  return std::none_of(name.begin(), name.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
}

// One side of the connection: bytes come in, and what they were taken for is written down.
class Listener {
 public:
  void take(std::string_view bytes) {
    if (over_) return;
    in_ += bytes;
    while (!over_ && (is_stream_ ? take_message() : take_request())) {
    }
  }
  [[nodiscard]] const std::string& understood() const { return understood_; }

 private:
  bool take_request() {
    switch (parser_.feed(in_)) {
      case HttpParser::State::incomplete:
        require(in_.size() <= runtime::most_head_bytes + runtime::most_body_bytes,
                "what is kept of a request is limited");
        return false;
      case HttpParser::State::broken:
        understood_ += "refused " + std::to_string(parser_.refusal().status) + "\n";
        require(parser_.refusal().status >= 400, "a refusal is an error");
        over_ = true;
        return false;
      case HttpParser::State::complete:
        break;
    }
    const HttpRequest request = parser_.take();
    check(request);
    understood_ += request.method + " " + request.path + " ? " + request.query + "\n";
    for (const auto& [name, value] : request.headers) understood_ += name + "=" + value + "\n";
    understood_ += request.body + "\n";
    is_stream_ = request.path == "/stream";
    return true;
  }

  static void check(const HttpRequest& request) {
    require(request.path.starts_with('/'), "a path", request.path);
    require(request.path.find('?') == std::string::npos, "a path without its query");
    require(request.body.size() <= runtime::most_body_bytes, "a body of a size that is allowed");
    for (const auto& [name, value] : request.headers) {
      require(!name.empty() && is_lower(name), "a header's name", name);
      require(value.find_first_of("\r\n") == std::string::npos, "a value of one line", value);
    }
    // Whoever is let through has said the token, and asked for this host.
    if (!refusal_of(gate, request, runtime::Access::read)) {
      const auto host = request.header("host");
      require(host && host->ends_with(":7727"), "a host of ours");
      const auto said = request.header("x-scenec-token");
      const auto protocol = request.header("sec-websocket-protocol");
      require((said && *said == gate.token) ||
                  (protocol && protocol->find(gate.token) != std::string_view::npos),
              "the token");
    }
    if (!refusal_of(gate, request, runtime::Access::write))
      require(request.method == "POST", "changes are POSTs");
    static_cast<void>(runtime::websocket_accept_of(
        request.header("sec-websocket-key").value_or(std::string_view{})));
    static_cast<void>(request.parameter("scene"));
  }

  bool take_message() {
    const std::size_t before = in_.size();
    runtime::WebsocketMessage message;
    switch (read_websocket(in_, message)) {
      case runtime::WebsocketRead::incomplete:
        require(in_.size() == before, "what is incomplete stays");
        require(before <= runtime::most_websocket_bytes + 14,
                "what is kept of a message is limited");
        return false;
      case runtime::WebsocketRead::broken:
        understood_ += "broken\n";
        over_ = true;
        return false;
      case runtime::WebsocketRead::complete:
        break;
    }
    require(in_.size() < before, "a message takes bytes");
    require(message.payload.size() <= runtime::most_websocket_bytes, "a small message");
    understood_ += std::to_string(static_cast<int>(message.kind)) + ":" + message.payload + "\n";
    return true;
  }

  HttpParser parser_;
  std::string in_;
  std::string understood_;
  bool is_stream_ = false;
  bool over_ = false;
};

}  // namespace

void fuzz_socket(std::string_view bytes) {
  // A server never takes in more than this at once.
  bytes = bytes.substr(0, runtime::most_head_bytes);
  Listener whole;
  whole.take(bytes);
  for (const std::size_t piece : {1U, 7U, 100U}) {
    if (piece == 1 && bytes.size() > 2000) continue;  // each piece looks through the head again
    Listener listener;
    for (std::size_t at = 0; at < bytes.size(); at += piece) listener.take(bytes.substr(at, piece));
    require(listener.understood() == whole.understood(), "the same from pieces",
            whole.understood());
  }
}

}  // namespace scenec::fuzz
