#include "base/hash.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

namespace scenec {
namespace {

template <class... T>
Hash128 hash_of(const T&... values) {
  Hasher hasher;
  (hasher.add(values), ...);
  return hasher.result();
}

// These values are written into files; they may never change.
TEST(Hash, IsStable) {
  EXPECT_EQ(hash_bytes("").hex(), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(hash_bytes("scenec").hex(), "8f4ff4e684add0d4140ef672fd524c6c");
  EXPECT_EQ(hash_of(std::string_view("sphere"), 1.5, 7, true).hex(),
            "90634d10b12e1f0b56abc3ff84406dd0");
}

TEST(Hash, StreamingEqualsWhole) {
  std::string bytes;
  for (int i = 0; i < 5000; ++i) bytes += static_cast<char>(i * 31);
  for (const std::size_t step : {1UL, 7UL, 240UL, 1024UL, 4999UL}) {
    Hasher hasher;
    for (std::size_t at = 0; at < bytes.size(); at += step) {
      hasher.raw(bytes.data() + at, std::min(step, bytes.size() - at));
    }
    EXPECT_EQ(hasher.result(), hash_bytes(bytes)) << step;
  }
}

TEST(Hash, LengthsSeparateStrings) {
  EXPECT_NE(hash_of(std::string_view("ab"), std::string_view("c")),
            hash_of(std::string_view("a"), std::string_view("bc")));
  EXPECT_NE(hash_of(std::string_view("")), hash_of());
}

TEST(Hash, ZerosAreEqualAndNumbersAreNot) {
  EXPECT_EQ(hash_of(0.0), hash_of(-0.0));
  EXPECT_NE(hash_of(0.0), hash_of(std::numeric_limits<double>::denorm_min()));
  EXPECT_NE(hash_of(1.0), hash_of(std::nextafter(1.0, 2.0)));
}

TEST(Hash, IntegersOfEveryWidthAreFedAlike) {
  EXPECT_EQ(hash_of(std::uint8_t{7}), hash_of(std::int64_t{7}));
  EXPECT_NE(hash_of(7), hash_of(-7));
}

TEST(Hash, ResultDoesNotEndTheStream) {
  Hasher hasher;
  hasher.add(1);
  const Hash128 first = hasher.result();
  EXPECT_EQ(first, hasher.result());
  hasher.add(2);
  EXPECT_EQ(hasher.result(), hash_of(1, 2));
}

TEST(Hash, HexShowsTheHighWordFirst) {
  EXPECT_EQ((Hash128{.low = 0xfedcba9876543210, .high = 0x0123456789abcdef}.hex()),
            "0123456789abcdeffedcba9876543210");
  EXPECT_EQ(Hash128{}.hex(), std::string(32, '0'));
}

TEST(Hash, CountersDoNotCollide) {
  std::set<Hash128> seen;
  for (int i = 0; i < 20000; ++i) seen.insert(hash_of(i));
  EXPECT_EQ(seen.size(), 20000U);
}

}  // namespace
}  // namespace scenec
