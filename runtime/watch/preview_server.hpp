// The HTTP and WebSocket server of the preview page: one thread, no blocking call but the wait for
// something to happen. Slow or dead pages cost a connection and nothing else: each holds at most
// one unsent picture, and gets the newest one when it has shown the last.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/file_descriptor.hpp"
#include "base/result.hpp"
#include "runtime/watch/board.hpp"
#include "runtime/watch/gate.hpp"
#include "runtime/watch/http_message.hpp"

namespace scenec::runtime {

class PageConnection;

// The socket that listens, bound before anything else starts.
struct Listening {
  Descriptor v4;
  Descriptor v6;  // of the same port where the system has it
  std::uint16_t port = 0;
};
// On the loopback interface only. Port 0: any that is free.
[[nodiscard]] Result<Listening, std::string> listen_on_loopback(std::uint16_t port);

struct ServerLimits {
  std::size_t connections = 256;
  std::chrono::milliseconds request{10'000};  // for the whole of a request to arrive
  std::chrono::milliseconds idle{60'000};     // between requests, and for a page to take anything
  std::chrono::milliseconds ping{20'000};
};

class PreviewServer {
 public:
  using RequestId = std::uint64_t;
  // Called on the server's thread; must not block. Answered by reply(), from any thread.
  using Handler = std::function<void(RequestId, HttpRequest)>;

  PreviewServer(Listening listening, Gate gate, Board& board, Handler handler,
                ServerLimits limits = {});
  ~PreviewServer();
  PreviewServer(const PreviewServer&) = delete;
  PreviewServer& operator=(const PreviewServer&) = delete;

  // Ends the thread: the handler is not called from then on.
  void stop();

  void reply(RequestId id, HttpResponse response);
  // There is something new on the board.
  void wake();
  [[nodiscard]] std::size_t connection_count() const { return connection_count_; }

 private:
  using Clock = std::chrono::steady_clock;

  void run(const std::stop_token& stop);
  void accept_all(int listener);
  void handle(PageConnection& connection, std::uint32_t events);
  void serve(PageConnection& connection, Clock::time_point now);
  void open_stream(PageConnection& connection, const HttpRequest& request, Clock::time_point now);
  void take_replies();
  void send_news();
  void look_after_times(Clock::time_point now);
  void close(int descriptor);
  void want(PageConnection& connection);

  Listening listening_;
  Gate gate_;
  Board& board_;
  Handler handler_;
  ServerLimits limits_;
  Descriptor poll_;
  Descriptor wake_;
  std::map<int, std::unique_ptr<PageConnection>> connections_;
  std::map<RequestId, int> answering_;  // by whom they were asked
  RequestId next_id_ = 1;
  Clock::time_point last_look_{};
  std::atomic<std::size_t> connection_count_{0};

  std::mutex mutex_;
  std::vector<std::pair<RequestId, HttpResponse>> replies_;
  std::jthread thread_;
};

}  // namespace scenec::runtime
