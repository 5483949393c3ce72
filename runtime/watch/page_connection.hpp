// One connection of the preview server: first HTTP requests, one at a time, then perhaps a stream
// of states and pictures. Used by the server's thread alone.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/file_descriptor.hpp"
#include "runtime/watch/board.hpp"
#include "runtime/watch/http_message.hpp"
#include "runtime/watch/websocket.hpp"

namespace scenec::runtime {

class PageConnection {
 public:
  using Clock = std::chrono::steady_clock;

  PageConnection(Descriptor socket, Clock::time_point now)
      : socket_(std::move(socket)), since_(now), last_taken_(now) {}

  [[nodiscard]] int descriptor() const { return socket_.number(); }

  // Both never block; false: the connection is over.
  bool read_available();
  bool write_available(Clock::time_point now);
  [[nodiscard]] bool wants_to_write() const { return !out_.empty(); }
  // Nothing more is read while an answer is being made.
  [[nodiscard]] bool wants_to_read() const { return !closing_ && !answering_; }

  // The next whole request; what is broken is answered and the connection then closed.
  [[nodiscard]] std::optional<HttpRequest> next_request(Clock::time_point now);
  void begin_answer(std::uint64_t id) { answering_ = id; }
  [[nodiscard]] std::optional<std::uint64_t> answering() const { return answering_; }
  void answer(const HttpResponse& response, Clock::time_point now);

  // From now on a stream of the scene given, or of all.
  void become_stream(const HttpRequest& request, std::optional<std::size_t> scene);
  [[nodiscard]] bool is_stream() const { return is_stream_; }
  [[nodiscard]] std::optional<std::size_t> scene() const { return scene_; }  // nothing: all
  // False when the page said something it should not have.
  bool read_messages();
  void send_news(const Board& board);
  void ping();

  [[nodiscard]] bool is_idle() const {
    return !is_stream_ && !answering_ && in_.empty() && out_.empty();
  }
  // Of the request that is arriving, or of the waiting for one.
  [[nodiscard]] Clock::time_point since() const { return since_; }
  // When the other side has taken or said something the last time.
  [[nodiscard]] Clock::time_point last_taken() const { return last_taken_; }
  [[nodiscard]] Clock::time_point last_ping() const { return last_ping_; }

 private:
  void put(std::string bytes) { put(std::make_shared<const std::string>(std::move(bytes))); }
  void put(Board::Bytes bytes) {
    if (bytes && !bytes->empty()) out_.push_back(std::move(bytes));
  }
  void put_message(WebsocketKind kind, const Board::Bytes& bytes);
  void send_scene(const Board& board, std::size_t scene, bool pictures);

  Descriptor socket_;
  std::string in_;
  HttpParser parser_;
  std::deque<Board::Bytes> out_;
  std::size_t out_offset_ = 0;  // of the first of them
  std::optional<std::uint64_t> answering_;
  AfterResponse after_ = AfterResponse::keep_open;
  bool closing_ = false;  // when all is written

  bool is_stream_ = false;
  std::optional<std::size_t> scene_;
  std::vector<std::uint64_t> states_sent_;  // by scene
  std::uint64_t list_sent_ = 0;
  std::uint64_t frame_sent_ = 0;
  bool showing_ = false;  // a picture was sent that the page has not shown yet

  Clock::time_point since_;
  Clock::time_point last_taken_;
  Clock::time_point last_ping_{};
};

}  // namespace scenec::runtime
