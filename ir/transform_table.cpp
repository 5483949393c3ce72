#include "ir/transform_table.hpp"

#include <algorithm>

namespace scenec::ir {

namespace {

constexpr std::size_t last_row = 12;

bool is_affine(const Transform& transform) {
  const auto& m = transform.m;
  return m[12] == 0 && m[13] == 0 && m[14] == 0 && m[15] == 1;
}

bool is_move(const Transform& transform) {
  const auto& m = transform.m;
  return m[0] == 1 && m[1] == 0 && m[2] == 0 && m[4] == 0 && m[5] == 1 && m[6] == 0 && m[8] == 0 &&
         m[9] == 0 && m[10] == 1;
}

}  // namespace

TransformTable::id_type TransformTable::push(const Transform& transform) {
  SCENEC_ASSERT(is_affine(transform) && places_.size() < 0x7FFFFFFFu);
  const auto& m = transform.m;
  if (is_move(transform)) {
    places_.push_back(static_cast<std::uint32_t>(moves_.size()) << 1);
    moves_.push({m[3] + 0.0, m[7] + 0.0, m[11] + 0.0});
  } else {
    places_.push_back(static_cast<std::uint32_t>(rows_.size()) << 1 | 1u);
    Rows rows;
    for (std::size_t i = 0; i < last_row; ++i) rows[i] = m[i] + 0.0;
    rows_.push(rows);
  }
  return id_type(static_cast<std::uint32_t>(places_.size() - 1));
}

Transform TransformTable::operator[](id_type id) const {
  SCENEC_ASSERT(id.value() < places_.size());
  const std::uint32_t place = places_[id.value()];
  Transform transform;
  if ((place & 1u) == 0) {
    const Move& move = moves_[place >> 1];
    for (std::size_t axis = 0; axis < 3; ++axis) transform.m[4 * axis + 3] = move[axis];
  } else {
    std::copy_n(rows_[place >> 1].begin(), last_row, transform.m.begin());
  }
  return transform;
}

bool TransformTable::holds(id_type id, const Transform& transform) const {
  const std::uint32_t place = places_[id.value()];
  const auto& m = transform.m;
  if ((place & 1u) != 0) {
    const Rows& rows = rows_[place >> 1];
    return std::equal(rows.begin(), rows.end(), m.begin());
  }
  const Move& move = moves_[place >> 1];
  return move[0] == m[3] && move[1] == m[7] && move[2] == m[11] && is_move(transform);
}

}  // namespace scenec::ir
