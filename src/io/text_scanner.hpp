#pragma once
// Lines, words and numbers of a text file.

#include "io/input.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace delmesh::io {

struct TextRules {
    char comment = '\0';        ///< starts a comment where a word may start; '\0': there are none
    bool continuation = false;  ///< a backslash at the end of a line joins the next one to it
};

/// Goes through an input line by line; a whole line is in the input's window at a time.
class TextScanner {
public:
    /// Lines end with LF or CR LF or, in a file without any LF in its first 64 KiB, with CR.
    TextScanner(Input& input, TextRules rules);
    TextScanner(Input& input, TextRules rules, char newline) : input_(&input), rules_(rules), newline_(newline) {}

    /// Moves to the next line, whatever is left on this one; false at the end of the file.
    bool next_line();
    /// Moves to the next line that holds a word, unless this one does; throws at the end of the file.
    void need_word(std::string_view expected) {
        while (line_is_done()) need_line(expected);
    }
    /// True if no word is left on this line.
    bool line_is_done() {
        skip_blanks();
        return cursor_ == end_ || (rules_.comment != '\0' && *cursor_ == rules_.comment);
    }
    void skip_line() { cursor_ = end_; }
    /// The next word on this line, empty if there is none.
    std::string_view word();

    /// The next word of this line as a number; throws where it is none. "inf" and "nan" are numbers; a decimal number
    /// too large for a double is not. What underflows becomes the nearest double, or zero.
    double number(std::string_view expected);
    /// The next word of this line as an integer of at most 18 digits; throws where it is none.
    std::int64_t integer(std::string_view expected);
    /// An optional sign and at most 18 digits, up to the first other character.
    std::int64_t digits(std::string_view expected);
    /// The next unread character of this line, '\0' at its end.
    [[nodiscard]] char peek() const { return cursor_ < end_ ? *cursor_ : '\0'; }
    void advance() { ++cursor_; }
    [[nodiscard]] bool at_word_end() const;

    /// The number of the line, from 1.
    [[nodiscard]] std::uint64_t line() const { return line_; }
    /// Leaves this line, so that the input goes on behind it.
    void release();

    /// Throws "NAME: line N: WHAT".
    [[noreturn]] void fail(const std::string& what) const { fail_at(line_, what); }
    [[noreturn]] void fail_at(std::uint64_t line, const std::string& what,
                              ErrorCode code = ErrorCode::file_format) const;
    /// Throws "NAME: line N: expected EXPECTED, found" and the next word.
    [[noreturn]] void fail_expected(std::string_view expected) const;

private:
    void skip_blanks();
    void need_line(std::string_view expected);
    std::size_t find_newline(std::size_t from);
    bool join_next_line(std::size_t from, std::size_t newline);
    double unusual_number(std::string_view expected);

    Input* input_;
    TextRules rules_;
    char newline_;
    std::uint64_t line_ = 0;
    std::uint64_t joined_lines_ = 0;
    std::size_t line_bytes_ = 0;  // this line with its end, still in the input's window
    bool past_end_ = false;
    const char* cursor_ = nullptr;
    const char* end_ = nullptr;
};

}  // namespace delmesh::io
