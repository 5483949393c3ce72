#include "backend/accel/placements.hpp"

#include "base/assert.hpp"

namespace scenec::backend {
namespace {

constexpr std::size_t limit = 0x7fffffff;

bool is_move(const AffineRows& m) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (m[i][k] != (i == k ? 1 : 0)) return false;
  return true;
}

}  // namespace

Placements::Index Placements::add(const Transform& world_from_object) {
  if (world_from_object.is_identity()) return identity;
  SCENEC_ASSERT(moves_.size() < limit && others_.size() < limit);
  const AffineRows& m = world_from_object.rows();
  if (is_move(m)) {
    moves_.push({m[0][3], m[1][3], m[2][3]});
    return static_cast<Index>(2 * moves_.size() - 1);
  }
  others_.push(world_from_object);
  return static_cast<Index>(2 * others_.size());
}

bool Placements::holds(Index index) const {
  if (index == identity) return true;
  const std::size_t place = (index - 1) >> 1;
  return place < ((index & 1) != 0 ? moves_.size() : others_.size());
}

Transform Placements::operator[](Index index) const {
  if (index == identity) return {};
  const std::uint32_t place = (index - 1) >> 1;
  return (index & 1) != 0 ? Transform::translation(moves_[place]) : others_[place];
}

void Placements::feed(Hasher& hasher) const {
  hasher.add(moves_.size());
  for (std::size_t i = 0; i < moves_.size(); ++i) hasher.raw(&moves_[i], sizeof(Vector3));
  hasher.add(others_.size());
  for (std::size_t i = 0; i < others_.size(); ++i)
    hasher.raw(&others_[i].rows(), sizeof(AffineRows));
}

}  // namespace scenec::backend
