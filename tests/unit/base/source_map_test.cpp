#include "base/source_map.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace scenec {
namespace {

std::pair<std::uint32_t, std::uint32_t> place(const SourceMap& sources, FileId file,
                                              std::uint32_t offset) {
  const Position position = sources.position(file, offset);
  return {position.line, position.column};
}
using Place = std::pair<std::uint32_t, std::uint32_t>;

TEST(SourceMap, CountsLinesAndColumns) {
  SourceMap sources;
  const FileId file = sources.add("a.sdl", "one\ntwo\n\nfour");
  EXPECT_EQ(place(sources, file, 0), Place(1, 1));
  EXPECT_EQ(place(sources, file, 3), Place(1, 4));  // the line end belongs to its line
  EXPECT_EQ(place(sources, file, 4), Place(2, 1));
  EXPECT_EQ(place(sources, file, 8), Place(3, 1));
  EXPECT_EQ(place(sources, file, 9), Place(4, 1));
  EXPECT_EQ(place(sources, file, 13), Place(4, 5));
  EXPECT_EQ(place(sources, file, 4000), Place(4, 5));  // beyond the end: the end
  EXPECT_EQ(sources.path(file), "a.sdl");
  EXPECT_EQ(sources.line(file, 1), "one");
  EXPECT_EQ(sources.line(file, 3), "");
  EXPECT_EQ(sources.line(file, 4), "four");
  EXPECT_EQ(sources.line(file, 0), "");
  EXPECT_EQ(sources.line(file, 5), "");
  EXPECT_EQ(sources.text(Span{file, 4, 7}), "two");
  EXPECT_EQ(sources.text(Span{file, 11, 999}), "ur");
  EXPECT_EQ(sources.text(Span{file, 999, 1000}), "");
}

TEST(SourceMap, ColumnsCountCodePoints) {
  SourceMap sources;
  const std::string text = "let 木 = \"😀é\"; x";
  const FileId file = sources.add("a.sdl", text);
  const auto at = [&](std::string_view part) {
    return static_cast<std::uint32_t>(text.find(part));
  };
  EXPECT_EQ(place(sources, file, at("木")), Place(1, 5));
  EXPECT_EQ(place(sources, file, at("=")), Place(1, 7));
  EXPECT_EQ(place(sources, file, at("é")), Place(1, 11));
  EXPECT_EQ(place(sources, file, at("x")), Place(1, 15));
}

TEST(SourceMap, CarriageReturnsAndByteOrderMarksAreNotText) {
  SourceMap sources;
  const FileId file = sources.add("a.sdl", "\xef\xbb\xbfsdl 1;\r\nlet a = 1;\r\n");
  EXPECT_EQ(sources.line(file, 1), "sdl 1;");
  EXPECT_EQ(sources.line(file, 2), "let a = 1;");
  EXPECT_EQ(place(sources, file, 3), Place(1, 1));
  EXPECT_EQ(place(sources, file, 0), Place(1, 1));
  EXPECT_EQ(place(sources, file, 7), Place(1, 5));
  EXPECT_EQ(place(sources, file, 11), Place(2, 1));
}

TEST(SourceMap, EmptyFileHasAPlace) {
  SourceMap sources;
  const FileId file = sources.add("a.sdl", "");
  EXPECT_EQ(place(sources, file, 0), Place(1, 1));
  EXPECT_EQ(sources.line(file, 1), "");
  EXPECT_EQ(sources.text(file), "");
}

TEST(SourceMap, OwnerKeepsTheText) {
  SourceMap sources;
  auto owner = std::make_shared<const std::string>("kept");
  const FileId file = sources.add("a.sdl", std::string_view(*owner), owner);
  owner.reset();
  SourceMap moved = std::move(sources);
  EXPECT_EQ(moved.text(file), "kept");
}

// Columns in the block index agree with counting from the start of the line.
TEST(SourceMap, LongLinesCountRight) {
  SourceMap sources;
  std::string text = "first\n";
  for (int i = 0; i < 5000; ++i) text += i % 3 == 0 ? "木" : "a";
  const FileId file = sources.add("a.sdl", text);
  std::uint32_t column = 0;
  for (std::uint32_t at = 6; at < text.size(); ++at) {
    if ((static_cast<unsigned char>(text[at]) & 0xc0) == 0x80) continue;
    ++column;
    ASSERT_EQ(place(sources, file, at), Place(2, column));
  }
}

TEST(SourceMap, PlacesInAHugeLineAreCheap) {
  SourceMap sources;
  const FileId file = sources.add("a.sdl", std::string(64U << 20, 'x'));
  (void)sources.position(file, 0);  // builds the index
  const auto start = std::chrono::steady_clock::now();
  for (std::uint32_t i = 0; i < 1000; ++i) {
    ASSERT_EQ(place(sources, file, i * 67000), Place(1, i * 67000 + 1));
  }
  // Counting from the line start would walk 33 GB.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
}

TEST(SourceMap, IndexIsBuiltOnceByManyThreads) {
  SourceMap sources;
  std::string text;
  for (int i = 0; i < 10000; ++i) text += "line\n";
  const FileId file = sources.add("a.sdl", text);
  std::vector<std::jthread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] { EXPECT_EQ(place(sources, file, 5 * 777 + 2), Place(778, 3)); });
  }
}

