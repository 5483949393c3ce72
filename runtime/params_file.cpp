#include "runtime/params_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "base/text.hpp"

namespace scenec::runtime {

namespace {

constexpr std::uint64_t largest_file = std::uint64_t{16} << 20;
constexpr std::size_t deepest_array = 8;

using Json = nlohmann::json;

// Counts what the JSON reader has taken: after a string or bracket that is the end of the word.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, std::size_t* taken) : at_(at), taken_(taken) {}
  const char& operator*() const { return *at_; }
  CountingIterator& operator++() {
    ++at_;
    ++*taken_;
    return *this;
  }
  CountingIterator operator++(int) {
    const CountingIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }

 private:
  const char* at_;
  std::size_t* taken_;
};

// Takes the file word by word and makes expressions of the language from the values.
class Reader final : public nlohmann::json_sax<Json> {
 public:
  Reader(FileId file, std::string_view text, DiagnosticSink& sink)
      : file_(file), text_(text), sink_(sink) {}

  std::size_t* taken() { return &taken_; }
  std::vector<frontend::ParamSetting>& settings() { return settings_; }

  bool null() override { return refuse("`null`"); }
  bool boolean(bool value) override { return expression(value ? "true" : "false"); }
  bool number_integer(number_integer_t value) override { return expression(std::to_string(value)); }
  bool number_unsigned(number_unsigned_t value) override {
    return expression(std::to_string(value));
  }
  bool number_float(number_float_t value, const string_t&) override {
    return expression(number_text(value));
  }
  bool string(string_t& value) override {
    if (depth_ == 0 && in_object_) settings_.back().is_text = true;
    return add(value, quoted_string(value));
  }
  bool binary(binary_t&) override { return refuse("binary data"); }

  bool start_object(std::size_t) override {
    if (in_object_) return refuse("an object");
    in_object_ = true;
    return true;
  }
  bool key(string_t& name) override {
    const Span place = word_before(name.size() + 2);
    for (const frontend::ParamSetting& other : settings_) {
      if (other.name != name) continue;
      sink_.report(Diagnostic(DiagnosticKind::params_file, place,
                              fmt::format("`{}` is given twice", printable(name)))
                       .note("first given here", other.span));
      return false;
    }
    settings_.push_back({.name = name,
                         .value = {},
                         .is_text = false,
                         .quoted = {},
                         .source = "--params",
                         .span = place});
    return true;
  }
  bool end_object() override { return true; }

  bool start_array(std::size_t) override {
    if (!in_object_) return refuse("an array");
    if (depth_ == deepest_array) {
      return report(word_before(1),
                    fmt::format("arrays are nested more than {} deep", deepest_array));
    }
    separate();
    append("[", "[");
    ++depth_;
    first_ = true;
    return true;
  }
  bool end_array() override {
    append("]", "]");
    --depth_;
    first_ = false;
    return true;
  }

  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception& error) override {
    // "[json.exception.parse_error.101] parse error at line 1, column 5: syntax error while ..."
    std::string_view what = error.what();
    if (const std::size_t colon = what.find(": "); colon != std::string_view::npos)
      what.remove_prefix(colon + 2);
    if (const std::size_t bracket = what.find("] "); what.starts_with('['))
      what.remove_prefix(bracket + 2);
    const std::size_t end = std::min(position, text_.size());
    const std::size_t begin = end - std::min<std::size_t>(end, 1);
    return report(span_of(begin, end), fmt::format("this is no JSON: {}", printable(what, 200)));
  }

 private:
  bool expression(const std::string& text) { return add(text, text); }
  bool add(const std::string& text, const std::string& quoted) {
    if (!in_object_) return refuse("a single value");
    separate();
    append(text, quoted);
    return true;
  }
  void separate() {
    if (depth_ > 0 && !std::exchange(first_, false)) append(", ", ", ");
  }
  void append(std::string_view text, std::string_view quoted) {
    settings_.back().value += text;
    if (depth_ > 0 || text == "[") settings_.back().quoted += quoted;
  }
  bool refuse(std::string_view what) {
    if (!in_object_ || settings_.empty()) {
      return report(span_of(0, 0),
                    fmt::format("the file holds {}; one object of params is expected", what));
    }
    const frontend::ParamSetting& setting = settings_.back();
    return report(setting.span,
                  fmt::format("the value of `{}` is {}; a number, string, truth value or array of "
                              "those is expected",
                              printable(setting.name), what));
  }
  bool report(Span place, std::string message) {
    sink_.report(Diagnostic(DiagnosticKind::params_file, place, std::move(message)));
    return false;
  }
  // The word of `size` bytes that has just been taken. One written with escapes is longer: its end.
  [[nodiscard]] Span word_before(std::size_t size) const {
    const std::size_t end = std::min(taken_, text_.size());
    const std::size_t begin = end - std::min(end, size);
    const bool whole = size == 1 || (begin < end && text_[begin] == '"');
    return span_of(whole ? begin : end - 1, end);
  }
  [[nodiscard]] Span span_of(std::size_t begin, std::size_t end) const {
    return {file_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
  }

  FileId file_;
  std::string_view text_;
  DiagnosticSink& sink_;
  std::vector<frontend::ParamSetting> settings_;
  std::size_t taken_ = 0;
  std::size_t depth_ = 0;  // of arrays
  bool in_object_ = false;
  bool first_ = false;  // element of an array
};

}  // namespace

std::optional<std::vector<frontend::ParamSetting>> read_params_file(const std::string& path,
                                                                    FileSystem& files,
                                                                    SourceMap& sources,
                                                                    DiagnosticSink& sink) {
  const Result<FileContent, FileError> content = files.read(path, largest_file);
  if (!content) {
    sink.report(Diagnostic(
        DiagnosticKind::params_file, {},
        fmt::format("`--params` is `{}`: {}", printable(path), text_of(content.error()))));
    return std::nullopt;
  }
  const std::string_view text = content.value().bytes;
  Reader reader(sources.add(path, text, content.value().owner), text, sink);
  const bool sound =
      Json::sax_parse(CountingIterator(text.data(), reader.taken()),
                      CountingIterator(text.data() + text.size(), reader.taken()), &reader);
  if (!sound) return std::nullopt;
  return std::move(reader.settings());
}

}  // namespace scenec::runtime
