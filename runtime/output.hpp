// Where results go. Whatever can be known about an output is checked before the work begins, and a
// file is replaced whole or not at all.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "backend/backend.hpp"
#include "base/diagnostic.hpp"
#include "runtime/environment.hpp"
#include "runtime/exit_codes.hpp"
#include "runtime/session.hpp"

namespace scenec::runtime {

// The picture's format by its name; nullopt when `path` cannot be written (reported).
[[nodiscard]] std::optional<backend::ImageFormat> check_picture_output(const std::string& path,
                                                                       DiagnosticSink& sink);
// False when `path` cannot be replaced (reported).
bool check_output(const std::string& path, DiagnosticSink& sink);
// The same for the file of `-o`, when one is named, and the dependency file, when there is one.
bool check_outputs(const Options& options, DiagnosticSink& sink);
// False when `path` is a file this run has read (reported).
bool check_output_is_no_input(const std::string& path, Session& session);
// False when writing failed (reported); then nothing partial is left behind.
bool write_output(const std::string& path, std::string_view bytes, DiagnosticSink& sink);

// Text to `path`, or to standard output when it is empty. `code` is what the text's making called
// for; a failure to write it is worse.
[[nodiscard]] ExitCode write_text(const std::string& path, std::string_view text, Session& session,
                                  const Environment& environment);

// Makes a folder, and those above it, where there is none; false after a line on the error stream.
[[nodiscard]] bool make_folder(const std::string& path, const Environment& environment);

}  // namespace scenec::runtime
