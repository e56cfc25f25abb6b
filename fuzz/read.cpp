// The readers: any bytes give a soup that holds together, or an error of one line.

#include "delmesh/io/read.hpp"

#include "delmesh/base/error.hpp"
#include "delmesh/mesh/shapes.hpp"
#include "io/packed_gltf.hpp"
#include "io/packing.hpp"
#include "io/scene_files.hpp"
#include "io/wide_text.hpp"
#include "target.hpp"

#include <algorithm>

namespace delmesh::fuzz {

namespace {

constexpr std::string_view format_name = FUZZ_FORMAT;

void check(PolygonSoup soup) {
    for (const std::uint32_t corner : soup.corners) require(corner < soup.points.size(), "indices are in range");
    for (const auto& line : soup.lines)
        require(line[0] < soup.points.size() && line[1] < soup.points.size(), "lines are in range");
    if (soup.starts.empty()) {
        require(soup.corners.size() % 3 == 0, "triangles have three corners");
    } else {
        require(std::ranges::is_sorted(soup.starts) && soup.starts.front() == 0 &&
                    soup.starts.back() == soup.corners.size(),
                "faces follow one another");
    }
    triangulate(soup);
}

std::string repeated(const std::string& text, int n) {
    std::string result;
    for (int i = 0; i < n; ++i) result += text;
    return result;
}

std::vector<std::string> ply_seeds() {
    const std::string xyz = "property float x\nproperty double y\nproperty short z\n";
    const std::string faces = "element face 2\nproperty list uchar int vertex_indices\n";
    const std::string ascii = "ply\nformat ascii 1.0\ncomment c\n";
    const std::string body(4 * 14, '\1');
    const std::string list("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13);
    std::vector<std::string> result{
        ascii + "element vertex 4\n" + xyz + faces + "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 3 2\n",
        ascii + "element vertex 3\n" + xyz +
            "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n5 0 1 2 -1 "
            "0\n"};
    for (const char* order : {"little", "big"}) {
        result.push_back(std::string("ply\nformat binary_") + order + "_endian 1.0\nelement vertex 4\n" + xyz + faces +
                         "property uchar red\nend_header\n" + body + list + "\1" + list + "\1");
    }
    return result;
}

std::vector<std::string> gltf_seeds() {
    const PolygonSoup tetrahedron = test::packed_tetrahedron();
    const PolygonSoup torus = make_sample("torus", 24);
    const std::string bytes = test::tetrahedron_buffer();
    std::string sparse = test::tetrahedron_json("[{\"mesh\":0,\"matrix\":[0,1,0,0,1,0,0,0,0,0,1,0,5,6,7,1]}]", 2);
    sparse.insert(sparse.find("\"bufferView\":0,"),
                  "\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":1,\"componentType\":5121},\"values\":{"
                  "\"bufferView\":0}},");
    const std::string nodes =
        "[{\"children\":[1],\"scale\":[1,2,-3],\"rotation\":[0,0,0,1]},{\"mesh\":0,\"translation\":[1,2,3]}]";
    return {test::glb(test::tetrahedron_json(nodes, 1, {}, "\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"), bytes),
            test::tetrahedron_json("[{\"mesh\":0}]", 3, "data:a/b;base64," + test::base64(bytes)),
            test::glb(sparse, bytes),
            test::meshopt_glb(test::meshopt_tetrahedron(true)),
            test::meshopt_glb(test::meshopt_tetrahedron(false, "EXPONENTIAL")),
            test::draco_glb(test::draco_data(tetrahedron)),
            test::draco_glb(test::draco_data(tetrahedron, {draco::MESH_SEQUENTIAL_ENCODING})),
            test::draco_glb(test::draco_data(torus, {draco::MESH_EDGEBREAKER_ENCODING, 0, 11, true})),
            test::draco_glb(test::draco_data(torus, {draco::MESH_EDGEBREAKER_ENCODING, 10, 0, true}))};
}

/// Model files; `in_package` puts them where they are read, since changes in packed data only show damage.
std::vector<std::string> model_seeds() {
    return {test::model_3mf(test::tetrahedron_3mf(1), "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 0 0 0\"/>"),
            test::model_3mf(test::tetrahedron_3mf(1) + "<object id=\"2\"><components><component objectid=\"1\" "
                                                       "p:path=\"/3D/3dmodel.model\"/></components></object>",
                            "<item objectid=\"2\"/>", "requiredextensions=\"p\"")};
}

std::string in_package(std::string input) {
    return format_name == "3mf" && !input.starts_with("PK") ? test::package_3mf(input) : input;
}

std::vector<std::string> seeds_of(std::string_view format) {
    if (format == "ply") return ply_seeds();
    if (format == "obj") {
        return {
            "# c\nv 0 0 0\nv 1 0 0 1 1 1\nv 1 1e-3 0\r\nv .5 1 nan\nvt 0 0\nf 1/1 2/1 \\\n 3/1\nf -4//1 -3//1 -2//1\n"
            "l 1 2 3\n"};
    }
    if (format == "off") {
        return {
            "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
            "STCNOFF # c\n3 1 0\n0 0 0 0 0 1 1 1 1 1 0 0\n1 0 0 0 0 1 1 1 1 1 0 0\n0 1 0 0 0 1 1 1 1 1 0 0\n3 0 1 2\n",
            "4nOFF 4\n3 1\n0 0 0 1 1\n1 0 0 1 2\n0 1 0 1 4\n3 0\n1 2\n",
            std::string("OFF BINARY\n\0\0\0\3\0\0\0\1\0\0\0\0", 23) + std::string(36, '\x3f') +
                std::string("\0\0\0\3\0\0\0\0\0\0\0\1\0\0\0\2\0\0\0\0", 20)};
    }
    if (format == "gltf") return gltf_seeds();
    if (format == "3mf") return model_seeds();
    return {
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
        "0\nendloop\nendfacet\nendsolid\n",
        std::string(80, ' ') + std::string("\2\0\0\0", 4) +
            repeated(std::string(48, '\x3f') + std::string(2, '\0'), 2)};
}

}  // namespace

std::vector<std::string> seeds() {
    if (!format_name.empty()) return seeds_of(format_name);
    std::vector<std::string> result;
    for (const char* format : {"ply", "obj", "off", "stl"}) {
        const std::string text = seeds_of(format).front();
        for (const bool little : {true, false})
            result.push_back(test::utf16(text + "# \xf0\x9f\x98\x80 \xc3\xa4\n", little));
    }
    for (const char* format : {"ply", "obj", "off", "stl", "gltf"}) {
        for (const std::string& text : seeds_of(format)) {
            for (const std::string& packed :
                 {text, test::gzip(text), test::zstd(text), test::gzip(text) + test::gzip(text)})
                result.push_back(packed);
        }
    }
    return result;
}

}  // namespace delmesh::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace delmesh;
    const std::string input = fuzz::in_package(std::string(reinterpret_cast<const char*>(data), size));
    const auto error_of = [&input](FileDamage* damage) {
        try {
            fuzz::check(
                parse_soup(std::as_bytes(std::span(input)), "input", {format_from_name(fuzz::format_name), damage}));
        } catch (const Error& error) {
            const std::string message = error.what();
            fuzz::require(message.starts_with("input: "), "messages name the file", message);
            fuzz::require(message.find_first_of("\r\n") == message.npos && message.size() < 300,
                          "messages are one line", message);
            return message;
        }
        return std::string();
    };
    FileDamage damage;
    const std::string error = error_of(nullptr);
    const std::string error_in_part = error_of(&damage);
    const std::string& first = damage.count > 0 ? damage.sentences.front() : error_in_part;
    fuzz::require(first == error, "what is damaged is an error, and the same one first", first + " / " + error);
    return 0;
}
