#include "runtime/watch/websocket.hpp"

#include <gtest/gtest.h>

namespace scenec::runtime {
namespace {

std::string hex_of(const std::array<std::uint8_t, 20>& bytes) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text;
}

TEST(websocket, sha1_gives_the_values_of_the_standard) {
  EXPECT_EQ(hex_of(sha1_of("abc")), "a9993e364706816aba3e25717850c26c9cd0d89d");
  EXPECT_EQ(hex_of(sha1_of("")), "da39a3ee5e6b4b0d3255bfef95601890afd80709");
  EXPECT_EQ(hex_of(sha1_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq")),
            "84983e441c3bd26ebaae4aa1f95129e5e54670f1");
}

TEST(websocket, the_answer_to_the_key_is_that_of_the_standard) {
  EXPECT_EQ(websocket_accept_of("dGhlIHNhbXBsZSBub25jZQ=="), "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=");
}

std::string masked(unsigned char first, std::string_view payload) {
  const std::string mask = "\x11\x22\x33\x44";
  std::string bytes(1, static_cast<char>(first));
  if (payload.size() < 126) {
    bytes += static_cast<char>(0x80 | payload.size());
  } else {
    bytes += static_cast<char>(0x80 | 126);
    bytes += static_cast<char>(payload.size() >> 8);
    bytes += static_cast<char>(payload.size() & 0xff);
  }
  bytes += mask;
  for (std::size_t i = 0; i < payload.size(); ++i)
    bytes += static_cast<char>(payload[i] ^ mask[i % 4]);
  return bytes;
}

TEST(websocket, messages_are_taken_whole_and_unmasked) {
  for (const std::size_t size : {0U, 5U, 125U, 126U, 4096U}) {
    const std::string payload(size, 'p');
    const std::string whole = masked(0x81, payload);
    for (std::size_t cut = 0; cut < whole.size(); cut += 1 + whole.size() / 7) {
      std::string part = whole.substr(0, cut);
      WebsocketMessage message;
      EXPECT_EQ(read_websocket(part, message), WebsocketRead::incomplete);
    }
    std::string bytes = whole + "rest";
    WebsocketMessage message;
    ASSERT_EQ(read_websocket(bytes, message), WebsocketRead::complete);
    EXPECT_EQ(message.payload, payload);
    EXPECT_EQ(bytes, "rest");
  }
}

TEST(websocket, what_a_browser_never_sends_is_refused) {
  WebsocketMessage message;
  std::string unmasked("\x81\x01x", 3);
  EXPECT_EQ(read_websocket(unmasked, message), WebsocketRead::broken);
  std::string fragment = masked(0x01, "x");
  EXPECT_EQ(read_websocket(fragment, message), WebsocketRead::broken);
  std::string large = masked(0x81, std::string(4097, 'x'));
  EXPECT_EQ(read_websocket(large, message), WebsocketRead::broken);
  std::string unknown = masked(0x83, "x");
  EXPECT_EQ(read_websocket(unknown, message), WebsocketRead::broken);
  std::string huge("\x82\xff\x7f\xff\xff\xff\xff\xff\xff\xff", 10);
  EXPECT_EQ(read_websocket(huge, message), WebsocketRead::broken);
}

TEST(websocket, heads_name_the_size_in_the_shortest_form) {
  EXPECT_EQ(websocket_head(WebsocketKind::binary, 125), "\x82\x7d");
  EXPECT_EQ(websocket_head(WebsocketKind::text, 126), std::string("\x81\x7e\x00\x7e", 4));
  EXPECT_EQ(websocket_head(WebsocketKind::text, 65536),
            std::string("\x81\x7f\0\0\0\0\0\x01\0\0", 10));
}

}  // namespace
}  // namespace scenec::runtime
