"""Table 1: Algorithm 2 on the paper's models, ours beside the paper's; and on built-in samples."""

import command

COLUMNS = ["edges", "flips", "flips_percent", "splits", "min_angle_before", "min_angle_after", "max_angle_before",
           "max_angle_after", "small_before", "small_after", "large_before", "large_after", "error_percent",
           "proved_error_percent"]

# Name, our version of the model, and the row of the paper in the order of COLUMNS.
PAPER = [
    ("Horse", "made-horse-e59547.off", (59547, 2957, 5.0, 28, 1.7, 1.6, 171.3, 164.3, 8.7, 7.9, 1.3, 1.2, 0.4741)),
    ("Hand", "made-hand-e74997.off", (74997, 10935, 14.6, 0, 2.1, 3.2, 175.3, 156.9, 15.5, 8.5, 3.3, 0.6, 0.1061)),
    ("Bunny", "bunny-stanford-35947.obj", (104288, 2202, 2.1, 82, 0.5, 7.8, 177.6, 146.1, 2.3, 2.1, 0.2, 0.0, 0.2367)),
    ("Igea", "made-igea-e165000.ply", (165000, 19349, 11.7, 0, 0.1, 6.1, 179.8, 148.3, 10.0, 5.2, 2.2, 0.3, 0.1037)),
    ("Isis", "made-standin-isis-e562926.ply",
     (562926, 13497, 2.4, 2, 0.4, 3.1, 176.8, 163.6, 2.5, 2.4, 0.1, 0.0, 0.1591)),
    ("Max Planck", None, (597211, 12157, 2.0, 12, 0.1, 5.1, 178.9, 145.2, 1.7, 1.1, 0.3, 0.0, 0.0992)),
    ("Coarse hand", "made-coarse-hand-e294.off",
     (294, 99, 33.7, 34, 4.7, 12.4, 167.4, 142.1, 27.2, 11.4, 7.8, 1.5, 4.3245)),
    ("Coarse horse", "made-coarse-horse-e1050.off",
     (1050, 231, 22.0, 36, 3.5, 12.9, 171.3, 133.5, 17.9, 6.9, 5.5, 0.3, 1.6475)),
    ("Peyre hand", "made-peyre-hand-e894.off",
     (894, 22, 2.5, 0, 24.7, 31.0, 129.9, 112.5, 0.6, 0.0, 0.2, 0.0, 1.4095)),
    ("Peyre horse", "made-peyre-horse-e1944.off",
     (1944, 16, 0.8, 4, 12.0, 19.4, 136.4, 113.8, 0.2, 0.2, 0.1, 0.0, 0.8684)),
]

SAMPLES = [("noisy-surface", 100000), ("noisy-sphere", 20000), ("torus", 20000), ("terrain", 20000),
           ("stretched-sphere", 5120), ("thin-helix", 2000), ("spikes", 4000), ("plate", 5000)]

VARIANTS = [("keep-flipping", []), ("literal", ["--finish", "literal"])]


def measure(source, name, options):
    path, report = command.remesh(source, name, "--mode", "flip", "--placement", "shells", *options)
    before, after = report["input"], report["output"]
    edges = before["mesh"]["edges"]
    angles = []
    for key in ("min_angle_deg", "max_angle_deg", "small_angles_percent", "large_angles_percent"):
        angles += [before["quality"][key], after["quality"][key]]
    sampled, _, proved = command.distance(source, path)
    return [edges, report["flips"], 100 * report["flips"] / edges, report["splits"], *angles, sampled, proved]


def row_text(label, row):
    e, flips, percent, splits, *rest = row
    angles, errors = rest[:8], " | ".join(f"{x:.4f}" for x in rest[8:])
    pairs = [f"{angles[i]:.1f} → {angles[i + 1]:.1f}" for i in range(0, 8, 2)]
    return f"| {label} | {e:,} | {flips:,} ({percent:.1f}) | {splits:,} | " + " | ".join(pairs) + f" | {errors} |"


def run():
    rows, lines = [], ["| mesh | #E | flips (%) | splits | min angle | max angle | % small | % large | error % | proved % |",
                       "|" + " --- |" * 10]

    def add(mesh, who, row):
        print(mesh, who, *row, flush=True)
        rows.append([mesh, who, *row])
        lines.append(row_text(f"{mesh}, {who}", row) if who != "paper" else row_text(f"{mesh}, {who}", row) + " |")

    for mesh, file, published in PAPER:
        add(mesh, "paper", published)
        if file is None or not (command.PAPER_MESHES / file).exists():
            continue
        for who, options in VARIANTS:
            source = command.PAPER_MESHES / file
            add(mesh, who, measure(source, f"table1-{source.stem}-{who}", options))
    for name, faces in SAMPLES:
        for who, options in VARIANTS:
            add(name, who, measure(command.sample(name, faces), f"table1-{name}-{who}", options))

    command.save_csv("table1.csv", ["mesh", "who", *COLUMNS], rows)
    command.save_json("table1.json", [dict(zip(["mesh", "who", *COLUMNS], row)) for row in rows])
    (command.OUT / "table1.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
