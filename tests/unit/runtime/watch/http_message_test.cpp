#include "runtime/watch/http_message.hpp"

#include <gtest/gtest.h>

namespace scenec::runtime {
namespace {

using State = HttpParser::State;

State parse(std::string bytes, HttpParser& parser) {
  return parser.feed(bytes);
}

TEST(http_message, a_request_is_taken_in_pieces_and_leaves_the_next_one) {
  const std::string text =
      "POST /wish?scene=1&x=2 HTTP/1.1\r\nHost: h:1\r\nContent-Length: 4\r\n\r\nbodyGET /";
  HttpParser parser;
  std::string bytes;
  State state = State::incomplete;
  std::size_t at = 0;
  while (state == State::incomplete && at < text.size()) {
    bytes += text[at++];
    state = parser.feed(bytes);
  }
  ASSERT_EQ(state, State::complete);
  bytes += text.substr(at);
  const HttpRequest request = parser.take();
  EXPECT_EQ(request.method, "POST");
  EXPECT_EQ(request.path, "/wish");
  EXPECT_EQ(request.parameter("scene"), "1");
  EXPECT_EQ(request.parameter("x"), "2");
  EXPECT_FALSE(request.parameter("y"));
  EXPECT_EQ(request.header("host"), "h:1");
  EXPECT_EQ(request.body, "body");
  EXPECT_EQ(bytes, "GET /");
}

TEST(http_message, what_is_not_understood_is_refused) {
  for (const char* const text :
       {"GET\r\n\r\n", "GET / HTTP/1.0\r\n\r\n", "GET http://x/ HTTP/1.1\r\n\r\n",
        "GET  / HTTP/1.1\r\n\r\n", "G\x01T / HTTP/1.1\r\n\r\n",
        "GET / HTTP/1.1\r\nno colon\r\n\r\n", "GET / HTTP/1.1\r\n: x\r\n\r\n",
        "GET / HTTP/1.1\r\na b: x\r\n\r\n", "GET / HTTP/1.1\r\nContent-Length: -1\r\n\r\n",
        "GET / HTTP/1.1\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\n",
        "GET / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n",
        "GET / HTTP/1.1\r\nContent-Length: 99999999999999999999\r\n\r\n"}) {
    HttpParser parser;
    EXPECT_EQ(parse(text, parser), State::broken) << text;
  }
}

TEST(http_message, sizes_are_limited_before_anything_is_stored) {
  HttpParser parser;
  EXPECT_EQ(parse("GET / HTTP/1.1\r\nA: " + std::string(most_head_bytes, 'x'), parser),
            State::broken);
  EXPECT_EQ(parser.refusal().status, 431);
  HttpParser other;
  EXPECT_EQ(parse("GET / HTTP/1.1\r\nContent-Length: 65537\r\n\r\n", other), State::broken);
  EXPECT_EQ(other.refusal().status, 413);
}

TEST(http_message, a_header_given_twice_counts_as_absent) {
  HttpParser parser;
  ASSERT_EQ(parse("GET / HTTP/1.1\r\nOrigin: a\r\norigin: b\r\n\r\n", parser), State::complete);
  EXPECT_FALSE(parser.take().header("origin"));
}

TEST(http_message, every_answer_carries_the_rules_for_browsers) {
  const std::string head = head_of(text_response(200, "x"), AfterResponse::keep_open);
  for (const char* const rule : {"default-src 'none'", "frame-ancestors 'none'", "nosniff",
                                 "no-store", "same-origin", "no-referrer"}) {
    EXPECT_NE(head.find(rule), std::string::npos) << rule;
  }
  EXPECT_EQ(head.find("Access-Control"), std::string::npos);
}

}  // namespace
}  // namespace scenec::runtime
