// The little of HTTP/1.1 that the preview page needs: requests with a fixed length, one after the
// other on a connection. Every size is limited before anything is stored; what is not understood is
// refused, never guessed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scenec::runtime {

inline constexpr std::size_t most_head_bytes = 16 * 1024;
inline constexpr std::size_t most_body_bytes = 64 * 1024;

struct HttpRequest {
  std::string method;
  std::string path;                                          // up to `?`
  std::string query;                                         // behind it
  std::vector<std::pair<std::string, std::string>> headers;  // names in lower case
  std::string body;

  // Nothing when it is absent; a header that is given twice counts as absent.
  [[nodiscard]] std::optional<std::string_view> header(std::string_view lower_case_name) const;
  // The value of `name=value` in the query, as written.
  [[nodiscard]] std::optional<std::string_view> parameter(std::string_view name) const;
};

struct HttpResponse {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::shared_ptr<const std::string> body = nullptr;
  std::vector<std::pair<std::string, std::string>> headers =
      {};  // besides those every response has
};
[[nodiscard]] HttpResponse text_response(int status, std::string text);
[[nodiscard]] HttpResponse json_response(int status, std::string json);

enum class AfterResponse : std::uint8_t { keep_open, close };
// Everything before the body.
[[nodiscard]] std::string head_of(const HttpResponse& response, AfterResponse after);

// Takes bytes as they come and gives requests.
class HttpParser {
 public:
  enum class State : std::uint8_t { incomplete, complete, broken };
  // Takes from the front of `bytes` what belongs to the request; the rest is the next one's.
  State feed(std::string& bytes);
  // After `complete`; the parser is then ready for the next one.
  [[nodiscard]] HttpRequest take();
  // After `broken`: what to answer before closing.
  [[nodiscard]] const HttpResponse& refusal() const { return refusal_; }

 private:
  State refuse(int status, std::string text);
  State parse_head(std::string_view head);
  bool parse_request_line(std::string_view line);
  bool parse_header(std::string_view line);

  HttpRequest request_;
  HttpResponse refusal_;
  bool head_done_ = false;
  std::size_t body_size_ = 0;
};

}  // namespace scenec::runtime
