"""The experiments by name; see `run`."""

import argparse
import importlib
import shutil
import sys

import command

EXPERIMENTS = {
    "table1": "Algorithm 2 on the paper's models and on samples, beside the paper's figures",
    "figure2": "Algorithm 1 on a small example, split by split",
    "figure10": "the three modes side by side",
    "figure11": "vertices added by mode feature, against its threshold",
    "figure12": "levels of detail, and their error beside plain quadric simplification",
    "orders": "orders of the flips: worst, fifo, lifo",
    "placement": "vertices added by mode preserve: the paper's shells and the search for few points",
    "pictures": "the picture of the README",
}

# What the docs show; of built-in samples only.
PUBLISHED = ["before-after.png", "figure2.png", "figure10-plate.png", "figure10-noisy-surface.png",
             "figure11.png", "placement.png", "figure12-noisy-surface-curve.png"]


def publish():
    command.IMAGES.mkdir(parents=True, exist_ok=True)
    for name in PUBLISHED:
        shutil.copyfile(command.OUT / name, command.IMAGES / name)


def main():
    parser = argparse.ArgumentParser(prog="experiments/run", description="Reproduces the paper's experiments.",
                                     epilog="\n".join(f"  {name:10} {text}" for name, text in EXPERIMENTS.items()),
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="which ones; none: all")
    parser.add_argument("--publish", action="store_true", help="copy the pictures of the docs into docs/images")
    arguments = parser.parse_args()
    for name in arguments.names:
        if name not in EXPERIMENTS:
            parser.error(f"there is no experiment {name}")
    for name in arguments.names or EXPERIMENTS:
        print(f"== {name}: {EXPERIMENTS[name]}", flush=True)
        try:
            importlib.import_module(name).run()
        except command.CommandFailed as failure:
            sys.exit(f"experiments/run: {failure}")
    if arguments.publish:
        publish()


if __name__ == "__main__":
    main()
