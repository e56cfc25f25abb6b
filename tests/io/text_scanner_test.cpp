#include "io/text_scanner.hpp"

#include "io/io_support.hpp"

#include <cmath>

namespace delmesh::io {
namespace {

/// The words of each line, with its number, for windows and reads of all small sizes.
std::vector<std::string> lines_of(std::string_view text, TextRules rules, std::size_t step, std::size_t window) {
    test::DripSource source(text, step);
    Input input(source, "text", window);
    TextScanner scanner(input, rules);
    std::vector<std::string> lines;
    while (scanner.next_line()) {
        lines.push_back(std::to_string(scanner.line()) + ":");
        for (std::string_view word = scanner.word(); !word.empty(); word = scanner.word()) {
            lines.back() += " " + std::string(word);
        }
    }
    return lines;
}

void expect_lines(std::string_view text, TextRules rules, const std::vector<std::string>& expected) {
    for (const std::size_t step : {1, 2, 3, 100}) {
        for (const std::size_t window : {1, 2, 5, 64}) EXPECT_EQ(lines_of(text, rules, step, window), expected);
    }
}

TEST(TextScanner, FindsWordsWhateverEndsTheLines) {
    expect_lines("a bc\n\n d\te \n", {}, {"1: a bc", "2:", "3: d e"});
    expect_lines("a bc\r\n\r\n d\te \r\n", {}, {"1: a bc", "2:", "3: d e"});
    expect_lines("a bc\r\r d\te", {}, {"1: a bc", "2:", "3: d e"});
    expect_lines("", {}, {});
    expect_lines("\n", {}, {"1:"});
}

TEST(TextScanner, CommentsEndAtTheLine) {
    expect_lines("a # b\n#c\nd#e f\n", {'#', false}, {"1: a", "2:", "3: d#e f"});
}

TEST(TextScanner, BackslashJoinsLines) {
    expect_lines("a \\\nb\\\r\nc\nd\n", {'#', true}, {"1: a b c", "4: d"});
    expect_lines("a \\\nb\n", {'#', false}, {"1: a \\", "2: b"});
    expect_lines("# c:\\\nb\n", {'#', true}, {"1:", "2: b"});
    expect_lines("a \\", {'#', true}, {"1: a \\"});
    expect_lines("\\\n\\\n\\\na", {'#', true}, {"1: a"});
}

double number_of(std::string_view text) {
    test::DripSource source(text, 100);
    Input input(source, "text");
    TextScanner scanner(input, {'#', false});
    scanner.next_line();
    const double value = scanner.number("a number");
    EXPECT_TRUE(scanner.line_is_done());
    return value;
}

TEST(TextScanner, NumbersAreTheNearestDoubles) {
    EXPECT_EQ(number_of("1.5"), 1.5);
    EXPECT_EQ(number_of(" +1.5e+1 "), 15);
    EXPECT_EQ(number_of(".5 # half"), 0.5);
    EXPECT_EQ(number_of("5."), 5);
    EXPECT_EQ(number_of("-1E3"), -1000);
    EXPECT_EQ(number_of("5e-324"), 5e-324);
    EXPECT_EQ(number_of("1e-400"), 0);
    EXPECT_EQ(number_of("1.7976931348623157e308"), 0x1.fffffffffffffp+1023);
    EXPECT_EQ(number_of("9007199254740993"), 9007199254740992);
    EXPECT_EQ(number_of("9007199254740993.00000000000000000000000000000000001"), 9007199254740994);
    EXPECT_TRUE(std::signbit(number_of("-0")));
    EXPECT_EQ(number_of("0." + std::string(1'000'000, '3')), 1.0 / 3);
    EXPECT_EQ(number_of(std::string(1'000'000, '0') + "7"), 7);
}

TEST(TextScanner, InfinitiesAndNansAreNumbers) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const char* text : {"inf", "+inf", "Infinity", "INF", "1.#INF"}) EXPECT_EQ(number_of(text), infinity) << text;
    for (const char* text : {"-inf", "-Infinity", "-1.#INF00"}) EXPECT_EQ(number_of(text), -infinity) << text;
    for (const char* text : {"nan", "-nan", "NaN", "nan(ind)", "-1.#IND", "1.#QNAN"}) {
        EXPECT_TRUE(std::isnan(number_of(text))) << text;
    }
}

TEST(TextScanner, OtherWordsAreNoNumbers) {
    for (const char* text :
         {"", "#1", "x", "1,5", "1.5x", "0x10", "1e", "--1", "+-1", "+", "-", ".", "1e400", "-1e400"}) {
        test::expect_error([&] { (void)number_of(text); }, ErrorCode::file_format, "line 1: expected a number, found");
    }
    test::expect_error([] { (void)number_of("1e400"); }, ErrorCode::file_format, "too large for a double");
    test::expect_error([] { (void)number_of("a\x01\xff'b"); }, ErrorCode::file_format, "found 'a\\x01\\xff'b'");
    test::expect_error([] { (void)number_of(std::string(100, 'x')); }, ErrorCode::file_format,
                       "found '" + std::string(40, 'x') + "...'");
}

std::int64_t integer_of(std::string_view text) {
    test::DripSource source(text, 100);
    Input input(source, "text");
    TextScanner scanner(input, {'#', false});
    scanner.next_line();
    return scanner.integer("an integer");
}

TEST(TextScanner, Integers) {
    EXPECT_EQ(integer_of("0"), 0);
    EXPECT_EQ(integer_of(" -12 3"), -12);
    EXPECT_EQ(integer_of("+7#c"), 7);
    EXPECT_EQ(integer_of("999999999999999999"), 999999999999999999);
    for (const char* text : {"", "-", "1.0", "1e3", "x", "9999999999999999999", "99999999999999999999999"}) {
        test::expect_error([&] { (void)integer_of(text); }, ErrorCode::file_format, "expected an integer, found");
    }
}

}  // namespace
}  // namespace delmesh::io
