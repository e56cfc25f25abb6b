#include <delmesh/delaunay/remesh.hpp>
#include <delmesh/io/read.hpp>
#include <delmesh/io/write.hpp>
#include <delmesh/measure/certificate.hpp>

#include <iostream>

int main(int argc, char** argv) try {
    if (argc != 3) return std::cerr << "usage: remesh_file IN OUT\n", 2;
    delmesh::Mesh mesh(delmesh::read_soup(argv[1]));
    const delmesh::RemeshReport report = delmesh::make_delaunay(mesh);
    std::cout << report.flips << " flips, " << report.splits << " splits\n";
    delmesh::write_mesh(argv[2], mesh);
    return delmesh::certify(mesh).certified ? 0 : 1;
} catch (const std::exception& error) {
    return std::cerr << error.what() << '\n', 3;
}
