// The server with real sockets, many pages at a time and boards that change under it: what the
// thread sanitizer is to see.
#include "runtime/watch/preview_server.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <thread>

#include "runtime/watch/websocket.hpp"

namespace scenec::runtime {
namespace {

class Page {
 public:
  explicit Page(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket_.number(), reinterpret_cast<sockaddr*>(&address), sizeof address),
              0);
  }
  void send(const std::string& bytes) {
    EXPECT_EQ(::send(socket_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(bytes.size()));
  }
  // All up to and with `end`.
  std::string until(std::string_view end) {
    std::size_t at = std::string::npos;
    while ((at = bytes_.find(end)) == std::string::npos) {
      char buffer[4096];
      const ssize_t size = ::recv(socket_.number(), buffer, sizeof buffer, 0);
      if (size <= 0) return {};
      bytes_.append(buffer, static_cast<std::size_t>(size));
    }
    std::string taken = bytes_.substr(0, at + end.size());
    bytes_.erase(0, at + end.size());
    return taken;
  }

 private:
  Descriptor socket_;
  std::string bytes_;
};

struct Site {
  Board board{2};
  std::uint16_t port = 0;
  std::optional<PreviewServer> server;

  Site() {
    auto listening = listen_on_loopback(0);
    EXPECT_TRUE(listening);
    port = listening.value().port;
    server.emplace(std::move(listening).value(), Gate{port, "key"}, board,
                   [this](PreviewServer::RequestId id, HttpRequest request) {
                     server->reply(id, text_response(200, "you asked for " + request.path + "\n"));
                   });
  }
  [[nodiscard]] std::string head(const std::string& path, const std::string& more = {}) const {
    return "GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n" + more +
           "\r\n";
  }
  [[nodiscard]] std::string stream(const std::string& scene) const {
    return head("/stream?scene=" + scene,
                "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                "Sec-WebSocket-Protocol: scenec, token.key\r\n");
  }
};

TEST(preview_server, requests_on_one_connection_are_answered_in_turn) {
  const Site site;
  Page page(site.port);
  page.send(site.head("/a") + site.head("/b") + site.head("/c", "Connection: close\r\n"));
  for (const char* const path : {"/a", "/b", "/c"})
    EXPECT_NE(page.until(std::string("you asked for ") + path + "\n").find("200 OK"),
              std::string::npos);
  EXPECT_EQ(page.until("x"), "");  // closed
}

TEST(preview_server, pages_get_what_changes_while_it_changes) {
  Site site;
  std::vector<std::thread> pages;
  for (int i = 0; i < 8; ++i) {
    pages.emplace_back([&site, i] {
      Page page(site.port);
      page.send(site.stream(i % 3 == 0 ? "all" : std::to_string(i % 3 - 1)));
      EXPECT_NE(page.until("\r\n\r\n").find("s3pPLMBiTxaQ9kYGzzhZRbK+xOo="), std::string::npos);
      EXPECT_FALSE(page.until("the last").empty());
    });
  }
  for (int n = 0; n < 200; ++n) {
    site.board.put_state(static_cast<std::size_t>(n % 2), "state " + std::to_string(n));
    site.board.put_frame(static_cast<std::size_t>(n % 2), std::string(10'000, 'f'));
  }
  for (const std::size_t scene : {0U, 1U}) site.board.put_state(scene, "this is the last");
  for (std::thread& page : pages) page.join();
}

TEST(preview_server, a_port_that_is_taken_is_said) {
  const Site site;
  const auto second = listen_on_loopback(site.port);
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().find("another program has it"), std::string::npos);
}

}  // namespace
}  // namespace scenec::runtime
