// Shows pictures in tev, HDRView or whatever speaks tev's protocol (packets "create" and "update
// v3" over TCP): only tiles that have changed are sent, on a thread of its own, the newest picture
// first. A viewer that is not there, or goes away, is tried again; nobody waits for it.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "backend/backend.hpp"
#include "base/file_descriptor.hpp"
#include "base/hash.hpp"
#include "runtime/watch/frame_bytes.hpp"

namespace scenec::runtime {

// Each with its length in front, as the protocol has it.
[[nodiscard]] std::string tev_create_packet(std::string_view name, int width, int height);
struct TevTile {
  int x = 0, y = 0;
  int width = 0, height = 0;
};
// `rgb`: three floats a pixel, rows of the tile one after the other.
[[nodiscard]] std::string tev_update_packet(std::string_view name, const TevTile& tile,
                                            const std::vector<float>& rgb);

class TevClient {
 public:
  using Notice = std::function<void(const std::string&)>;  // on the client's thread
  TevClient(std::string host, int port, Notice notice);
  ~TevClient();
  TevClient(const TevClient&) = delete;
  TevClient& operator=(const TevClient&) = delete;

  void show(const std::string& name, std::shared_ptr<const backend::Picture> picture,
            const FrameInfo& info);

 private:
  struct News {
    std::string name;
    std::shared_ptr<const backend::Picture> picture;
    FrameInfo info;
  };
  void run(const std::stop_token& stop);
  bool send_news(const News& news);
  bool send_all(const std::string& bytes) const;

  std::string host_;
  int port_;
  Notice notice_;
  bool told_ = false;  // that the viewer is not there
  Descriptor socket_;
  std::string name_;  // of the picture the viewer has
  int width_ = 0;
  int height_ = 0;
  std::vector<Hash128> sent_;  // of its tiles

  std::mutex mutex_;
  std::condition_variable_any awake_;
  std::optional<News> news_;
  std::jthread thread_;
};

}  // namespace scenec::runtime
