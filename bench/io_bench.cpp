// How fast files are read and written, in bytes and faces per second, on sizes that show whether it is linear.
// Run: build/bench/bench/bench_io

#include "delmesh/io/read.hpp"
#include "delmesh/io/write.hpp"

#include <benchmark/benchmark.h>
#include <unistd.h>
#include <cmath>
#include <filesystem>
#include <string>

namespace delmesh {
namespace {

struct Kind {
    const char* name;
    Format format;
    Precision precision;
    bool ascii;
};

constexpr Kind ply_double{"ply double", Format::ply, Precision::float64, false};
constexpr Kind ply_float{"ply float", Format::ply, Precision::float32, false};
constexpr Kind ply_ascii{"ply ascii", Format::ply, Precision::float64, true};
constexpr Kind obj{"obj", Format::obj, Precision::float64, false};
constexpr Kind off{"off", Format::off, Precision::float64, false};
constexpr Kind stl{"stl", Format::stl, Precision::float32, false};
constexpr Kind stl_ascii{"stl ascii", Format::stl, Precision::float32, true};

/// A wavy sheet of about `faces` faces whose coordinates have all their digits; floats.
PolygonSoup make_sheet(std::size_t faces) {
    const auto side = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(faces) / 2)) + 1;
    PolygonSoup soup;
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const double u = 1.1 * x / side;
            const double v = 1.3 * y / side;
            soup.points.push_back({static_cast<float>(u), static_cast<float>(v), static_cast<float>(u * v * (1 - u))});
        }
    }
    for (std::uint32_t y = 0; y + 1 < side; ++y) {
        for (std::uint32_t x = 0; x + 1 < side; ++x) {
            const std::uint32_t a = y * side + x;
            soup.corners.insert(soup.corners.end(), {a, a + 1, a + side + 1, a, a + side + 1, a + side});
        }
    }
    return soup;
}

PolygonSoup with_all_digits(PolygonSoup soup) {
    for (Vec3& p : soup.points) p = {p.x / 3, p.y / 7, p.z / 11};
    return soup;
}

std::filesystem::path scratch_file(const Kind& kind) {
    return std::filesystem::temp_directory_path() /
           ("delmesh-bench-" + std::to_string(::getpid()) + "." + std::string(name(kind.format)));
}

PolygonSoup make_input(const Kind& kind, std::size_t faces) {
    return kind.precision == Precision::float32 ? make_sheet(faces) : with_all_digits(make_sheet(faces));
}

void count(benchmark::State& state, const std::filesystem::path& path, std::size_t faces) {
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * std::filesystem::file_size(path)));
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * faces));
    std::filesystem::remove(path);
}

void read(benchmark::State& state, const Kind& kind) {
    const PolygonSoup soup = make_input(kind, static_cast<std::size_t>(state.range(0)));
    const std::filesystem::path path = scratch_file(kind);
    write_soup(path, soup, {.format = kind.format, .precision = kind.precision, .ascii = kind.ascii});
    for ([[maybe_unused]] const auto& iteration : state) {
        PolygonSoup back = read_soup(path);
        if (back.face_count() != soup.face_count()) state.SkipWithError("the file was not read back");
        benchmark::DoNotOptimize(back.corners.data());
    }
    count(state, path, soup.face_count());
}

void write(benchmark::State& state, const Kind& kind) {
    const PolygonSoup soup = make_input(kind, static_cast<std::size_t>(state.range(0)));
    const std::filesystem::path path = scratch_file(kind);
    for ([[maybe_unused]] const auto& iteration : state) {
        write_soup(path, soup, {.format = kind.format, .precision = kind.precision, .ascii = kind.ascii});
    }
    count(state, path, soup.face_count());
}

void sizes(benchmark::internal::Benchmark* b) {
    b->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Arg(4'000'000)->Unit(benchmark::kMillisecond);
}

#define DELMESH_IO_BENCH(kind)                         \
    BENCHMARK_CAPTURE(read, kind, kind)->Apply(sizes); \
    BENCHMARK_CAPTURE(write, kind, kind)->Apply(sizes)

DELMESH_IO_BENCH(ply_double);
DELMESH_IO_BENCH(ply_float);
DELMESH_IO_BENCH(ply_ascii);
DELMESH_IO_BENCH(obj);
DELMESH_IO_BENCH(off);
DELMESH_IO_BENCH(stl);
DELMESH_IO_BENCH(stl_ascii);

}  // namespace
}  // namespace delmesh
