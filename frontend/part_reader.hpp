// The tree of a native text, whole or in parts: a large text is cut between its top-level items,
// parsed ahead of its reader by the threads of a pool, and given back part by part.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/parallel.hpp"
#include "base/work_clock.hpp"
#include "grammar/parse.hpp"
#include "grammar/split.hpp"
#include "grammar/syntax_tree.hpp"

namespace scenec::frontend {

// Hands out the trees that together are one file, in the order of the text.
class TreeSource {
 public:
  virtual ~TreeSource() = default;
  // The next tree; nullptr behind the last. What was handed out before is gone, unless it was kept.
  [[nodiscard]] virtual const grammar::SyntaxTree* next() = 0;
  // The tree handed out last stays as long as the source: something refers to its nodes.
  virtual void keep() = 0;
};

class WholeTree final : public TreeSource {
 public:
  explicit WholeTree(const grammar::SyntaxTree& tree) : tree_(&tree) {}
  const grammar::SyntaxTree* next() override { return std::exchange(tree_, nullptr); }
  void keep() override {}

 private:
  const grammar::SyntaxTree* tree_;
};

class PartReader final : public TreeSource {
 public:
  struct Input {
    FileId file;
    std::string_view text;
    std::size_t part_bytes = 0;  // the least size of a part
    // What the reader reports. An error ends the reading: the tree of the whole text may be needed
    // to say what it is.
    const DiagnosticSink& found;
    WorkClock* parsing = nullptr;  // of the reader: its own parsing and its waiting
  };
  explicit PartReader(const Input& input) : input_(input), splitter_(input.text) {}

  // Calls `read`, which takes the parts, on one thread of the pool while the others parse ahead.
  void run(ThreadPool& pool, const std::function<void()>& read);

  const grammar::SyntaxTree* next() override;
  void keep() override { keep_current_ = true; }
  // The text could not be cut, or a part of it has mistakes: only the whole text tells which.
  [[nodiscard]] bool failed() const { return failed_; }

 private:
  struct Part {
    std::unique_ptr<grammar::SyntaxTree> tree;
    bool ready = false;  // until then a thread parses it
    bool sound = false;
  };
  using Lock = std::unique_lock<std::mutex>;

  [[nodiscard]] bool parse_one(Lock& lock);
  void parse_ahead();
  void stop();

  Input input_;
  std::mutex mutex_;
  std::condition_variable changed_;
  grammar::ItemSplitter splitter_;
  std::deque<Part> parts_;  // cut and not handed out yet; references stay valid at both ends
  std::size_t window_ = 1;
  bool at_end_ = false;
  bool stopped_ = false;
  bool failed_ = false;
  bool keep_current_ = false;
  std::unique_ptr<grammar::SyntaxTree> current_;
  std::vector<std::unique_ptr<grammar::SyntaxTree>> kept_;
};

}  // namespace scenec::frontend
