#include "backend/second_look.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "backend/film/lineup.hpp"

namespace scenec::backend {
namespace {

constexpr std::int64_t cell_side = 8;
// From level to level fewer cells, those with the most evidence so far, get more peers. Of a large
// picture 1/8, 1/16, ... of the area, so that a level costs no more than half the picture did; no
// fewer than that many cells, so that small pictures are looked at as closely.
struct Level {
  std::size_t peers;
  std::size_t part;
};
constexpr Level levels[] = {{4, 8}, {8, 16}, {16, 32}, {32, 64}, {64, 128}, {128, 256}};
constexpr std::size_t fewest_cells = 8;
// With fewer, what is there need not show yet.
constexpr std::size_t enough_peers = 16;

struct Cell {
  ir::Region place;
  double suspicion = 0;
  std::vector<float> values;
  std::vector<std::vector<float>> peers;
};

std::vector<ir::Region> cells_of(std::size_t width, std::size_t height) {
  std::vector<ir::Region> cells;
  const auto right = static_cast<std::int64_t>(width);
  const auto bottom = static_cast<std::int64_t>(height);
  for (std::int64_t y = 0; y < bottom; y += cell_side)
    for (std::int64_t x = 0; x < right; x += cell_side)
      cells.push_back({x, y, std::min(x + cell_side, right), std::min(y + cell_side, bottom)});
  return cells;
}

std::size_t kept_of(const Level& level, std::size_t cells) {
  return std::min(cells, std::max(fewest_cells, cells / level.part));
}

// The most suspicious first; of equals the first.
void keep_worst(std::vector<Cell>& cells, std::size_t count) {
  std::stable_sort(cells.begin(), cells.end(),
                   [](const Cell& a, const Cell& b) { return a.suspicion > b.suspicion; });
  cells.resize(std::min(cells.size(), count));
}

// False when it was stopped.
bool add_peers(std::vector<Cell>& cells, std::size_t peers, ThreadPool& pool,
               const RenderPeer& render) {
  std::atomic<bool> cut{false};
  pool.for_each(cells.size(), [&](std::size_t i, unsigned) {
    Cell& cell = cells[i];
    while (cell.peers.size() < peers && !cut.load(std::memory_order_relaxed)) {
      auto values = render(cell.place, cell.peers.size());
      if (values)
        cell.peers.push_back(std::move(*values));
      else
        cut.store(true, std::memory_order_relaxed);
    }
  });
  return !cut.load();
}

// Of the channel in which the means are furthest apart, in standard deviations of a peer's mean.
Disagreement disagreement_of(const Cell& cell) {
  Disagreement worst;
  worst.place = cell.place;
  worst.log_p = std::min(0.0, -std::log(cell.suspicion));
  const double pixels = static_cast<double>(cell.values.size()) / 3;
  const auto mean_of = [&](const std::vector<float>& values, std::size_t c) {
    double sum = 0;
    for (std::size_t i = c; i < values.size(); i += 3) sum += static_cast<double>(values[i]);
    return sum / pixels;
  };
  const auto count = static_cast<double>(cell.peers.size());
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = 0;
    double squares = 0;
    for (const auto& peer : cell.peers) {
      const double mean = mean_of(peer, c);
      sum += mean / count;
      squares += mean * mean / count;
    }
    const double own = mean_of(cell.values, c);
    const double variance = std::max(0.0, squares - sum * sum) * count / (count - 1);
    const double off = std::abs(own - sum) / std::sqrt(variance);
    if (c > 0 && !(off > worst.deviations)) continue;
    worst.channel = c;
    worst.first = own;
    worst.second = sum;
    worst.deviations = off > 0 ? off : 0;
  }
  return worst;
}

}  // namespace

std::int64_t second_look_pixels(std::size_t width, std::size_t height) {
  const std::size_t cells = cells_of(width, height).size();
  std::size_t sum = 0;
  std::size_t before = 0;
  for (const Level& level : levels) {
    sum += kept_of(level, cells) * (level.peers - before);
    before = level.peers;
  }
  return static_cast<std::int64_t>(sum) * cell_side * cell_side;
}

std::optional<Agreement> second_look(const NoisyPicture& picture, const NoisyPicture& other,
                                     ThreadPool& pool, const RenderPeer& render) {
  const std::vector<ir::Region> places = cells_of(picture.width, picture.height);
  const std::vector<double> suspicions = suspicions_of(picture, other, places);
  std::vector<Cell> cells(places.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    cells[i] = {places[i], suspicions[i], part_of(picture, places[i]).rgb, {}};
  Agreement all;
  all.tests = places.size();
  for (const Level& level : levels) {
    keep_worst(cells, kept_of(level, places.size()));
    if (!add_peers(cells, level.peers, pool, render)) return std::nullopt;
    pool.for_each(cells.size(), [&](std::size_t i, unsigned) {
      Cell& cell = cells[i];
      cell.suspicion = evidence_against(cell.values, cell.peers,
                                        static_cast<std::size_t>(cell.place.x1 - cell.place.x0),
                                        picture.rounding);
    });
    std::vector<double> evidence;
    for (const Cell& cell : cells) evidence.push_back(cell.suspicion);
    all.log_p = log_p_of_evidence(evidence, places.size());
    // Not even for those cells alone: more peers would only show that nothing is there.
    if (level.peers >= enough_peers && !(log_p_of_evidence(evidence, evidence.size()) < 0))
      return all;
  }
  for (const Cell& cell : cells) add_finding(all, disagreement_of(cell));
  return all;
}

}  // namespace scenec::backend