// ---- derived files ------------------------------------------------------------------------------

struct Derived {
  SourceMap sources;
  FileId parent;
  FileId derived;

  Derived(std::string parent_text, std::string text, std::vector<DerivedRange> ranges)
      : parent(sources.add("scene.txt", std::move(parent_text))),
        derived(sources.add_derived(parent, std::move(text), std::move(ranges))) {}
  Span resolve(std::uint32_t begin, std::uint32_t end) const {
    return sources.resolve({derived, begin, end});
  }
  Span origin(std::uint32_t begin, std::uint32_t end) const { return {parent, begin, end}; }
};

TEST(DerivedFile, OrdinarySpansAreUnchanged) {
  SourceMap sources;
  const FileId file = sources.add("a.sdl", "text");
  EXPECT_EQ(sources.resolve({file, 1, 3}), (Span{file, 1, 3}));
  EXPECT_FALSE(sources.resolve({}).valid());
}

TEST(DerivedFile, NarrowestRangeDecides) {
  // parent:  0..100 is a group, 10..20 and 30..40 are items, 12..15 is a value of the first
  const Derived it(std::string(100, 'p'), std::string(100, 'd'),
                   {{10, 50, 10, 20}, {0, 90, 0, 100}, {60, 80, 30, 40}, {20, 30, 12, 15}});
  EXPECT_EQ(it.resolve(22, 25), it.origin(12, 15));
  EXPECT_EQ(it.resolve(22, 35), it.origin(10, 20));
  EXPECT_EQ(it.resolve(10, 12), it.origin(10, 20));
  EXPECT_EQ(it.resolve(40, 70), it.origin(0, 100));
  EXPECT_EQ(it.resolve(60, 80), it.origin(30, 40));
  EXPECT_EQ(it.resolve(52, 52), it.origin(0, 100));
  EXPECT_EQ(it.sources.path(it.derived), "scene.txt");
}

TEST(DerivedFile, SpansOutsideEveryRangeLandNearby) {
  const Derived it(std::string(100, 'p'), std::string(100, 'd'),
                   {{10, 20, 40, 50}, {30, 40, 60, 65}});
  EXPECT_EQ(it.resolve(25, 27), it.origin(40, 50));
  EXPECT_EQ(it.resolve(12, 35), it.origin(40, 50));
  EXPECT_EQ(it.resolve(0, 5), it.origin(0, 0));
  const Derived bare("parent", "derived", {});
  EXPECT_EQ(bare.resolve(3, 4), bare.origin(0, 0));
}

TEST(DerivedFile, CopiedTextKeepsItsExactPlaces) {
  const Derived it("radius 0.25e1 here", "radius = 0.25e1;", {{9, 15, 7, 13}});
  EXPECT_EQ(it.resolve(11, 13), it.origin(9, 11));
  EXPECT_EQ(it.resolve(9, 15), it.origin(7, 13));
}

TEST(DerivedFile, ChainsAreFollowed) {
  SourceMap sources;
  const FileId first = sources.add("scene.txt", std::string(50, 'a'));
  const FileId second = sources.add_derived(first, std::string(50, 'b'), {{0, 50, 5, 9}});
  const FileId third = sources.add_derived(second, std::string(50, 'c'), {{0, 50, 1, 2}});
  EXPECT_EQ(sources.resolve({third, 3, 4}), (Span{first, 5, 9}));
}

// The binary search finds what a search through all ranges finds.
TEST(DerivedFile, AgreesWithASearchThroughAll) {
  std::vector<DerivedRange> ranges;
  std::uint32_t id = 0;
  const auto split = [&](auto& self, std::uint32_t begin, std::uint32_t end, int depth) -> void {
    ranges.push_back({begin, end, id, id + 1});
    ++id;
    if (depth == 0 || end - begin < 6) return;
    const std::uint32_t third = (end - begin) / 3;
    self(self, begin, begin + third, depth - 1);
    self(self, begin + third, begin + 2 * third, depth - 1);
    self(self, begin + 2 * third, end - 1, depth - 1);
  };
  split(split, 0, 400, 4);
  const Derived it(std::string(1000, 'p'), std::string(400, 'd'), ranges);
  for (std::uint32_t begin = 0; begin < 400; ++begin) {
    for (std::uint32_t end = begin + 1; end <= 400; end += 3) {
      const DerivedRange* narrowest = nullptr;
      for (const DerivedRange& range : ranges) {
        const bool holds = range.begin <= begin && end <= range.end;
        if (holds && (narrowest == nullptr ||
                      range.end - range.begin <= narrowest->end - narrowest->begin)) {
          narrowest = &range;
        }
      }
      ASSERT_NE(narrowest, nullptr);
      ASSERT_EQ(it.resolve(begin, end), it.origin(narrowest->origin_begin, narrowest->origin_end));
    }
  }
}

}  // namespace
}  // namespace scenec
