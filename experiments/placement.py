"""Vertices added by mode preserve: where edges are split, by the paper's shells or by the search for few points."""

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

import command
import mesh_file
import render
from pictures import coloured

SAMPLES = [("saddle", 2000), ("noisy-surface", 20000), ("noisy-sphere", 20000), ("terrain", 20000), ("plate", 1000),
           ("stretched-sphere", 5000)]
GOOD_MESHES = command.PAPER_MESHES.parent / "good"
MOST_BYTES = 4_000_000
PICTURE = ("noisy-surface", 600)
DIRECTION = (0.5, -1.0, 0.5)


def sources():
    for name, faces in SAMPLES:
        yield f"{name} {faces:,}", command.sample(name, faces)
    for folder in (command.PAPER_MESHES, GOOD_MESHES):
        for path in sorted(folder.glob("*")) if folder.exists() else []:
            if path.suffix in (".ply", ".obj", ".off", ".stl") and path.stat().st_size <= MOST_BYTES:
                yield path.stem, path


def measure(source, placement):
    _, report = command.remesh(source, "placement", "--placement", placement, allowed=(0, 3, 5))
    return report if report.get("stop") == "done" else None


def table():
    rows = []
    for name, source in sources():
        shells, fewest = measure(source, "shells"), measure(source, "fewest")
        if shells is None or fewest is None or fewest["lower_bound"] == 0:
            print(f"| {name} | left out: already Delaunay, or not to be remeshed as it is |", flush=True)
            continue
        rows.append([name, fewest["input"]["mesh"]["vertices"], fewest["lower_bound"], shells["splits"],
                     fewest["splits"], round(fewest["splits"] / fewest["lower_bound"], 3),
                     float(f"{shells['output']['quality']['min_angle_deg']:.3g}"),
                     float(f"{fewest['output']['quality']['min_angle_deg']:.3g}"),
                     float(f"{fewest['output']['quality']['small_angles_percent']:.3g}"),
                     round(shells["seconds"]["remesh"], 3), round(fewest["seconds"]["remesh"], 3)])
        print("| " + " | ".join(f"{cell:,}" if isinstance(cell, int) else str(cell) for cell in rows[-1]) + " |",
              flush=True)
    command.save_csv("placement.csv", ["mesh", "vertices", "lower_bound", "shells", "fewest", "ratio",
                                       "min_angle_shells", "min_angle_fewest", "small_percent_fewest",
                                       "shells_seconds", "fewest_seconds"], rows)


def picture():
    source = command.sample(*PICTURE)
    points, _ = mesh_file.read_mesh(source)
    view = render.View(points, DIRECTION, margin=1.02)
    size = (440, int(440 * view.size[1] / view.size[0]))
    figure, axes = pyplot.subplots(1, 2, figsize=(9.4, 4.7 * size[1] / size[0] + 0.5), dpi=100)
    for axis, placement in zip(axes, ("shells", "fewest")):
        path, report = command.remesh(source, f"placement-{placement}", "--placement", placement)
        added, needed = report["splits"], report["lower_bound"]
        axis.set_title(f"{placement}: {added:,} points added; {needed:,} edges had to be split", fontsize=10)
        axis.imshow(coloured(path, view, size, len(points)))
        axis.axis("off")
    figure.tight_layout(pad=0.3)
    render.save(figure, command.OUT / "placement.png")
    print("wrote experiments/out/placement.png")


def run():
    picture()
    table()
