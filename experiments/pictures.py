"""The pictures of the README and the docs, from built-in samples. `--publish` also puts them into docs/images."""

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

import command
import mesh_file
import numpy as np
import render

SAMPLE, FACES = "noisy-surface", 1500
DIRECTION = (0.5, -1.0, 0.5)


def coloured(path, view, size, old_vertices):
    points, faces = mesh_file.read_mesh(path)
    bad = mesh_file.non_delaunay(points, faces)
    colours = np.where(bad[..., None], render.RED, render.GREY)
    widths = np.where(bad, 3.2, 0.8)
    return render.render(points, faces, view, *size, edge_colours=colours, edge_widths=widths,
                         dots=np.arange(old_vertices, len(points)), dot_radius=2.6, dot_colour=render.GREEN)


def run():
    source = command.sample(SAMPLE, FACES)
    points, _ = mesh_file.read_mesh(source)
    view = render.View(points, DIRECTION, margin=1.02)
    size = (440, int(440 * view.size[1] / view.size[0]))
    figure, axes = pyplot.subplots(1, 2, figsize=(9.4, 4.7 * size[1] / size[0] + 0.5), dpi=100)
    path, report = command.remesh(source, "before-after", "--placement", "shells")
    bad = report["input"]["delaunay"]["non_delaunay_edges"]
    axes[0].set_title(f"before: {bad:,} edges are not Delaunay (red)", fontsize=11)
    axes[1].set_title(f"after: the same surface, {report['splits']:,} points added (green)", fontsize=11)
    for axis, mesh in zip(axes, (source, path)):
        axis.imshow(coloured(mesh, view, size, len(points)))
        axis.axis("off")
    figure.tight_layout(pad=0.3)
    command.OUT.mkdir(parents=True, exist_ok=True)
    render.save(figure, command.OUT / "before-after.png")
    print("wrote experiments/out/before-after.png")
