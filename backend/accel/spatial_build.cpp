#include "backend/accel/spatial_build.hpp"

#include <algorithm>
#include <array>

namespace scenec::backend {
namespace {

constexpr int max_slices = 16;
[[nodiscard]] int slices_for(std::size_t count) {
  return count < 512 ? 8 : max_slices;
}
// Sides that overlap by less than this share of the whole are not worth a look (measured: below it
// rays gain nothing and the build takes longer).
constexpr float overlap_worth = 1e-3F;

float blocks_of(std::size_t count, std::uint32_t width) {
  return static_cast<float>((count + width - 1) / width);
}

float overlap_area(const FloatBox& a, const FloatBox& b) {
  const FloatBox both{max_of(a.min, b.min), min_of(a.max, b.max)};
  for (int k = 0; k < 3; ++k)
    if (!(both.min[k] <= both.max[k])) return 0;
  return both.half_area();
}

struct Plane {
  int axis = -1;
  float at = 0;
  float cost = FloatBox::infinity;
};

// Equal slices of the box along one axis.
struct Slices {
  int axis;
  int count;
  float low;
  float size;
  float inverse;

  Slices(const FloatBox& box, int k, int n)
      : axis(k),
        count(n),
        low(box.min[k]),
        size((box.max[k] - box.min[k]) / static_cast<float>(n)),
        inverse(1 / size) {}
  [[nodiscard]] bool usable() const {
    return size > 0 && low + size > low && inverse < FloatBox::infinity;
  }
  [[nodiscard]] float plane(int slice) const { return low + size * static_cast<float>(slice); }
  [[nodiscard]] int of(float x) const {
    return std::clamp(static_cast<int>((x - low) * inverse), 0, count - 1);
  }
};

struct SliceBins {
  std::array<FloatBox, max_slices> boxes;
  std::array<std::size_t, max_slices> begin{};
  std::array<std::size_t, max_slices> end{};
};

void add(const BuildRef& ref, const Slices& slices, const RefSplitter& splitter, SliceBins& bins) {
  const int first = slices.of(ref.min[slices.axis]);
  const int last = slices.of(ref.max[slices.axis]);
  ++bins.begin[static_cast<std::size_t>(first)];
  ++bins.end[static_cast<std::size_t>(last)];
  if (first == last) {
    bins.boxes[static_cast<std::size_t>(first)].grow(box_of(ref));
    return;
  }
  BuildRef rest = ref;
  for (int i = first; i < last; ++i) {
    const float plane = slices.plane(i + 1);
    if (!(plane > rest.min[slices.axis] && plane < rest.max[slices.axis])) continue;
    BuildRef low;
    BuildRef high;
    splitter.split(rest, slices.axis, plane, low, high);
    bins.boxes[static_cast<std::size_t>(i)].grow(box_of(low));
    rest = high;
  }
  bins.boxes[static_cast<std::size_t>(last)].grow(box_of(rest));
}

void try_axis(const std::vector<BuildRef>& refs, const FloatBox& box, int axis,
              const BuildSettings& settings, Plane& best) {
  const Slices slices(box, axis, slices_for(refs.size()));
  if (!slices.usable()) return;
  SliceBins bins;
  for (const BuildRef& ref : refs) add(ref, slices, *settings.splitter, bins);
  std::array<float, max_slices> right_cost{};
  FloatBox side;
  std::size_t count = 0;
  const auto last = static_cast<std::size_t>(slices.count) - 1;
  for (std::size_t i = last; i > 0; --i) {
    side.grow(bins.boxes[i]);
    count += bins.end[i];
    right_cost[i] = side.empty() ? 0 : side.half_area() * blocks_of(count, settings.block_width);
  }
  side = {};
  count = 0;
  for (std::size_t i = 0; i < last; ++i) {
    side.grow(bins.boxes[i]);
    count += bins.begin[i];
    if (count == 0 || side.empty()) continue;
    const float cost =
        side.half_area() * blocks_of(count, settings.block_width) + right_cost[i + 1];
    if (cost < best.cost) best = {axis, slices.plane(static_cast<int>(i) + 1), cost};
  }
}

struct Cut {
  const BuildRef* whole;
  BuildRef low;
  BuildRef high;
};

// The references that lie on one side go there; the others are cut.
std::vector<Cut> sort_by_side(const SpatialRange& range, const BuildSettings& settings,
                              const Plane& plane, SpatialRange& left, SpatialRange& right) {
  std::vector<Cut> cuts;
  for (const BuildRef& ref : range.refs) {
    if (ref.max[plane.axis] <= plane.at) {
      left.refs.push_back(ref);
    } else if (ref.min[plane.axis] >= plane.at) {
      right.refs.push_back(ref);
    } else {
      Cut& cut = cuts.emplace_back();
      cut.whole = &ref;
      settings.splitter->split(ref, plane.axis, plane.at, cut.low, cut.high);
    }
  }
  return cuts;
}

// Puts every reference left, right, or, cut, on both sides while there are references to spare;
// false when it leaves a side empty or costs more than `worth`.
bool divide(const SpatialRange& range, const BuildSettings& settings, const Plane& plane,
            float worth, SpatialRange& left, SpatialRange& right) {
  const std::vector<Cut> cuts = sort_by_side(range, settings, plane, left, right);
  FloatBox left_box = box_of(left.refs);
  FloatBox right_box = box_of(right.refs);
  for (const Cut& cut : cuts) {
    left_box.grow(box_of(cut.low));
    right_box.grow(box_of(cut.high));
  }
  if (left_box.empty() || right_box.empty()) return false;
  auto n_left = static_cast<float>(left.refs.size() + cuts.size());
  auto n_right = static_cast<float>(right.refs.size() + cuts.size());
  std::size_t spare = range.extra;
  for (const Cut& cut : cuts) {
    FloatBox left_with = left_box;
    FloatBox right_with = right_box;
    left_with.grow(box_of(*cut.whole));
    right_with.grow(box_of(*cut.whole));
    const float left_area = left_box.half_area();
    const float right_area = right_box.half_area();
    const float both = left_area * n_left + right_area * n_right;
    const float only_left = left_with.half_area() * n_left + right_area * (n_right - 1);
    const float only_right = left_area * (n_left - 1) + right_with.half_area() * n_right;
    if (spare > 0 && both < only_left && both < only_right) {
      left.refs.push_back(cut.low);
      right.refs.push_back(cut.high);
      --spare;
    } else if (only_left <= only_right) {
      left.refs.push_back(*cut.whole);
      left_box = left_with;
      n_right -= 1;
    } else {
      right.refs.push_back(*cut.whole);
      right_box = right_with;
      n_left -= 1;
    }
  }
  if (left.refs.empty() || right.refs.empty() || left.refs.size() >= range.refs.size() ||
      right.refs.size() >= range.refs.size())
    return false;
  return left_box.half_area() * blocks_of(left.refs.size(), settings.block_width) +
             right_box.half_area() * blocks_of(right.refs.size(), settings.block_width) <
         worth;
}

void share_extra(const SpatialRange& range, SpatialRange& left, SpatialRange& right) {
  const std::size_t total = left.refs.size() + right.refs.size();
  const std::size_t rest = range.extra - (total - range.refs.size());
  left.extra =
      static_cast<std::size_t>(static_cast<double>(rest) * static_cast<double>(left.refs.size()) /
                               static_cast<double>(total));
  right.extra = rest - left.extra;
  left.depth = right.depth = range.depth + 1;
}

void split_by_objects(SpatialRange& range, const BuildRange& whole, const ObjectSplit& object,
                      SpatialRange& left, SpatialRange& right) {
  std::size_t count = range.refs.size() / 2;
  FloatBox unused;
  if (object.axis >= 0) count = partition_run(range.refs, whole, object, unused, unused);
  const auto middle = range.refs.begin() + static_cast<std::ptrdiff_t>(count);
  left.refs.assign(range.refs.begin(), middle);
  right.refs.assign(middle, range.refs.end());
}

}  // namespace

FloatBox box_of(const std::vector<BuildRef>& refs) {
  FloatBox box;
  for (const BuildRef& ref : refs) box.grow(box_of(ref));
  return box;
}

bool split_spatially(SpatialRange& range, const BuildSettings& settings, float root_area,
                     SpatialRange& left, SpatialRange& right) {
  if (range.refs.size() <= settings.block_width) return false;
  BuildRange whole = whole_range(range.refs);
  whole.depth = range.depth;
  ObjectSplit object;
  if (range.depth < depth_of_heuristic) {
    object = best_object_split(range.refs, whole, settings.block_width);
    Plane plane;
    // Where all centroids are one, cutting parts nothing: each side gets a piece of every entry.
    if (range.extra > 0 && object.axis >= 0 &&
        overlap_area(object.left, object.right) > overlap_worth * root_area) {
      for (int axis = 0; axis < 3; ++axis) try_axis(range.refs, whole.box, axis, settings, plane);
    }
    if (plane.cost < object.cost && divide(range, settings, plane, object.cost, left, right)) {
      share_extra(range, left, right);
      range.refs = std::vector<BuildRef>();
      return true;
    }
    left.refs.clear();
    right.refs.clear();
  }
  split_by_objects(range, whole, object, left, right);
  share_extra(range, left, right);
  range.refs = std::vector<BuildRef>();
  return true;
}

namespace {

// Recursive: the depth is bounded by max_binary_depth.
void build_below(SpatialRange& range, const BuildSettings& settings, float root_area,
                 std::vector<BinaryNode>& tree, std::vector<BuildRef>& refs) {
  const std::size_t self = tree.size();
  const std::size_t first = refs.size();
  tree.push_back({box_of(range.refs), static_cast<std::uint32_t>(first), 0, 0});
  SpatialRange left;
  SpatialRange right;
  if (split_spatially(range, settings, root_area, left, right)) {
    build_below(left, settings, root_area, tree, refs);
    tree[self].second = static_cast<std::uint32_t>(tree.size());
    build_below(right, settings, root_area, tree, refs);
  } else {
    refs.insert(refs.end(), range.refs.begin(), range.refs.end());
  }
  tree[self].count = static_cast<std::uint32_t>(refs.size() - first);
}

}  // namespace

std::vector<BinaryNode> build_binary_spatially(SpatialRange range, const BuildSettings& settings,
                                               float root_area, std::vector<BuildRef>& refs) {
  std::vector<BinaryNode> tree;
  build_below(range, settings, root_area, tree, refs);
  return tree;
}

}  // namespace scenec::backend
