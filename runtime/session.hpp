// One run of the compiler: the recording file system, the texts that were read and the diagnostics
// that were found. Everything a verb does with a scene file goes through a session.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/file_system.hpp"
#include "base/parallel.hpp"
#include "base/rooted_file_system.hpp"
#include "base/source_map.hpp"
#include "frontend/compile.hpp"
#include "frontend/param_info.hpp"
#include "ir/scene.hpp"
#include "runtime/dependencies.hpp"
#include "runtime/diagnostic_formats.hpp"
#include "runtime/environment.hpp"
#include "runtime/exit_codes.hpp"
#include "runtime/options.hpp"

namespace scenec::runtime {

class Session {
 public:
  explicit Session(const Options& options);

  // The scene file as the file system opens it and messages name it: relative to the working
  // directory when it lies beneath it.
  [[nodiscard]] const std::string& scene_path() const { return scene_path_; }
  [[nodiscard]] RecordingFileSystem& files() { return files_; }
  [[nodiscard]] SourceMap& sources() { return sources_; }
  [[nodiscard]] const SourceMap& sources() const { return sources_; }
  [[nodiscard]] DiagnosticSink& sink() { return sink_; }

  [[nodiscard]] std::optional<frontend::LoadedFile> load(
      const std::optional<std::string>& output_directory = std::nullopt,
      frontend::LoadTree load_tree = frontend::LoadTree::always);
  [[nodiscard]] std::optional<ir::Scene> compile(const frontend::LoadedFile& file);
  // Both, for who wants no tree; nullopt also when the file could not be read. `texts`: what
  // earlier compilations of this process have read.
  [[nodiscard]] std::optional<ir::Scene> load_and_compile(ThreadPool& pool,
                                                          frontend::FrontendCache* texts = nullptr);
  // Bytes of the trees load_and_compile() has made of the scene file and has let go of again;
  // without those of a file that was read in parts.
  [[nodiscard]] std::uint64_t tree_bytes() const { return tree_bytes_; }
  // What it spent its time on.
  [[nodiscard]] const frontend::CompileClocks& clocks() const { return clocks_; }
  // Of the last compilation that asked for them by handing over a cache.
  [[nodiscard]] const std::vector<frontend::ParamInfo>& params() const { return params_; }

  // What the command line and the file of parameters set, each param once.
  [[nodiscard]] std::vector<NameAndValue> settings() const;

  // Whether one of the files read so far is the file `path` names, by whatever name.
  [[nodiscard]] bool has_read(const std::string& path) const;

  // Whether there is an error or a lint that counts as one.
  [[nodiscard]] bool has_errors() const;
  // What was found, sorted, with what `--deny` makes of it.
  [[nodiscard]] std::vector<Finding> findings() const;

  // Writes the dependency file when one is asked for and a scene was loaded, prints what was found
  // and, for people, a line that counts; returns the exit code it calls for.
  // Lints in `told` have been printed by another run and are left out; the others join them.
  void leave_out(std::set<std::string>& told) { told_ = &told; }
  // Writes into one dependency file with other runs.
  void share_dependencies(SharedDependencies& dependencies) { shared_ = &dependencies; }
  [[nodiscard]] ExitCode finish(const Environment& environment);
  // For what goes wrong after finish() has printed.
  void print_late(const Diagnostic& diagnostic, const Environment& environment) const;

 private:
  [[nodiscard]] bool load_params();
  [[nodiscard]] bool write_dependencies();
  void print(const std::vector<Finding>& findings, const Environment& environment) const;

  const Options& options_;
  frontend::CompileOptions compile_options_;
  std::string scene_path_;
  std::set<std::string>* told_ = nullptr;
  SharedDependencies* shared_ = nullptr;
  std::vector<frontend::ParamInfo> params_;
  frontend::CompileClocks clocks_;
  std::uint64_t tree_bytes_ = 0;
  bool loaded_ = false;
  bool scene_unreadable_ = false;
  RootedFileSystem disk_;
  RecordingFileSystem files_;
  SourceMap sources_;
  DiagnosticSink sink_;
};

}  // namespace scenec::runtime
