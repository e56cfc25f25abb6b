// delmesh check IN: the exact certificate.

#include "commands.hpp"
#include "exit_code.hpp"
#include "input.hpp"
#include "mesh_json.hpp"

#include <memory>

namespace delmesh::app {

void add_check_command(CLI::App& app, Action& action) {
    CLI::App* command =
        add_command(app, action, "check", "Tell, exactly, whether a mesh is Delaunay (exit code 0) or not (1)",
                    "delmesh check bunny.ply");
    const auto path = std::make_shared<std::string>();
    const auto input = std::make_shared<InputOptions>();
    command->add_option("IN", *path, "Mesh file; -: standard input")->required();
    input->bind(*command);
    command->callback([&action, path, input] {
        action.run = [path, input](Console& console) {
            const Mesh mesh = build_mesh(*path, load_soup(*path, *input, console));
            const Measured measured = measure(mesh, console.context());
            Json json{{"path", *path}};
            json.update(to_json(measured));
            if (console.wants_json()) console.print(json);
            console.tell(*path + ": " + verdict(measured));
            return measured.certificate.certified ? exit_done : exit_does_not_hold;
        };
    });
}

}  // namespace delmesh::app
