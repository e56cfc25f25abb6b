"""Figure 12: levels of detail of the hand, and the error against the number of vertices beside plain quadric
simplification, which does not keep a mesh Delaunay. Errors are measured against the Delaunay remeshing of the original,
as in the paper."""

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

import command
import mesh_file
import quadrics
import render

SHOWN = [12500, 2500, 500]
CURVE = [12500, 5000, 2500, 1250, 500, 250]
METHODS = {"best": "delmesh, placement best", "paper": "delmesh, placement paper",
           "plain": "plain quadrics, not Delaunay"}


class Subject:
    """A mesh, what its results are called, where to look from, and what its counts are divided by."""

    def __init__(self, name, source, direction, up, divisor):
        self.name, self.source, self.direction, self.up = name, source, direction, up
        self.shown = [count // divisor for count in SHOWN]
        self.curve = [count // divisor for count in CURVE]


def subjects():
    yield Subject("noisy-surface", command.sample("noisy-surface", 20000), (0.5, -1, 0.5), (0, 0, 1), 3)
    hand = command.PAPER_MESHES / "made-hand-e74997.off"
    if hand.exists():
        yield Subject("hand", hand, (0, 0, 1), (0, 1, 0), 1)


def level_path(subject, method, vertices):
    kind = "off" if method == "plain" else "ply"
    return command.OUT / "meshes" / f"figure12-{subject.name}-{method}-{vertices}.{kind}"


def make_levels(subject, start):
    for method in ("best", "paper"):
        for vertices in subject.curve:
            command.delmesh("simplify", start, level_path(subject, method, vertices), "--vertices", vertices,
                            "--placement", method, "--keep-partial", allowed=(0, 5))
    points, faces = mesh_file.read_mesh(start)
    for vertices in subject.curve:
        points, faces = quadrics.simplify(points, faces, vertices)
        mesh_file.write_off(level_path(subject, "plain", vertices), points, faces)


def measure(subject, start):
    rows = []
    for method in METHODS:
        for vertices in subject.curve:
            path = level_path(subject, method, vertices)
            distance = command.delmesh("distance", start, path)
            check = command.delmesh("check", path, allowed=(0, 1))
            rows.append((subject.name, method, check["mesh"]["vertices"], distance["hausdorff"]["percent"],
                         distance["mean"]["percent"], check["delaunay"]["non_delaunay_edges"]))
    return rows


def draw(subject, rows):
    original, _ = mesh_file.read_mesh(subject.source)
    view = render.View(original, subject.direction, subject.up)
    size = (400, min(int(400 * view.size[1] / view.size[0]), 620))
    figure, axes = pyplot.subplots(1, 3, figsize=(12.4, 12.4 / 3 * size[1] / size[0] + 0.5), dpi=100)
    for axis, vertices in zip(axes, subject.shown):
        points, faces = mesh_file.read_mesh(level_path(subject, "best", vertices))
        colours, widths = render.uniform_edges(faces, width=0.7)
        axis.imshow(render.render(points, faces, view, *size, edge_colours=colours, edge_widths=widths))
        error = next(row[3] for row in rows if row[1] == "best" and row[2] == len(points))
        axis.set_title(f"{len(points):,} vertices, error {error:.3f} %", fontsize=11)
        axis.axis("off")
    figure.tight_layout(pad=0.3)
    render.save(figure, command.OUT / f"figure12-{subject.name}.png")
    pyplot.close(figure)


def plot(subject, rows):
    figure, axes = pyplot.subplots(1, 2, figsize=(9.4, 3.6), dpi=100)
    for axis, column, what in ((axes[0], 3, "Hausdorff"), (axes[1], 4, "mean")):
        for method, label in METHODS.items():
            mine = [row for row in rows if row[1] == method]
            axis.loglog([row[2] for row in mine], [row[column] for row in mine], marker="o", markersize=3, label=label)
        axis.set(title=f"{what} distance, % of the diagonal", xlabel="vertices")
        axis.grid(alpha=0.3, which="both")
        axis.legend(fontsize=8)
    figure.tight_layout()
    render.save(figure, command.OUT / f"figure12-{subject.name}-curve.png")
    pyplot.close(figure)


def run():
    table = []
    for chosen in subjects():
        start, _ = command.remesh(chosen.source, f"figure12-{chosen.name}", "--mode", "feature", "--feature-angle", 15,
                                  "--placement", "shells")
        make_levels(chosen, start)
        rows = measure(chosen, start)
        draw(chosen, rows)
        plot(chosen, rows)
        table += rows
    command.save_csv("figure12.csv", ["mesh", "method", "vertices", "hausdorff_percent", "mean_percent",
                                      "non_delaunay_edges"], table)
    for row in table:
        print(*row)
