#include "base/hash.hpp"

#define XXH_STATIC_LINKING_ONLY  // the size of the state, so that it needs no second allocation
#include <xxhash.h>

#include <bit>
#include <utility>

#include "base/assert.hpp"

namespace scenec {

static_assert(std::endian::native == std::endian::little, "hashed values are fed little-endian");

namespace {

Hash128 from_xxh(XXH128_hash_t hash) {
  return {hash.low64, hash.high64};
}

}  // namespace

std::string Hash128::hex() const {
  static constexpr std::string_view digits = "0123456789abcdef";
  std::string text(32, '0');
  for (unsigned i = 0; i < 16; ++i) {
    text[15 - i] = digits[(high >> (4 * i)) & 15];
    text[31 - i] = digits[(low >> (4 * i)) & 15];
  }
  return text;
}

Hash128 hash_bytes(std::string_view bytes) {
  return from_xxh(XXH3_128bits(bytes.data(), bytes.size()));
}

struct Hasher::State {
  XXH3_state_t xxh;
};

Hasher::Hasher() : state_(std::make_unique<State>()) {
  const XXH_errorcode code = XXH3_128bits_reset(&state_->xxh);
  SCENEC_ASSERT(code == XXH_OK);
}
Hasher::~Hasher() = default;
Hasher::Hasher(Hasher&&) noexcept = default;
Hasher& Hasher::operator=(Hasher&&) noexcept = default;

void Hasher::flush() {
  const XXH_errorcode code = XXH3_128bits_update(&state_->xxh, gather_.data(), gathered_);
  SCENEC_ASSERT(code == XXH_OK);
  gathered_ = 0;
}

void Hasher::raw(const void* data, std::size_t size) {
  if (size == 0) return;
  flush();
  const XXH_errorcode code = XXH3_128bits_update(&state_->xxh, data, size);
  SCENEC_ASSERT(code == XXH_OK);
}

void Hasher::add(std::string_view text) {
  add(text.size());
  raw(text.data(), text.size());
}

void Hasher::add(Hash128 value) {
  add(value.low);
  add(value.high);
}

Hash128 Hasher::result() const {
  XXH3_state_t rest = state_->xxh;
  const XXH_errorcode code = XXH3_128bits_update(&rest, gather_.data(), gathered_);
  SCENEC_ASSERT(code == XXH_OK);
  return from_xxh(XXH3_128bits_digest(&rest));
}

}  // namespace scenec
