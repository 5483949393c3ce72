// WebSocket (RFC 6455) as far as a stream of pictures needs it: whole messages out, small messages
// in. A browser opens at most six HTTP connections to a server, so streams over HTTP would starve
// the seventh page; WebSockets are counted apart.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace scenec::runtime {

// SHA-1 (FIPS 180-4): the handshake asks for it. Not for secrets.
[[nodiscard]] std::array<std::uint8_t, 20> sha1_of(std::string_view bytes);
// What the server answers to `Sec-WebSocket-Key`.
[[nodiscard]] std::string websocket_accept_of(std::string_view key);

enum class WebsocketKind : std::uint8_t {
  text = 1,
  binary = 2,
  close = 8,
  ping = 9,
  pong = 10,
};
// The bytes before the payload of an unmasked, unfragmented message.
[[nodiscard]] std::string websocket_head(WebsocketKind kind, std::size_t size);

struct WebsocketMessage {
  WebsocketKind kind = WebsocketKind::text;
  std::string payload;
};
inline constexpr std::size_t most_websocket_bytes = 4096;  // of one message from a page

enum class WebsocketRead : std::uint8_t { incomplete, complete, broken };
// Takes one message from the front of `bytes`. Clients must mask; fragments are not accepted.
[[nodiscard]] WebsocketRead read_websocket(std::string& bytes, WebsocketMessage& message);

}  // namespace scenec::runtime
