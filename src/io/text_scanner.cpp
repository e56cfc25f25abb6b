#include "io/text_scanner.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>
#include <cmath>
#include <cstring>
#include <limits>

namespace delmesh::io {

namespace {

constexpr bool is_blank(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}
constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

char newline_of(Input& input) {
    constexpr std::size_t looked_at = 65536;
    input.ensure(looked_at);
    const std::string_view text = input.view().substr(0, looked_at);
    return text.find('\n') == text.npos && text.find('\r') != text.npos ? '\r' : '\n';
}

}  // namespace

TextScanner::TextScanner(Input& input, TextRules rules) : TextScanner(input, rules, newline_of(input)) {}

bool TextScanner::next_line() {
    if (past_end_) return false;
    release();
    line_ += 1 + joined_lines_;
    joined_lines_ = 0;
    std::size_t from = 0;
    std::size_t newline = find_newline(from);
    while (rules_.continuation && join_next_line(from, newline)) {
        from = newline + 1;
        newline = find_newline(from);
    }
    const std::size_t available = input_->available();
    past_end_ = available == 0;
    cursor_ = input_->begin();
    end_ = cursor_ + std::min(newline, available);
    line_bytes_ = std::min(newline + 1, available);
    return !past_end_;
}

/// Where the first newline at or after `from` is, both counted from the input's first unread byte; without one, the
/// number of bytes left.
std::size_t TextScanner::find_newline(std::size_t from) {
    for (;;) {
        const std::size_t available = input_->available();
        if (available > from) {
            const char* text = input_->begin();
            const void* found = std::memchr(text + from, newline_, available - from);
            if (found != nullptr) return static_cast<std::size_t>(static_cast<const char*>(found) - text);
            from = available;
        }
        if (!input_->more()) return available;
    }
}

/// Blanks out a backslash at the end of the line [from, newline), unless it belongs to a comment.
bool TextScanner::join_next_line(std::size_t from, std::size_t newline) {
    if (newline >= input_->available()) return false;
    char* const begin = input_->begin() + from;
    char* const end = input_->begin() + newline;
    char* last = end;
    if (last > begin && last[-1] == '\r') --last;
    if (last == begin || last[-1] != '\\') return false;
    if (std::memchr(begin, rules_.comment, static_cast<std::size_t>(last - begin)) != nullptr) return false;
    std::fill(last - 1, end + 1, ' ');
    ++joined_lines_;
    return true;
}

void TextScanner::release() {
    input_->skip(line_bytes_);
    line_bytes_ = 0;
    cursor_ = end_ = nullptr;
}

void TextScanner::need_line(std::string_view expected) {
    if (!next_line()) fail_expected(expected);
}

void TextScanner::skip_blanks() {
    while (cursor_ != end_ && is_blank(*cursor_)) ++cursor_;
}

bool TextScanner::at_word_end() const {
    return cursor_ == end_ || is_blank(*cursor_) || (rules_.comment != '\0' && *cursor_ == rules_.comment);
}

std::string_view TextScanner::word() {
    if (line_is_done()) return {};
    const char* const first = cursor_;
    while (cursor_ != end_ && !is_blank(*cursor_)) ++cursor_;
    return {first, cursor_};
}

double TextScanner::number(std::string_view expected) {
    skip_blanks();
    double value = 0;
    const auto [after, error] = fast_float::from_chars(cursor_, end_, value);
    const bool plain = error == std::errc() && (after == end_ || is_blank(*after)) && std::isfinite(value);
    if (!plain) return unusual_number(expected);
    cursor_ = after;
    return value;
}

/// A plus sign, an infinity, a NaN (also as old Microsoft runtimes print them), or an error.
double TextScanner::unusual_number(std::string_view expected) {
    const char* const first = cursor_;
    std::string_view text = word();
    cursor_ = first;
    const bool negative = text.starts_with('-');
    if (negative || text.starts_with('+')) text.remove_prefix(1);
    if (text.empty() || text.front() == '-' || text.front() == '+') fail_expected(expected);
    double value = 0;
    const auto [after, error] = fast_float::from_chars(text.data(), text.data() + text.size(), value);
    if (text.starts_with("1.#INF")) {
        value = std::numeric_limits<double>::infinity();
    } else if (text.starts_with("1.#QNAN") || text.starts_with("1.#IND")) {
        value = std::numeric_limits<double>::quiet_NaN();
    } else if (error != std::errc() || after != text.data() + text.size()) {
        fail_expected(expected);
    } else if (std::isinf(value) && (is_digit(text.front()) || text.front() == '.')) {
        fail(fmt::format("expected {}, found {}, which is too large for a double", expected, quote(text)));
    }
    cursor_ = text.data() + text.size();
    return negative ? -value : value;
}

std::int64_t TextScanner::integer(std::string_view expected) {
    skip_blanks();
    const char* const first = cursor_;
    const std::int64_t value = digits(expected);
    if (!at_word_end()) {
        cursor_ = first;
        fail_expected(expected);
    }
    return value;
}

std::int64_t TextScanner::digits(std::string_view expected) {
    constexpr int most = 18;
    const char* const first = cursor_;
    const bool negative = peek() == '-';
    if (negative || peek() == '+') ++cursor_;
    const char* const first_digit = cursor_;
    std::int64_t value = 0;
    for (; cursor_ != end_ && is_digit(*cursor_); ++cursor_) {
        if (cursor_ - first_digit == most) break;
        value = 10 * value + (*cursor_ - '0');
    }
    if (cursor_ == first_digit || (cursor_ != end_ && is_digit(*cursor_))) {
        cursor_ = first;
        fail_expected(expected);
    }
    return negative ? -value : value;
}

void TextScanner::fail_at(std::uint64_t line, const std::string& what, ErrorCode code) const {
    throw Error(code, fmt::format("{}: line {}: {}", input_->name(), line, what));
}

void TextScanner::fail_expected(std::string_view expected) const {
    TextScanner rest = *this;
    const std::string_view next = rest.word();
    fail(fmt::format("expected {}, found {}", expected,
                     past_end_      ? "the end of the file"
                     : next.empty() ? "the end of the line"
                                    : quote(next)));
}

}  // namespace delmesh::io
