"""The order of flips: worst first (the paper's), first in first out, last in first out."""

import command
from table1 import PAPER, SAMPLES

ORDERS = ["worst", "fifo", "lifo"]


def sources():
    for mesh, file, _ in PAPER:
        if file is not None and (command.PAPER_MESHES / file).exists():
            yield mesh, command.PAPER_MESHES / file
    for name, faces in SAMPLES:
        yield name, command.sample(name, faces)


def run():
    rows = []
    for mesh, source in sources():
        for order in ORDERS:
            name = f"orders-{source.stem}-{order}"
            options = ["--mode", "flip", "--placement", "shells", "--order", order]
            path, report = command.remesh(source, name, *options)
            seconds = sorted(command.remesh(source, name, *options)[1]["seconds"]["remesh"] for _ in range(3))[1]
            _, mean, proved = command.distance(source, path)
            rows.append([mesh, order, report["flips"], report["splits"], proved, mean, seconds])
            print(*rows[-1], flush=True)
    command.save_csv("orders.csv", ["mesh", "order", "flips", "splits", "proved_hausdorff_percent", "mean_percent",
                                    "remesh_seconds"], rows)
