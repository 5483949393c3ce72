// Ways to damage a small valid file: every prefix, random byte changes. The reader must answer with
// a value or a problem; crashes and hangs are for the sanitizers and the test's time limit to see.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iostream>
#include <memory>
#include <random>
#include <string>
#include <string_view>

namespace scenec::test {

// An exact-size heap copy, so that the address sanitizer sees a read behind the end.
class ExactCopy {
 public:
  explicit ExactCopy(std::string_view bytes)
      : size_(bytes.size()), data_(std::make_unique<char[]>(size_)) {
    bytes.copy(data_.get(), size_);
  }
  [[nodiscard]] std::string_view view() const { return {data_.get(), size_}; }

 private:
  std::size_t size_;
  std::unique_ptr<char[]> data_;
};

// Calls read(prefix) for every proper prefix; returns how many gave a value.
template <class Read>
std::size_t read_every_prefix(std::string_view bytes, Read read) {
  std::size_t accepted = 0;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const ExactCopy copy(bytes.substr(0, size));
    if (read(copy.view())) ++accepted;
  }
  return accepted;
}

template <class Read>
void read_with_random_damage(std::string_view bytes, std::uint32_t seed, int rounds, Read read) {
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  for (int round = 0; round < rounds; ++round) {
    std::string damaged(bytes);
    const std::uint32_t changes = 1 + random() % 4;
    for (std::uint32_t i = 0; i < changes; ++i) {
      const std::size_t at = random() % damaged.size();
      switch (random() % 4) {
        case 0:
          damaged[at] = static_cast<char>(random());
          break;
        case 1:
          damaged[at] = static_cast<char>(damaged[at] ^ (1 << random() % 8));
          break;
        case 2:
          damaged.erase(at, 1 + random() % 8);
          break;
        default:
          damaged.insert(at, damaged.substr(random() % damaged.size(), random() % 16));
          break;
      }
      if (damaged.empty()) damaged = "x";
    }
    const ExactCopy copy(damaged);
    static_cast<void>(read(copy.view()));
  }
}

}  // namespace scenec::test
