#include "runtime/watch/websocket.hpp"

#include <bit>
#include <vector>

namespace scenec::runtime {

namespace {

using Block = std::array<std::uint32_t, 80>;

void mix_block(std::array<std::uint32_t, 5>& hash, const std::uint8_t* bytes) {
  Block w{};
  for (std::size_t i = 0; i < 16; ++i) {
    w[i] = static_cast<std::uint32_t>(bytes[4 * i]) << 24 |
           static_cast<std::uint32_t>(bytes[4 * i + 1]) << 16 |
           static_cast<std::uint32_t>(bytes[4 * i + 2]) << 8 |
           static_cast<std::uint32_t>(bytes[4 * i + 3]);
  }
  for (std::size_t i = 16; i < w.size(); ++i)
    w[i] = std::rotl(w[i - 3] ^ w[i - 8] ^ w[i - 14] ^ w[i - 16], 1);
  auto [a, b, c, d, e] = hash;
  for (std::size_t i = 0; i < w.size(); ++i) {
    std::uint32_t f = 0;
    std::uint32_t k = 0;
    if (i < 20) {
      f = (b & c) | (~b & d);
      k = 0x5a827999;
    } else if (i < 40) {
      f = b ^ c ^ d;
      k = 0x6ed9eba1;
    } else if (i < 60) {
      f = (b & c) | (b & d) | (c & d);
      k = 0x8f1bbcdc;
    } else {
      f = b ^ c ^ d;
      k = 0xca62c1d6;
    }
    const std::uint32_t next = std::rotl(a, 5) + f + e + k + w[i];
    e = d;
    d = c;
    c = std::rotl(b, 30);
    b = a;
    a = next;
  }
  hash[0] += a;
  hash[1] += b;
  hash[2] += c;
  hash[3] += d;
  hash[4] += e;
}

std::string base64_of(const std::array<std::uint8_t, 20>& bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t at) -> std::uint32_t {
      return at < bytes.size() ? bytes[at] : 0;
    };
    const std::uint32_t group = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (std::size_t j = 0; j < 4; ++j)
      text += i + j <= bytes.size() ? digits[group >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

}  // namespace

std::array<std::uint8_t, 20> sha1_of(std::string_view bytes) {
  std::vector<std::uint8_t> padded(bytes.begin(), bytes.end());
  padded.push_back(0x80);
  while (padded.size() % 64 != 56) padded.push_back(0);
  const std::uint64_t bits = std::uint64_t{bytes.size()} * 8;
  for (int shift = 56; shift >= 0; shift -= 8)
    padded.push_back(static_cast<std::uint8_t>(bits >> shift));
  std::array<std::uint32_t, 5> hash{0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476, 0xc3d2e1f0};
  for (std::size_t at = 0; at < padded.size(); at += 64) mix_block(hash, padded.data() + at);
  std::array<std::uint8_t, 20> result{};
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = static_cast<std::uint8_t>(hash[i / 4] >> (24 - 8 * (i % 4)));
  return result;
}

std::string websocket_accept_of(std::string_view key) {
  return base64_of(sha1_of(std::string(key) + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11"));
}

std::string websocket_head(WebsocketKind kind, std::size_t size) {
  std::string head(1, static_cast<char>(0x80 | static_cast<unsigned>(kind)));
  int bytes = 0;
  if (size < 126) {
    head += static_cast<char>(size);
  } else {
    bytes = size <= 0xffff ? 2 : 8;
    head += static_cast<char>(bytes == 2 ? 126 : 127);
  }
  for (int i = bytes - 1; i >= 0; --i)
    head += static_cast<char>(std::uint64_t{size} >> (8 * i) & 0xff);
  return head;
}

WebsocketRead read_websocket(std::string& bytes, WebsocketMessage& message) {
  if (bytes.size() < 2) return WebsocketRead::incomplete;
  const auto at = [&](std::size_t i) -> unsigned { return static_cast<unsigned char>(bytes[i]); };
  const unsigned kind = at(0) & 0x0f;
  const bool whole = (at(0) & 0xf0) == 0x80;  // final, no extensions
  const bool masked = (at(1) & 0x80) != 0;
  const bool known = kind == 1 || kind == 2 || (kind >= 8 && kind <= 10);
  if (!whole || !masked || !known) return WebsocketRead::broken;
  std::size_t size = at(1) & 0x7f;
  std::size_t head = 2;
  if (size == 127 || (size == 126 && kind >= 8)) return WebsocketRead::broken;  // over the limit
  if (size == 126) {
    if (bytes.size() < 4) return WebsocketRead::incomplete;
    size = at(2) << 8 | at(3);
    head = 4;
  }
  if (size > most_websocket_bytes) return WebsocketRead::broken;
  if (bytes.size() < head + 4 + size) return WebsocketRead::incomplete;
  message.kind = static_cast<WebsocketKind>(kind);
  message.payload.resize(size);
  for (std::size_t i = 0; i < size; ++i)
    message.payload[i] = static_cast<char>(at(head + 4 + i) ^ at(head + i % 4));
  bytes.erase(0, head + 4 + size);
  return WebsocketRead::complete;
}

}  // namespace scenec::runtime
