"""Figure 10: the modes side by side: number of vertices, error, and what the surface looks like from near."""

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

import command
import mesh_file
import render

MODES = [("original", None), ("flip", ["--placement", "shells", "--mode", "flip"]), ("preserve", ["--placement", "shells"]),
         ("feature, 10°", ["--placement", "shells", "--mode", "feature", "--feature-angle", "10"])]


class Subject:
    """A mesh, from where to look at it, and the close-up: the middle and the extent as parts of the bounding box."""

    def __init__(self, name, source, direction, up, middle, extent):
        self.name, self.source, self.direction, self.up = name, source, direction, up
        self.middle, self.extent = middle, extent


def subjects():
    yield Subject("plate", command.sample("plate", 1000), (0.1, -0.4, 1), (0, 1, 0), (0.62, 0.55, 1), 0.2)
    yield Subject("noisy-surface", command.sample("noisy-surface", 3000), (0.5, -1, 0.5), (0, 0, 1), (0.7, 0.1, 0.6),
                  0.3)
    horse = command.PAPER_MESHES / "made-coarse-horse-e1050.off"
    if horse.exists():
        yield Subject("coarse-horse", horse, (1, 0.3, 0.2), (0, 0, 1), (0.5, 0.9, 0.85), 0.4)


def panels(subject):
    for title, options in MODES:
        if options is None:
            yield title, subject.source, 0.0
            continue
        path, _ = command.remesh(subject.source, f"figure10-{subject.name}-{options[-1]}",
                                 *options)
        yield title, path, command.delmesh("distance", subject.source, path)["hausdorff"]["percent"]


def draw(subject):
    original, _ = mesh_file.read_mesh(subject.source)
    low, high = original.min(axis=0), original.max(axis=0)
    whole = render.View(original, subject.direction, subject.up)
    near = render.View(original, subject.direction, subject.up, low + (high - low) * subject.middle,
                       subject.extent * max(high - low))
    width = 380
    heights = [min(int(width * whole.size[1] / whole.size[0]), 460), int(0.8 * width)]
    figure, axes = pyplot.subplots(2, len(MODES), figsize=(3.1 * len(MODES), 0.6 + 3.1 * sum(heights) / width), dpi=100,
                                   gridspec_kw={"height_ratios": heights})
    rows = []
    for column, (title, path, error) in enumerate(panels(subject)):
        points, faces = mesh_file.read_mesh(path)
        colours, thin = render.uniform_edges(faces, width=0.8)
        for row, (view, height) in enumerate(((whole, heights[0]), (near, heights[1]))):
            image = render.render(points, faces, view, width, height, edge_colours=colours,
                                  edge_widths=thin * (1.4 if row else 1))
            axes[row][column].imshow(image)
            axes[row][column].axis("off")
        axes[0][column].set_title(f"{title}\n#V {len(points):,}, error {error:.3f} %", fontsize=10)
        rows.append((subject.name, title.replace(",", ""), len(points), error))
    figure.tight_layout(pad=0.3)
    render.save(figure, command.OUT / f"figure10-{subject.name}.png")
    pyplot.close(figure)
    return rows


def run():
    command.OUT.mkdir(parents=True, exist_ok=True)
    rows = [row for subject in subjects() for row in draw(subject)]
    command.save_csv("figure10.csv", ["mesh", "mode", "vertices", "error_percent"], rows)
    for row in rows:
        print(*row)
