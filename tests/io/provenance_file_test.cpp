#include "delmesh/io/provenance_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace delmesh {
namespace {

TEST(ProvenanceFile, IsTheObjectThatIsDocumented) {
    Provenance provenance;
    provenance.input_vertices = 3;
    provenance.splits = {{VertexId(0), VertexId(2), 0.1}, {VertexId(1), VertexId(2), 1.0 / 3}};
    provenance.facet_of_face = {FaceId(0), FaceId(0), FaceId(4)};
    provenance.facet_of_input_face = {FaceId(0)};
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "provenance.json";
    write_provenance(path, provenance);
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    EXPECT_EQ(text.str(),
              "{\"input_vertices\": 3,\n\"splits\": [[0,2,0.1],[1,2,0.3333333333333333]],\n"
              "\"facet_of_face\": [0,0,4],\n\"facet_of_input_face\": [0]}\n");
    std::filesystem::remove(path);
}

}  // namespace
}  // namespace delmesh
