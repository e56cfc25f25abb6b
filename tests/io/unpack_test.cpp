// Packed files: content decides, any pieces give the same bytes, damage is an error that names its place, and what
// grows absurdly is refused before it fills memory.

#include "io/unpack.hpp"

#include "delmesh/mesh/rounding.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "io/allocation_watch.hpp"
#include "io/io_support.hpp"
#include "io/packing.hpp"

namespace delmesh {
namespace {

using test::gzip;
using test::zstd;

using Pack = std::string (*)(std::string_view);
constexpr Pack packs[] = {gzip, zstd};

std::string unpack(std::string_view bytes, std::size_t step, std::size_t piece) {
    test::DripSource packed(bytes, step);
    io::UnpackedSource source(packed, "a.ply");
    std::string text;
    std::string buffer(piece, '\0');
    while (const std::size_t n = source.read(buffer.data(), piece)) text.append(buffer, 0, n);
    EXPECT_EQ(source.read(buffer.data(), piece), 0u);
    return text;
}

std::string noise(std::size_t n) {
    test::Random random(1);
    std::string text;
    while (text.size() < n) text += std::to_string(random.below(100'000)) + (random.below(9) == 0 ? "\n" : " ");
    return text;
}

TEST(Unpack, GivesTheSameBytesInAnyPieces) {
    for (const std::size_t size : {0, 1, 3, 4, 5, 70'000, 300'000}) {
        const std::string text = noise(size);
        for (const std::size_t step : {1, 7, 65'536}) {
            for (const std::size_t piece : {1, 1000, 262'144}) {
                if (size > 10'000 && step * piece < 1000) continue;
                EXPECT_EQ(unpack(text, step, piece), text);
                for (const Pack pack : packs) EXPECT_EQ(unpack(pack(text), step, piece), text);
            }
        }
    }
}

TEST(Unpack, GoesThroughManyMembersAndFrames) {
    const std::string text = noise(1000);
    for (const Pack pack : packs) {
        EXPECT_EQ(unpack(pack(text) + pack("") + pack(text), 100, 77), text + text);
    }
    EXPECT_EQ(unpack(gzip(text) + std::string(512, '\0'), 100, 77), text);
    const std::string user_data("\x5f\x2a\x4d\x18\3\0\0\0abc", 11);
    EXPECT_EQ(unpack(user_data + zstd(text) + user_data, 100, 77), text);
}

TEST(Unpack, PackedFilesOfEveryFormatAreReadLikePlainOnes) {
    const test::TestFolder folder;
    const PolygonSoup soup = make_sample("torus", 20'000);
    for (const Format format : {Format::ply, Format::obj, Format::off, Format::stl}) {
        const std::string plain_name = "a." + std::string(name(format));
        PolygonSoup rounded = soup;
        if (format == Format::stl) (void)round_to_float(rounded);
        write_soup(folder / plain_name, rounded, {.format = format});
        const PolygonSoup plain = read_soup(folder / plain_name);
        const std::string bytes = test::read_bytes(folder / plain_name);
        for (const Pack pack : packs) {
            for (const std::string& packed_name :
                 {plain_name + ".gz", plain_name + ".zst", plain_name, std::string("x")}) {
                test::write_bytes(folder / packed_name, pack(bytes));
                EXPECT_TRUE(test::same_soup(read_soup(folder / packed_name), plain)) << packed_name;
            }
        }
        EXPECT_TRUE(test::same_soup(test::parse_dripping(bytes, "x", 1000, 100), plain)) << plain_name;
    }
}

TEST(Unpack, DataCutOffAnywhereAreErrors) {
    const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" + noise(300);
    for (const Pack pack : packs) {
        const std::string packed = pack(text);
        for (std::size_t n = 4; n < packed.size(); ++n) {
            test::expect_error([&] { (void)unpack(packed.substr(0, n), 9, 50); }, ErrorCode::file_format,
                               "byte " + std::to_string(n) + ": expected more ");
        }
    }
}

TEST(Unpack, DamagedDataAreErrorsOrMeshes) {
    const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n#" + noise(300);
    test::Random random(5);
    for (const Pack pack : packs) {
        const std::string packed = pack(text);
        std::size_t errors = 0;
        for (int round = 0; round < 2000; ++round) {
            std::string bytes = packed;
            for (std::uint64_t i = 1 + random.below(3); i > 0; --i)
                bytes[random.below(bytes.size())] = static_cast<char>(random.bits());
            try {
                (void)test::parse(bytes, "a.obj");
            } catch (const Error& error) {
                ++errors;
                EXPECT_TRUE(std::string(error.what()).starts_with("a.obj: ")) << error.what();
            }
        }
        EXPECT_GT(errors, 500u);  // Zstandard has no check sum by default
    }
    test::expect_parse_error(gzip(text) + "junk", "a.obj.gz", "expected another member or the end");
    test::expect_parse_error(zstd(text) + "junk", "a.obj.zst", "expected Zstandard data, found damaged data");
    test::expect_parse_error(gzip(gzip(text)), "a.obj.gz", "found gzip data", ErrorCode::unsupported_format);
}

/// 1 GB of blanks in a comment: the line would have to be held as a whole.
TEST(Unpack, BombsAreRefusedEarly) {
    const std::string blanks(std::size_t{1} << 26, ' ');
    std::string gz = gzip("# ");
    std::string zst = zstd("# ");
    const std::string more_gz = gzip(blanks);
    const std::string more_zst = zstd(blanks);
    for (int i = 0; i < 16; ++i) {
        gz += more_gz;
        zst += more_zst;
    }
    for (const std::string& bomb : {gz, zst}) {
        test::largest_allocation = 0;
        test::expect_parse_error(bomb, "a.obj", "that unpack to more than 250 times their size");
        EXPECT_LE(test::largest_allocation.load(), (std::size_t{64} << 21) + 500 * bomb.size());
    }
}

}  // namespace
}  // namespace delmesh
