#include "runtime/watch/preview_server.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "base/text.hpp"
#include "runtime/watch/page_connection.hpp"

namespace scenec::runtime {

namespace {

Descriptor bound_socket(const sockaddr* address, socklen_t size) {
  Descriptor result(::socket(address->sa_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const int yes = 1;
  // A daemon that is started again takes its port back at once.
  ::setsockopt(result.number(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (address->sa_family == AF_INET6)
    ::setsockopt(result.number(), IPPROTO_IPV6, IPV6_V6ONLY, &yes, sizeof yes);
  if (::bind(result.number(), address, size) != 0) return Descriptor();
  if (::listen(result.number(), 128) != 0) return Descriptor();
  return result;
}

}  // namespace

Result<Listening, std::string> listen_on_loopback(std::uint16_t port) {
  Listening result;
  sockaddr_in v4{};
  v4.sin_family = AF_INET;
  v4.sin_port = htons(port);
  v4.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  result.v4 = bound_socket(reinterpret_cast<const sockaddr*>(&v4), sizeof v4);
  if (!result.v4.valid()) {
    return Failure{fmt::format(
        "port {} of 127.0.0.1 cannot be used: {}", port,
        errno == EADDRINUSE ? "another program has it" : std::string(std::strerror(errno)))};
  }
  socklen_t size = sizeof v4;
  ::getsockname(result.v4.number(), reinterpret_cast<sockaddr*>(&v4), &size);
  result.port = ntohs(v4.sin_port);
  sockaddr_in6 v6{};
  v6.sin6_family = AF_INET6;
  v6.sin6_port = htons(result.port);
  v6.sin6_addr = in6addr_loopback;
  result.v6 = bound_socket(reinterpret_cast<const sockaddr*>(&v6), sizeof v6);
  return result;
}

PreviewServer::PreviewServer(Listening listening, Gate gate, Board& board, Handler handler,
                             ServerLimits limits)
    : listening_(std::move(listening)),
      gate_(std::move(gate)),
      board_(board),
      handler_(std::move(handler)),
      limits_(limits),
      poll_(::epoll_create1(EPOLL_CLOEXEC)),
      wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  for (const int descriptor : {listening_.v4.number(), listening_.v6.number(), wake_.number()}) {
    epoll_event event{.events = EPOLLIN, .data = {.fd = descriptor}};
    if (descriptor >= 0) ::epoll_ctl(poll_.number(), EPOLL_CTL_ADD, descriptor, &event);
  }
  board_.on_change([this] { wake(); });
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

PreviewServer::~PreviewServer() {
  stop();
}

void PreviewServer::stop() {
  if (!thread_.joinable()) return;
  board_.on_change(nullptr);
  thread_.request_stop();
  wake();
  thread_.join();
}

void PreviewServer::wake() {
  const std::uint64_t one = 1;
  static_cast<void>(::write(wake_.number(), &one, sizeof one));  // full means awake
}

void PreviewServer::reply(RequestId id, HttpResponse response) {
  {
    const std::lock_guard lock(mutex_);
    replies_.emplace_back(id, std::move(response));
  }
  wake();
}

void PreviewServer::run(const std::stop_token& stop) {
  std::array<epoll_event, 64> events{};
  while (!stop.stop_requested()) {
    const int count =
        ::epoll_wait(poll_.number(), events.data(), static_cast<int>(events.size()), 1000);
    if (stop.stop_requested()) break;
    for (int i = 0; i < count; ++i) {
      const int descriptor = events[static_cast<std::size_t>(i)].data.fd;
      if (descriptor == wake_.number()) {
        std::uint64_t ignored = 0;
        static_cast<void>(::read(descriptor, &ignored, sizeof ignored));
      } else if (descriptor == listening_.v4.number() || descriptor == listening_.v6.number()) {
        accept_all(descriptor);
      } else if (const auto found = connections_.find(descriptor); found != connections_.end()) {
        handle(*found->second, events[static_cast<std::size_t>(i)].events);
      }
    }
    take_replies();
    send_news();
    look_after_times(Clock::now());
  }
  while (!connections_.empty()) close(connections_.begin()->first);
}

void PreviewServer::accept_all(int listener) {
  while (true) {
    Descriptor socket(::accept4(listener, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!socket.valid()) return;
    if (connections_.size() >= limits_.connections) {
      // One that waits for nothing makes room.
      const auto idle = std::find_if(connections_.begin(), connections_.end(),
                                     [](const auto& c) { return c.second->is_idle(); });
      if (idle == connections_.end()) continue;  // closes the new one
      close(idle->first);
    }
    const int yes = 1;
    ::setsockopt(socket.number(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    const int descriptor = socket.number();
    epoll_event event{.events = EPOLLIN, .data = {.fd = descriptor}};
    if (::epoll_ctl(poll_.number(), EPOLL_CTL_ADD, descriptor, &event) != 0) continue;
    connections_[descriptor] = std::make_unique<PageConnection>(std::move(socket), Clock::now());
    connection_count_ = connections_.size();
  }
}

void PreviewServer::close(int descriptor) {
  const auto found = connections_.find(descriptor);
  if (found == connections_.end()) return;
  if (found->second->is_stream()) board_.add_viewers(found->second->scene(), -1);
  connections_.erase(found);  // closing takes it out of the epoll set
  connection_count_ = connections_.size();
}

void PreviewServer::want(PageConnection& connection) {
  epoll_event event{.events = 0, .data = {.fd = connection.descriptor()}};
  if (connection.wants_to_read()) event.events |= EPOLLIN;
  if (connection.wants_to_write()) event.events |= EPOLLOUT;
  ::epoll_ctl(poll_.number(), EPOLL_CTL_MOD, connection.descriptor(), &event);
}

void PreviewServer::handle(PageConnection& connection, std::uint32_t events) {
  const Clock::time_point now = Clock::now();
  const int descriptor = connection.descriptor();
  if ((events & (EPOLLERR | EPOLLHUP)) != 0) return close(descriptor);
  if ((events & EPOLLIN) != 0) {
    if (!connection.read_available()) return close(descriptor);
    if (connection.is_stream()) {
      if (!connection.read_messages()) return close(descriptor);
    } else {
      serve(connection, now);
    }
  }
  if (!connection.write_available(now)) return close(descriptor);
  // What had arrived behind the request that has just been answered.
  if (!connection.wants_to_write() && !connection.is_stream()) serve(connection, now);
  want(connection);
}

void PreviewServer::serve(PageConnection& connection, Clock::time_point now) {
  auto request = connection.next_request(now);
  if (!request) return;
  if (request->path == "/stream") {
    open_stream(connection, *request, now);
    return;
  }
  const RequestId id = next_id_++;
  connection.begin_answer(id);
  answering_[id] = connection.descriptor();
  handler_(id, std::move(*request));
}

void PreviewServer::open_stream(PageConnection& connection, const HttpRequest& request,
                                Clock::time_point now) {
  if (auto refusal = refusal_of(gate_, request, Access::read)) {
    connection.answer(*refusal, now);
    return;
  }
  const bool is_websocket = request.method == "GET" &&
                            request.header("upgrade").value_or("") == "websocket" &&
                            request.header("sec-websocket-version").value_or("") == "13" &&
                            request.header("sec-websocket-key").value_or("").size() == 24;
  const std::string_view which = request.parameter("scene").value_or("0");
  std::optional<std::size_t> scene;
  if (const auto number = parse_int(which);
      number && *number >= 0 && static_cast<std::size_t>(*number) < board_.size()) {
    scene = static_cast<std::size_t>(*number);
  }
  if (!is_websocket || (!scene && which != "all")) {
    connection.answer(text_response(400, "not a stream of this server\n"), now);
    return;
  }
  board_.add_viewers(scene, 1);
  connection.become_stream(request, scene);
}

void PreviewServer::take_replies() {
  std::vector<std::pair<RequestId, HttpResponse>> replies;
  {
    const std::lock_guard lock(mutex_);
    replies.swap(replies_);
  }
  for (const auto& [id, response] : replies) {
    const auto asked = answering_.find(id);
    if (asked == answering_.end()) continue;
    const auto found = connections_.find(asked->second);
    answering_.erase(asked);
    // The one who asked may have gone, and another have taken its number.
    if (found == connections_.end() || found->second->answering() != id) continue;
    found->second->answer(response, Clock::now());
    handle(*found->second, 0);
  }
}

void PreviewServer::send_news() {
  std::vector<int> over;
  for (const auto& [descriptor, connection] : connections_) {
    if (!connection->is_stream() || connection->wants_to_write()) continue;
    connection->send_news(board_);
    if (!connection->wants_to_write()) continue;
    if (connection->write_available(Clock::now())) {
      want(*connection);
    } else {
      over.push_back(descriptor);
    }
  }
  for (const int descriptor : over) close(descriptor);
}

void PreviewServer::look_after_times(Clock::time_point now) {
  if (now - last_look_ < std::chrono::seconds(1)) return;
  last_look_ = now;
  std::vector<int> over;
  for (const auto& [descriptor, connection] : connections_) {
    if (connection->is_stream()) {
      if (now - connection->last_taken() > limits_.idle) over.push_back(descriptor);
      if (now - connection->last_ping() > limits_.ping) {
        connection->ping();
        want(*connection);
      }
    } else if (!connection->answering()) {
      const auto limit = connection->is_idle() ? limits_.idle : limits_.request;
      if (now - connection->since() > limit) over.push_back(descriptor);
    }
  }
  for (const int descriptor : over) close(descriptor);
}

}  // namespace scenec::runtime
