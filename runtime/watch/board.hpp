// What pages are to show, newest first and only: the state of every scene (JSON) and its picture.
// The render thread puts, the server takes; nobody waits for the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace scenec::runtime {

class Board {
 public:
  using Bytes = std::shared_ptr<const std::string>;
  struct Slot {
    Bytes state;
    std::uint64_t state_version = 0;  // 0: nothing yet
    Bytes frame;
    std::uint64_t frame_version = 0;
    int viewers = 0;
  };

  explicit Board(std::size_t scenes) : slots_(scenes) {}
  [[nodiscard]] std::size_t size() const { return slots_.size(); }

  void put_state(std::size_t scene, std::string state) {
    change([&] {
      slots_[scene].state = std::make_shared<const std::string>(std::move(state));
      slots_[scene].state_version = ++version_;
    });
  }
  void put_frame(std::size_t scene, std::string frame) {
    change([&] {
      slots_[scene].frame = std::make_shared<const std::string>(std::move(frame));
      slots_[scene].frame_version = ++version_;
    });
  }
  void add_viewers(std::size_t scene, int count) {
    const std::lock_guard lock(mutex_);
    slots_[scene].viewers += count;
  }
  [[nodiscard]] Slot slot(std::size_t scene) const {
    const std::lock_guard lock(mutex_);
    return slots_[scene];
  }

  // Called after every change, on the thread that made it.
  void on_change(std::function<void()> listener) {
    const std::lock_guard lock(mutex_);
    listener_ = std::move(listener);
  }

 private:
  template <class F>
  void change(F&& f) {
    std::function<void()> listener;
    {
      const std::lock_guard lock(mutex_);
      f();
      listener = listener_;
    }
    if (listener) listener();
  }

  mutable std::mutex mutex_;
  std::vector<Slot> slots_;
  std::uint64_t version_ = 0;
  std::function<void()> listener_;
};

}  // namespace scenec::runtime
