#include "runtime/watch/settle.hpp"

#include <algorithm>
#include <utility>

#include "base/assert.hpp"

namespace scenec::runtime {

void Settle::touch(const std::string& path, Touch touch, Time now) {
  if (!first_) first_ = now;
  last_ = now;
  paths_.insert(path);
  if (touch == Touch::writing) {
    writing_.insert(path);
  } else {
    writing_.erase(path);
  }
  if (touch == Touch::missing) {
    missing_.insert(path);
  } else {
    missing_.erase(path);
  }
}

Settle::Duration Settle::quiet() const {
  const bool wide = paths_.size() > 1 || last_was_wide_ || !missing_.empty();
  return wide ? limits_.quiet_after_burst : limits_.quiet;
}

std::optional<Settle::Time> Settle::deadline() const {
  if (!first_) return std::nullopt;
  const Time latest = *first_ + limits_.most;
  if (!writing_.empty()) return latest;
  return std::min(latest, last_ + quiet());
}

Settle::Burst Settle::take(Time now) {
  SCENEC_ASSERT(first_.has_value());
  Burst burst{.paths = {}, .first = *first_, .last = last_};
  burst.forced = !writing_.empty() || now < last_ + quiet();
  burst.paths = std::exchange(paths_, {});
  last_was_wide_ = burst.paths.size() > 1;
  writing_.clear();
  missing_.clear();
  first_.reset();
  return burst;
}

}  // namespace scenec::runtime
