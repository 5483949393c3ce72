// Who may talk to the preview server. Every web page the author visits can reach a port of the
// loopback interface; only our own page, opened with the token of this run, gets an answer.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/watch/http_message.hpp"

namespace scenec::runtime {

struct Gate {
  std::uint16_t port = 0;
  std::string token;
};

enum class Access : std::uint8_t {
  page,   // the page itself: holds no secret, needs no token
  read,   // pictures and states: the token
  write,  // what changes something: POST with the token and a JSON body
};

// Why the request is refused, or nothing.
[[nodiscard]] std::optional<HttpResponse> refusal_of(const Gate& gate, const HttpRequest& request,
                                                     Access access);

// 128 random bits as hexadecimal digits.
[[nodiscard]] std::string random_token();
// In time that does not depend on where they differ.
[[nodiscard]] bool same_secret(std::string_view a, std::string_view b);

// A page says its token in `X-Scenec-Token`, or, where it cannot set headers (WebSocket), as the
// subprotocol `token.DIGITS` beside `scenec`.
inline constexpr std::string_view websocket_protocol = "scenec";

}  // namespace scenec::runtime
