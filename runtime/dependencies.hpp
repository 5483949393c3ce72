// `-MD -MF -MT -MP`: the files a run looked at, in the form make and ninja read.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_system.hpp"
#include "runtime/options.hpp"

namespace scenec::runtime {

// What the dependency options lack or contradict.
[[nodiscard]] std::optional<std::string> find_dependency_problem(const Options& options);
// `-MF`, or the output's name with the extension `.d`.
[[nodiscard]] std::string dependency_file_of(const Options& options);
// `-MT`, or the output.
[[nodiscard]] std::vector<std::string> dependency_targets_of(const Options& options);

// What the runs of one `--frames` put into one dependency file.
struct SharedDependencies {
  std::vector<std::string> targets;  // the pictures of all frames, or `-MT`
  std::vector<FileRecord> files;     // in order of their first use
  bool written = false;
  // Adds what is new; whether there was any.
  bool join(const std::vector<FileRecord>& records);
};

struct DependencyRule {
  std::vector<std::string> targets;
  std::string scene;
  std::vector<FileRecord> files;
  bool phony = false;     // an empty rule for every file but the scene
  bool complete = false;  // the run found nothing wrong
};
// The rule as text; else the name that no dependency file can hold (one with a line end). A file
// that was missed counts while something is wrong: it may be the one whose appearance mends it.
// Each gets an empty rule, for make would stop at the missing file instead of trying again. After a
// good run misses are places that were searched in vain; they would keep a target out of date.
[[nodiscard]] Result<std::string, std::string> dependency_text(const DependencyRule& rule);

}  // namespace scenec::runtime
