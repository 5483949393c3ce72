#include "runtime/watch/tev_client.hpp"

#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace scenec::runtime {

namespace {

constexpr int tile_side = 128;
constexpr std::array<std::string_view, 3> channels{"R", "G", "B"};

template <class T>
void put(std::string& bytes, T value) {
  static_assert(std::endian::native == std::endian::little);
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

void put_text(std::string& bytes, std::string_view text) {
  bytes += text;
  bytes += '\0';
}

std::string with_length(std::string_view body) {
  std::string packet;
  put(packet, static_cast<std::uint32_t>(body.size() + 4));
  packet += body;
  return packet;
}

Descriptor connected_socket(const std::string& host, int port) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found) != 0)
    return Descriptor();
  Descriptor result;
  for (const addrinfo* at = found; at != nullptr && !result.valid(); at = at->ai_next) {
    Descriptor socket(::socket(at->ai_family, at->ai_socktype | SOCK_CLOEXEC, at->ai_protocol));
    if (!socket.valid()) continue;
    const timeval three_seconds{.tv_sec = 3, .tv_usec = 0};
    ::setsockopt(socket.number(), SOL_SOCKET, SO_SNDTIMEO, &three_seconds, sizeof three_seconds);
    if (::connect(socket.number(), at->ai_addr, at->ai_addrlen) == 0) result = std::move(socket);
  }
  ::freeaddrinfo(found);
  return result;
}

// The pixels of the tile; of a coarse picture each stands for several.
std::vector<float> pixels_of(const backend::Picture& picture, const FrameInfo& info,
                             const TevTile& tile) {
  std::vector<float> rgb;
  rgb.reserve(static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(tile.height) * 3);
  for (int y = 0; y < tile.height; ++y) {
    const int row = std::min((tile.y + y) / info.step, picture.height - 1);
    for (int x = 0; x < tile.width; ++x) {
      const int column = std::min((tile.x + x) / info.step, picture.width - 1);
      const auto at = 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width) +
                           static_cast<std::size_t>(column));
      rgb.insert(rgb.end(), picture.rgb.begin() + static_cast<std::ptrdiff_t>(at),
                 picture.rgb.begin() + static_cast<std::ptrdiff_t>(at + 3));
    }
  }
  return rgb;
}

}  // namespace

std::string tev_create_packet(std::string_view name, int width, int height) {
  std::string body;
  put(body, std::uint8_t{4});
  put(body, std::uint8_t{0});  // does not grab the focus
  put_text(body, name);
  put(body, static_cast<std::int32_t>(width));
  put(body, static_cast<std::int32_t>(height));
  put(body, static_cast<std::int32_t>(channels.size()));
  for (const std::string_view channel : channels) put_text(body, channel);
  return with_length(body);
}

std::string tev_update_packet(std::string_view name, const TevTile& tile,
                              const std::vector<float>& rgb) {
  std::string body;
  put(body, std::uint8_t{6});
  put(body, std::uint8_t{0});
  put_text(body, name);
  put(body, static_cast<std::int32_t>(channels.size()));
  for (const std::string_view channel : channels) put_text(body, channel);
  for (const int value : {tile.x, tile.y, tile.width, tile.height})
    put(body, static_cast<std::int32_t>(value));
  for (std::int64_t i = 0; i < std::ssize(channels); ++i) put(body, i);          // offsets
  for (std::size_t i = 0; i < channels.size(); ++i) put(body, std::int64_t{3});  // strides
  for (const float value : rgb) put(body, value);
  return with_length(body);
}

TevClient::TevClient(std::string host, int port, Notice notice)
    : host_(std::move(host)),
      port_(port),
      notice_(std::move(notice)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

TevClient::~TevClient() {
  thread_.request_stop();
  awake_.notify_all();
}

void TevClient::show(const std::string& name, std::shared_ptr<const backend::Picture> picture,
                     const FrameInfo& info) {
  {
    const std::lock_guard lock(mutex_);
    news_ = News{name, std::move(picture), info};
  }
  awake_.notify_all();
}

void TevClient::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    News news;
    {
      std::unique_lock lock(mutex_);
      if (!awake_.wait(lock, stop, [&] { return news_.has_value(); })) return;
      news = *std::exchange(news_, std::nullopt);
    }
    if (!send_news(news)) socket_ = Descriptor();
  }
}

bool TevClient::send_news(const News& news) {
  const int width = static_cast<int>(news.info.region.x1 - news.info.region.x0);
  const int height = static_cast<int>(news.info.region.y1 - news.info.region.y0);
  if (!socket_.valid()) {
    socket_ = connected_socket(host_, port_);
    width_ = 0;
  }
  if (!socket_.valid()) {
    if (!std::exchange(told_, true))
      notice_(fmt::format("no viewer answers at {}:{}; it is tried again with every picture", host_,
                          port_));
    return false;
  }
  if (news.name != name_ || width != width_ || height != height_) {
    if (!send_all(tev_create_packet(news.name, width, height))) return false;
    name_ = news.name;
    width_ = width;
    height_ = height;
    sent_.clear();
  }
  std::size_t number = 0;
  for (int y = 0; y < height; y += tile_side) {
    for (int x = 0; x < width; x += tile_side) {
      const TevTile tile{x, y, std::min(tile_side, width - x), std::min(tile_side, height - y)};
      const std::vector<float> rgb = pixels_of(*news.picture, news.info, tile);
      const Hash128 hash =
          hash_bytes({reinterpret_cast<const char*>(rgb.data()), rgb.size() * sizeof(float)});
      if (number == sent_.size()) sent_.emplace_back();
      if (std::exchange(sent_[number++], hash) == hash) continue;
      if (!send_all(tev_update_packet(name_, tile, rgb))) return false;
    }
  }
  return true;
}

bool TevClient::send_all(const std::string& bytes) const {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t size =
        ::send(socket_.number(), bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return false;
    done += static_cast<std::size_t>(size);
  }
  return true;
}

}  // namespace scenec::runtime
