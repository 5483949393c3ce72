#include "runtime/watch/gate.hpp"

#include <gtest/gtest.h>

namespace scenec::runtime {
namespace {

using Headers = std::vector<std::pair<std::string, std::string>>;

const Gate gate{.port = 7727, .token = "0123456789abcdef"};

int status(Access access, Headers headers, std::string method = "GET") {
  const HttpRequest request{.method = std::move(method),
                            .path = "/",
                            .query = "",
                            .headers = std::move(headers),
                            .body = ""};
  const auto refusal = refusal_of(gate, request, access);
  return refusal ? refusal->status : 200;
}

const Headers ours{{"host", "127.0.0.1:7727"}, {"x-scenec-token", "0123456789abcdef"}};

Headers with(Headers headers, std::string name, std::string value) {
  std::erase_if(headers, [&](const auto& header) { return header.first == name; });
  headers.emplace_back(std::move(name), std::move(value));
  return headers;
}

TEST(gate, our_own_page_gets_answers) {
  EXPECT_EQ(status(Access::page, {{"host", "127.0.0.1:7727"}}), 200);
  EXPECT_EQ(status(Access::read, ours), 200);
  EXPECT_EQ(status(Access::read, with(ours, "host", "localhost:7727")), 200);
  EXPECT_EQ(status(Access::read, with(ours, "host", "[::1]:7727")), 200);
  EXPECT_EQ(status(Access::read, with(ours, "origin", "http://127.0.0.1:7727")), 200);
  EXPECT_EQ(status(Access::write, with(ours, "content-type", "application/json"), "POST"), 200);
}

TEST(gate, other_names_for_this_machine_are_refused) {
  for (const char* const host : {"evil.example:7727", "127.0.0.1:80", "127.0.0.1", "localhost",
                                 "127.0.0.1.evil.example:7727", ""}) {
    EXPECT_EQ(status(Access::page, {{"host", host}}), 403) << host;
    EXPECT_EQ(status(Access::read, with(ours, "host", host)), 403) << host;
  }
  EXPECT_EQ(status(Access::page, {}), 403);
}

TEST(gate, other_pages_are_refused_whatever_they_know) {
  for (const char* const origin : {"http://evil.example", "null", "http://127.0.0.1:8000",
                                   "https://127.0.0.1:7727", "http://localhost:7727"}) {
    EXPECT_EQ(status(Access::page, with(ours, "origin", origin)), 403) << origin;
    EXPECT_EQ(status(Access::read, with(ours, "origin", origin)), 403) << origin;
  }
  for (const char* const site : {"cross-site", "same-site"}) {
    EXPECT_EQ(status(Access::page, with(ours, "sec-fetch-site", site)), 403) << site;
  }
}

TEST(gate, pictures_need_the_token_and_changes_a_json_post_besides) {
  EXPECT_EQ(status(Access::read, {{"host", "127.0.0.1:7727"}}), 403);
  EXPECT_EQ(status(Access::read, with(ours, "x-scenec-token", "0123456789abcdee")), 403);
  EXPECT_EQ(status(Access::read, with(ours, "x-scenec-token", "")), 403);
  EXPECT_EQ(status(Access::write, with(ours, "content-type", "application/json")), 405);
  EXPECT_EQ(status(Access::write, with(ours, "content-type", "text/plain"), "POST"), 415);
}

TEST(gate, a_websocket_says_its_token_as_a_protocol) {
  const Headers socket{{"host", "127.0.0.1:7727"}};
  EXPECT_EQ(status(Access::read,
                   with(socket, "sec-websocket-protocol", "scenec, token.0123456789abcdef")),
            200);
  EXPECT_EQ(status(Access::read, with(socket, "sec-websocket-protocol", "scenec, token.00")), 403);
}

TEST(gate, tokens_are_long_and_differ) {
  const std::string token = random_token();
  EXPECT_EQ(token.size(), 32U);
  EXPECT_NE(token, random_token());
  EXPECT_FALSE(same_secret("", ""));
}

}  // namespace
}  // namespace scenec::runtime
