// The packets against the protocol's own rules, and a picture sent to a viewer of sixty lines.
#include "runtime/watch/tev_client.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstring>

namespace scenec::runtime {
namespace {

template <class T>
T take(std::string_view& bytes) {
  T value{};
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}
std::string take_text(std::string_view& bytes) {
  const std::size_t end = bytes.find('\0');
  std::string text(bytes.substr(0, end));
  bytes.remove_prefix(end + 1);
  return text;
}

struct Update {
  std::string name;
  TevTile tile;
  std::vector<float> pixels;
};

Update read_update(std::string_view packet) {
  const auto length = take<std::uint32_t>(packet);
  EXPECT_EQ(length, packet.size() + 4);
  EXPECT_EQ(take<std::uint8_t>(packet), 6);
  EXPECT_EQ(take<std::uint8_t>(packet), 0);
  Update update;
  update.name = take_text(packet);
  EXPECT_EQ(take<std::int32_t>(packet), 3);
  for (const char* const channel : {"R", "G", "B"}) EXPECT_EQ(take_text(packet), channel);
  for (int* const value : {&update.tile.x, &update.tile.y, &update.tile.width, &update.tile.height})
    *value = take<std::int32_t>(packet);
  std::int64_t most = 0;
  std::int64_t offsets[3];
  for (std::int64_t& offset : offsets) offset = take<std::int64_t>(packet);
  for (const std::int64_t offset : offsets) {
    const std::int64_t last = std::int64_t{update.tile.width} * update.tile.height - 1;
    most = std::max(most, offset + last * take<std::int64_t>(packet));
  }
  // The protocol wants exactly as many as the largest index says.
  EXPECT_EQ(packet.size(), static_cast<std::size_t>(most + 1) * sizeof(float));
  while (!packet.empty()) update.pixels.push_back(take<float>(packet));
  return update;
}

TEST(tev_client, packets_say_their_length_and_hold_what_they_announce) {
  const std::string packet = tev_create_packet("a.sdl", 20, 10);
  std::string_view create = packet;
  const auto length = take<std::uint32_t>(create);
  EXPECT_EQ(length, create.size() + 4);
  EXPECT_EQ(take<std::uint8_t>(create), 4);
  EXPECT_EQ(take<std::uint8_t>(create), 0);
  EXPECT_EQ(take_text(create), "a.sdl");
  EXPECT_EQ(take<std::int32_t>(create), 20);
  EXPECT_EQ(take<std::int32_t>(create), 10);
  EXPECT_EQ(take<std::int32_t>(create), 3);
  const std::vector<float> rgb{1, 2, 3, 4, 5, 6};
  const Update update = read_update(tev_update_packet("a.sdl", {5, 6, 2, 1}, rgb));
  EXPECT_EQ(update.name, "a.sdl");
  EXPECT_EQ(update.tile.x, 5);
  EXPECT_EQ(update.pixels, rgb);
}

class Viewer {
 public:
  Viewer() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::bind(socket_.number(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(socket_.number(), 4), 0);
    socklen_t size = sizeof address;
    ::getsockname(socket_.number(), reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
  }
  [[nodiscard]] int port() const { return port_; }
  void accept() { connection_ = Descriptor(::accept(socket_.number(), nullptr, nullptr)); }
  std::string packet() {
    std::string bytes = take_bytes(4);
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data(), sizeof size);
    return bytes + take_bytes(size - 4);
  }

 private:
  std::string take_bytes(std::size_t count) {
    std::string bytes(count, '\0');
    EXPECT_EQ(::recv(connection_.number(), bytes.data(), count, MSG_WAITALL),
              static_cast<ssize_t>(count));
    return bytes;
  }
  Descriptor socket_;
  Descriptor connection_;
  int port_ = 0;
};

std::shared_ptr<const backend::Picture> picture_of(float value) {
  auto picture = std::make_shared<backend::Picture>();
  picture->width = 200;
  picture->height = 100;
  picture->rgb.assign(200 * 100 * 3, 0.25F);
  picture->rgb[0] = value;
  return picture;
}

TEST(tev_client, only_tiles_that_changed_are_sent) {
  Viewer viewer;
  TevClient client("127.0.0.1", viewer.port(), [](const std::string& text) { FAIL() << text; });
  const FrameInfo info{.size = {200, 100}, .region = {0, 0, 200, 100}};
  client.show("a.sdl", picture_of(0.5F), info);
  viewer.accept();
  EXPECT_EQ(viewer.packet()[4], 4);
  const Update first = read_update(viewer.packet());
  EXPECT_EQ(first.tile.width, 128);
  EXPECT_EQ(first.pixels.at(0), 0.5F);
  const Update second = read_update(viewer.packet());
  EXPECT_EQ(second.tile.x, 128);
  EXPECT_EQ(second.tile.width, 72);
  client.show("a.sdl", picture_of(0.75F), info);
  EXPECT_EQ(read_update(viewer.packet()).pixels.at(0), 0.75F);
  client.show("b.sdl", picture_of(0.75F), info);
  EXPECT_EQ(viewer.packet()[4], 4);  // nothing was sent of the tile that is as it was
}

}  // namespace
}  // namespace scenec::runtime
