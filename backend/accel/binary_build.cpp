#include "backend/accel/binary_build.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace scenec::backend {
namespace {

constexpr int max_bins = 32;

struct Bins {
  std::array<std::array<FloatBox, max_bins>, 3> boxes;
  std::array<std::array<std::uint32_t, max_bins>, 3> counts;
};

// From doubled centres to numbers of bins, an axis at a time.
struct Binning {
  int bins;
  Float4 low;
  Float4 scale;  // 0 on an axis without extent

  Binning(const BuildRange& range) : bins(bins_for(range.count)), low(range.centers.min), scale{} {
    const Float4 extent = range.centers.max - range.centers.min;
    for (int k = 0; k < 3; ++k) {
      // Just below the number of bins, so that the last centre falls into the last bin.
      const float s = static_cast<float>(bins) * 0.999999F / extent[k];
      scale[k] = extent[k] > 0 && std::isfinite(s) ? s : 0;
    }
  }
  [[nodiscard]] Int4 of(Float4 center) const {
    return __builtin_convertvector((center - low) * scale, Int4);
  }

 private:
  static int bins_for(std::size_t count) {
    return static_cast<int>(std::min<std::size_t>(max_bins, 8 + count / 16));
  }
};

void fill(std::span<const BuildRef> refs, const Binning& binning, Bins& bins) {
  const auto count = static_cast<std::size_t>(binning.bins);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::fill_n(bins.boxes[axis].begin(), count, FloatBox{});
    std::fill_n(bins.counts[axis].begin(), count, 0U);
  }
  for (const BuildRef& ref : refs) {
    const FloatBox box = box_of(ref);
    const Int4 bin = binning.of(center_of(box));
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const auto b = static_cast<std::size_t>(bin[axis]);
      bins.boxes[a][b].grow(box);
      ++bins.counts[a][b];
    }
  }
}

float blocks_of(std::size_t count, std::uint32_t width) {
  return static_cast<float>((count + width - 1) / width);
}

void try_axis(const Bins& bins, const Binning& binning, int axis, std::size_t total,
              std::uint32_t width, ObjectSplit& best) {
  if (binning.scale[axis] == 0) return;
  const auto a = static_cast<std::size_t>(axis);
  std::array<float, max_bins> right_cost{};
  FloatBox side;
  std::size_t count = 0;
  const auto last = static_cast<std::size_t>(binning.bins) - 1;
  for (std::size_t i = last; i > 0; --i) {
    side.grow(bins.boxes[a][i]);
    count += bins.counts[a][i];
    right_cost[i] = count == 0 ? 0 : side.half_area() * blocks_of(count, width);
  }
  side = {};
  count = 0;
  for (std::size_t i = 0; i < last; ++i) {
    side.grow(bins.boxes[a][i]);
    count += bins.counts[a][i];
    if (count == 0 || count == total) continue;
    const float cost = side.half_area() * blocks_of(count, width) + right_cost[i + 1];
    if (cost < best.cost) {
      best.axis = axis;
      best.bin = static_cast<int>(i);
      best.cost = cost;
    }
  }
}

void measure(std::span<const BuildRef> refs, BuildRange& range) {
  range.box = {};
  range.centers = {};
  for (const BuildRef& ref : refs) {
    const FloatBox box = box_of(ref);
    range.box.grow(box);
    range.centers.grow(center_of(box));
  }
}

void halve(std::span<const BuildRef> refs, const BuildRange& range, BuildRange& left,
           BuildRange& right) {
  left = {range.first, range.count / 2, range.depth + 1, {}, {}};
  right = {range.first + left.count, range.count - left.count, range.depth + 1, {}, {}};
  measure(refs.subspan(left.first, left.count), left);
  measure(refs.subspan(right.first, right.count), right);
}

}  // namespace

BuildRange whole_range(std::span<const BuildRef> refs) {
  BuildRange range{0, refs.size(), 0, {}, {}};
  measure(refs, range);
  return range;
}

bool split_range(std::span<BuildRef> refs, const BuildRange& range, const BuildSettings& settings,
                 BuildRange& left, BuildRange& right) {
  if (range.count <= settings.block_width) return false;
  const std::span<BuildRef> own = refs.subspan(range.first, range.count);
  if (range.depth >= depth_of_heuristic) {
    halve(refs, range, left, right);
    return true;
  }
  const ObjectSplit best = best_object_split(own, range, settings.block_width);
  if (best.axis < 0) {
    halve(refs, range, left, right);
    return true;
  }
  left = {range.first, 0, range.depth + 1, best.left, {}};
  right = {0, 0, range.depth + 1, best.right, {}};
  left.count = partition_run(own, range, best, left.centers, right.centers);
  right.first = range.first + left.count;
  right.count = range.count - left.count;
  return true;
}

ObjectSplit best_object_split(std::span<const BuildRef> refs, const BuildRange& range,
                              std::uint32_t block_width) {
  const Binning binning(range);
  Bins bins;
  fill(refs, binning, bins);
  ObjectSplit best;
  best.bins = binning.bins;
  for (int axis = 0; axis < 3; ++axis)
    try_axis(bins, binning, axis, range.count, block_width, best);
  if (best.axis < 0) return best;
  const auto& boxes = bins.boxes[static_cast<std::size_t>(best.axis)];
  for (int i = 0; i < binning.bins; ++i)
    (i <= best.bin ? best.left : best.right).grow(boxes[static_cast<std::size_t>(i)]);
  return best;
}

std::size_t partition_run(std::span<BuildRef> refs, const BuildRange& range,
                          const ObjectSplit& split, FloatBox& left_centers,
                          FloatBox& right_centers) {
  const Binning binning(range);
  std::size_t i = 0;
  std::size_t j = refs.size();
  while (i < j) {
    const Float4 center = center_of(box_of(refs[i]));
    if (binning.of(center)[split.axis] <= split.bin) {
      left_centers.grow(center);
      ++i;
    } else {
      right_centers.grow(center);
      std::swap(refs[i], refs[--j]);
    }
  }
  return i;
}

namespace {

// Recursive: the depth is bounded by max_binary_depth.
void build_below(std::span<BuildRef> refs, const BuildRange& range, const BuildSettings& settings,
                 std::vector<BinaryNode>& out) {
  const std::size_t self = out.size();
  out.push_back({range.box, static_cast<std::uint32_t>(range.first),
                 static_cast<std::uint32_t>(range.count), 0});
  BuildRange left;
  BuildRange right;
  if (!split_range(refs, range, settings, left, right)) return;
  build_below(refs, left, settings, out);
  out[self].second = static_cast<std::uint32_t>(out.size());
  build_below(refs, right, settings, out);
}

}  // namespace

std::vector<BinaryNode> build_binary(std::span<BuildRef> refs, const BuildRange& range,
                                     const BuildSettings& settings) {
  std::vector<BinaryNode> tree;
  tree.reserve(2 * range.count / settings.block_width + 16);
  build_below(refs, range, settings, tree);
  return tree;
}

}  // namespace scenec::backend
