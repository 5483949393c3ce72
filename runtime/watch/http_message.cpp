#include "runtime/watch/http_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/text.hpp"

namespace scenec::runtime {

namespace {

std::string_view reason_of(int status) {
  switch (status) {
    case 101:
      return "Switching Protocols";
    case 200:
      return "OK";
    case 400:
      return "Bad Request";
    case 403:
      return "Forbidden";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 409:
      return "Conflict";
    case 411:
      return "Length Required";
    case 413:
      return "Content Too Large";
    case 415:
      return "Unsupported Media Type";
    case 422:
      return "Unprocessable Content";
    case 431:
      return "Request Header Fields Too Large";
    case 503:
      return "Service Unavailable";
    default:
      return "Error";
  }
}

bool is_token_char(char c) {
  constexpr std::string_view others = "!#$%&'*+-.^_`|~";
  const auto u = static_cast<unsigned char>(c);
  return std::isalnum(u) != 0 || others.find(c) != std::string_view::npos;
}

bool is_printable(char c) {
  return c >= 0x20 && c != 0x7f;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

}  // namespace

std::optional<std::string_view> HttpRequest::header(std::string_view lower_case_name) const {
  std::optional<std::string_view> result;
  for (const auto& [name, value] : headers) {
    if (name != lower_case_name) continue;
    if (result) return std::nullopt;
    result = value;
  }
  return result;
}

std::optional<std::string_view> HttpRequest::parameter(std::string_view name) const {
  std::string_view rest = query;
  while (!rest.empty()) {
    const std::size_t end = rest.find('&');
    const std::string_view pair = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    const std::size_t equals = pair.find('=');
    if (equals != std::string_view::npos && pair.substr(0, equals) == name)
      return pair.substr(equals + 1);
  }
  return std::nullopt;
}

HttpResponse text_response(int status, std::string text) {
  return {.status = status, .body = std::make_shared<const std::string>(std::move(text))};
}

HttpResponse json_response(int status, std::string json) {
  return {.status = status,
          .type = "application/json",
          .body = std::make_shared<const std::string>(std::move(json))};
}

std::string head_of(const HttpResponse& response, AfterResponse after) {
  std::string head = fmt::format("HTTP/1.1 {} {}\r\n", response.status, reason_of(response.status));
  for (const auto& [name, value] : response.headers) head += fmt::format("{}: {}\r\n", name, value);
  if (response.status != 101) {
    head += fmt::format("Content-Type: {}\r\nContent-Length: {}\r\nConnection: {}\r\n",
                        response.type, response.body ? response.body->size() : 0,
                        after == AfterResponse::close ? "close" : "keep-alive");
  }
  head +=
      "Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n"
      "Referrer-Policy: no-referrer\r\nCross-Origin-Resource-Policy: same-origin\r\n"
      "Cross-Origin-Opener-Policy: same-origin\r\nX-Frame-Options: DENY\r\n"
      "Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self'; "
      "img-src 'self' blob: data:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
      "frame-ancestors 'none'\r\n\r\n";
  return head;
}

HttpParser::State HttpParser::refuse(int status, std::string text) {
  refusal_ = text_response(status, std::move(text));
  return State::broken;
}

HttpParser::State HttpParser::feed(std::string& bytes) {
  if (!head_done_) {
    const std::size_t end = bytes.find("\r\n\r\n");
    const std::size_t size = end == std::string::npos ? bytes.size() : end + 4;
    if (size > most_head_bytes) return refuse(431, "the request's head is too large\n");
    if (end == std::string::npos) return State::incomplete;
    const State state = parse_head(std::string_view(bytes).substr(0, end));
    if (state == State::broken) return state;
    bytes.erase(0, size);
    head_done_ = true;
  }
  if (bytes.size() < body_size_) return State::incomplete;
  request_.body = bytes.substr(0, body_size_);
  bytes.erase(0, body_size_);
  return State::complete;
}

HttpRequest HttpParser::take() {
  head_done_ = false;
  body_size_ = 0;
  return std::exchange(request_, {});
}

HttpParser::State HttpParser::parse_head(std::string_view head) {
  std::size_t end = head.find("\r\n");
  if (!parse_request_line(head.substr(0, end))) return refuse(400, "not a request\n");
  while (end != std::string_view::npos) {
    head.remove_prefix(end + 2);
    end = head.find("\r\n");
    if (!parse_header(head.substr(0, end))) return refuse(400, "not a header\n");
  }
  const auto is_given = [&](std::string_view name) {
    return std::any_of(request_.headers.begin(), request_.headers.end(),
                       [&](const auto& header) { return header.first == name; });
  };
  if (is_given("transfer-encoding")) return refuse(411, "needs a length\n");
  if (!is_given("content-length")) return State::incomplete;
  const auto length = request_.header("content-length");
  const auto size = length && !length->empty() &&
                            length->find_first_not_of("0123456789") == std::string_view::npos
                        ? parse_int(*length)
                        : std::nullopt;
  if (!size || *size < 0) return refuse(400, "not a length\n");
  if (static_cast<std::uint64_t>(*size) > most_body_bytes) return refuse(413, "too large\n");
  body_size_ = static_cast<std::size_t>(*size);
  return State::incomplete;
}

bool HttpParser::parse_request_line(std::string_view line) {
  const std::size_t first = line.find(' ');
  const std::size_t last = line.rfind(' ');
  if (first == std::string_view::npos || first == last) return false;
  const std::string_view method = line.substr(0, first);
  const std::string_view target = line.substr(first + 1, last - first - 1);
  if (line.substr(last + 1) != "HTTP/1.1") return false;
  if (method.empty() || !std::all_of(method.begin(), method.end(), is_token_char)) return false;
  // Only paths of our own: no proxy forms. Everything beyond ASCII is escaped by browsers.
  const auto is_plain = [](char c) { return c > ' ' && c < 0x7f; };
  if (!target.starts_with('/') || !std::all_of(target.begin(), target.end(), is_plain))
    return false;
  const std::size_t mark = target.find('?');
  request_.method = method;
  request_.path = target.substr(0, mark);
  request_.query = mark == std::string_view::npos ? "" : target.substr(mark + 1);
  return true;
}

bool HttpParser::parse_header(std::string_view line) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos || colon == 0) return false;
  const std::string_view name = line.substr(0, colon);
  const std::string_view value = trimmed(line.substr(colon + 1));
  if (!std::all_of(name.begin(), name.end(), is_token_char)) return false;
  if (!std::all_of(value.begin(), value.end(), is_printable)) return false;
  request_.headers.emplace_back(lower_case(name), value);
  return true;
}

}  // namespace scenec::runtime
