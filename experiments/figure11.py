"""Figure 11: how many vertices feature-preserving flipping adds, against the threshold of the dihedral angle."""

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

import command
import mesh_file
import quadrics
import render

ANGLES = [0, 1, 2, 3, 5, 7, 10, 15, 20, 30, 45, 60, 90, 120, 180]
COARSE_VERTICES = 600
# Plain quadric collapse takes Python a millisecond for each vertex; larger meshes come down to this by delmesh first.
HALFWAY_VERTICES = 12000


def coarse_version(source, name):
    """600 vertices by plain quadric simplification, as the paper's QSlim: `delmesh simplify` would hand out a mesh
    that is Delaunay already."""
    path = command.OUT / "meshes" / f"{name}-coarse.off"
    if command.delmesh("stats", source)["mesh"]["vertices"] > HALFWAY_VERTICES:
        halfway = command.OUT / "meshes" / f"{name}-halfway.ply"
        command.delmesh("simplify", source, halfway, "--vertices", HALFWAY_VERTICES)
        source = halfway
    mesh_file.write_off(path, *quadrics.simplify(*mesh_file.read_mesh(source), COARSE_VERTICES))
    return path


def growth(source, name):
    rows = []
    for angle in ANGLES:
        report = command.remesh(source, f"figure11-{name}", "--mode", "feature", "--feature-angle", angle, "--placement",
                                "shells")[1]
        before, after = report["input"]["mesh"]["vertices"], report["output"]["mesh"]["vertices"]
        rows.append((angle, before, after, 100 * (after - before) / before))
    return rows


def sources():
    isis = command.PAPER_MESHES / "made-standin-isis-e562926.ply"
    if isis.exists():
        yield "Isis stand-in", isis
    for name in ("noisy-surface", "terrain"):
        yield name, command.sample(name, 20000)


def plot(table):
    """`table`: rows (name, vertices before, threshold, vertices after, growth in percent)."""
    names = list(dict.fromkeys(row[0] for row in table))
    figure, axes = pyplot.subplots(1, len(names), figsize=(4.4 * len(names), 3.2), dpi=100, squeeze=False)
    for axis, name in zip(axes[0], names):
        for vertices in dict.fromkeys(row[1] for row in table if row[0] == name):
            rows = [row for row in table if row[:2] == (name, vertices)]
            axis.plot([r[2] for r in rows], [r[4] for r in rows], marker="o", markersize=3,
                      label=f"{vertices:,} vertices")
        axis.set_yscale("symlog", linthresh=0.1)
        axis.set(title=name, xlabel="threshold of the dihedral angle, degrees", ylabel="vertices added, %", xlim=(0, 90),
                 ylim=(0, 300), yticks=[0, 0.1, 1, 10, 100], yticklabels=["0", "0.1", "1", "10", "100"])
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8, loc="upper right")
    figure.tight_layout()
    render.save(figure, command.OUT / "figure11.png")
    print("wrote experiments/out/figure11.png")


def run():
    table = []
    for name, source in sources():
        stem = name.replace(" ", "-").lower()
        for path in (source, coarse_version(source, stem)):
            table += [(name, before, angle, after, percent) for angle, before, after, percent in growth(path, stem)]
    command.save_csv("figure11.csv", ["mesh", "vertices_before", "threshold_deg", "vertices_after", "growth_percent"],
                     table)
    plot(table)
