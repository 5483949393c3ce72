// What the evaluator found at a place of the text, remembered by that place: a loop meets the same
// numerals and the same calls a million times. The table is direct-mapped:
// a new place takes the slot of an older one, so it neither grows nor needs forgetting.
// The texts outlive the evaluator (the SourceMap owns them), so an address is a place.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace scenec::frontend {

template <class T, std::size_t slots>
class SiteMemo {
  static_assert((slots & (slots - 1)) == 0);

 public:
  // What was put at this very place, or nullptr.
  [[nodiscard]] const T* find(const char* place) const {
    const Slot& slot = slots_[index(place)];
    return slot.place == place ? &slot.found : nullptr;
  }
  void put(const char* place, const T& found) { slots_[index(place)] = {place, found}; }

 private:
  struct Slot {
    const char* place = nullptr;
    T found{};
  };
  // Neighbouring places get different slots.
  [[nodiscard]] static std::size_t index(const char* place) {
    return reinterpret_cast<std::uintptr_t>(place) & (slots - 1);
  }
  std::array<Slot, slots> slots_{};
};

}  // namespace scenec::frontend
