#!/usr/bin/env python3
"""Checks the shape of the tree: arrows between layers, one stem for header and test, sizes, the links of the
pages, the README's program.

    script/check_layers.py [ROOT]       exit 1 and one line per violation
    script/check_layers.py --self-test  shows that each rule fires
"""

import pathlib
import re
import subprocess
import sys
import tempfile

# A layer may include those of a lower rank, and itself.
RANK = {"base": 0, "exact": 1, "mesh": 2, "measure": 3, "repair": 3, "delaunay": 4, "simplify": 5, "io": 6}

# Only these layers may touch streams, files and the environment.
STREAM_LAYERS = {"io"}
STREAM_HEADERS = {"iostream", "fstream", "sstream", "istream", "ostream", "cstdio", "stdio.h", "filesystem",
                  "fcntl.h", "unistd.h", "fmt/ostream.h"}

# Public headers without a test of the same stem, and why.
UNTESTED = {
    "base/option.hpp": "data only; tested with the options that are described by it",
    "exact/sign.hpp": "two one-line operators; tested with predicates",
}

MAX_PUBLIC_HEADER_LINES = 200
MAX_SOURCE_LINES = 600

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
NAMESPACE = re.compile(r"^namespace ([\w:]+)", re.MULTILINE)
DEFINED = re.compile(r"^(?:struct|class|enum class) (\w+)[^;(]*\{", re.MULTILINE)
LEFT_OPEN = re.compile(r"\b(TODO|FIXME|XXX|HACK)\b")


def layer_of_include(target):
    parts = target.split("/")
    if parts[0] == "delmesh":
        parts = parts[1:]
    return parts[0] if len(parts) > 1 and parts[0] in RANK else None


def check_includes(path, layer, public, text):
    for bracket, target in INCLUDE.findall(text):
        to = layer_of_include(target)
        if to is not None and to != layer and RANK[to] >= RANK[layer]:
            yield f"{path}: layer {layer} includes {target} from layer {to}; arrows point down only"
        if public and bracket == '"' and not target.startswith("delmesh/"):
            yield f"{path}: a public header includes the private {target}"
        if layer not in STREAM_LAYERS and target in STREAM_HEADERS:
            yield f"{path}: layer {layer} includes <{target}>; only {', '.join(sorted(STREAM_LAYERS))} touches files"


def check_file(path, text):
    """Rules for one file; `path` is relative to the root."""
    lines = text.count("\n")
    parts = path.parts
    public = parts[:2] == ("include", "delmesh")
    layer = parts[2] if public and len(parts) == 4 else parts[1] if parts[0] == "src" and len(parts) == 3 else None
    if layer is not None and layer not in RANK:
        yield f"{path}: {layer} is not a layer"
    elif layer is not None:
        yield from check_includes(path, layer, public, text)
    if path.suffix == ".hpp" and "#pragma once" not in text:
        yield f"{path}: no #pragma once"
    if public and lines >= MAX_PUBLIC_HEADER_LINES:
        yield f"{path}: {lines} lines; a public header has fewer than {MAX_PUBLIC_HEADER_LINES}"
    if lines > MAX_SOURCE_LINES:
        yield f"{path}: {lines} lines; a source has at most {MAX_SOURCE_LINES}"
    if LEFT_OPEN.search(text):
        yield f"{path}: {LEFT_OPEN.search(text).group()} left in the code"


def check_stems(paths):
    """Rules between files."""
    names = {path.as_posix() for path in paths}
    for name in sorted(names):
        match = re.fullmatch(r"include/delmesh/(\w+)/(\w+)\.hpp", name)
        if not match:
            continue
        layer, stem = match.groups()
        tested = f"tests/{layer}/{stem}_test.cpp" in names
        reason = UNTESTED.get(f"{layer}/{stem}.hpp")
        if not tested and reason is None:
            yield f"{name}: no tests/{layer}/{stem}_test.cpp"
        if tested and reason is not None:
            yield f"{name}: has a test, and still stands in UNTESTED"
    for header in sorted(UNTESTED):
        if f"include/delmesh/{header}" not in names:
            yield f"UNTESTED names {header}, which is not there"


def check_names(root, paths):
    """Two types of one name in headers break the one-definition rule, and no compiler need say so."""
    first = {}
    for path in paths:
        if path.suffix != ".hpp" or path.parts[0] not in ("include", "src"):
            continue
        text = (root / path).read_text(encoding="utf-8")
        space = NAMESPACE.search(text)
        for name in DEFINED.findall(text):
            other = first.setdefault((space and space.group(1), name), path)
            if other != path:
                yield f"{path}: defines {name}, as {other} does; a name stands for one type"


def check_readme(root):
    """The README's program is the example that the tests compile and run."""
    example = root / "examples/remesh_file.cpp"
    if example.exists() and f"```cpp\n{example.read_text(encoding='utf-8')}```\n" not in (
            root / "README.md").read_text(encoding="utf-8"):
        yield "README.md: its program is not examples/remesh_file.cpp, word for word"


def check_links(root, pages):
    """Every relative link of a page leads to a file."""
    for page in pages:
        for target in LINK.findall((root / page).read_text(encoding="utf-8")):
            if not target.startswith(("http:", "https:", "mailto:")) and not (root / page.parent / target).exists():
                yield f"{page}: links to {target}, which is not there"


def check(root, paths):
    sources = [path for path in paths if path.suffix != ".md"]
    for path in sources:
        yield from check_file(path, (root / path).read_text(encoding="utf-8"))
    yield from check_stems(sources)
    yield from check_names(root, sources)
    yield from check_links(root, [path for path in paths if path.suffix == ".md"])
    yield from check_readme(root)


def tracked_files(root):
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "*.hpp", "*.cpp", "*.md"],
                            cwd=root, check=True, capture_output=True, text=True).stdout.split("\n")
    return [pathlib.Path(name) for name in listed if name and (root / name).exists()]


def self_test():
    once = "#pragma once\n"
    good = {"include/delmesh/mesh/a.hpp": once + '#include "delmesh/base/b.hpp"\n', "tests/mesh/a_test.cpp": "",
            "include/delmesh/base/b.hpp": once, "tests/base/b_test.cpp": "", "src/io/r.cpp": "#include <fstream>\n"}
    good.update({f"include/delmesh/{header}": once for header in UNTESTED})
    bad = [
        ("arrows point down only", {"src/mesh/x.cpp": '#include "delmesh/delaunay/remesh.hpp"\n'}),
        ("arrows point down only", {"src/exact/x.cpp": '#include "mesh/editor.hpp"\n'}),
        ("arrows point down only", {"src/repair/x.cpp": '#include "delmesh/measure/certificate.hpp"\n'}),
        ("includes the private", {"include/delmesh/mesh/a.hpp": once + '#include "mesh/editor.hpp"\n'}),
        ("touches files", {"src/delaunay/x.cpp": "#include <iostream>\n"}),
        ("is not a layer", {"src/util/x.cpp": ""}),
        ("no #pragma once", {"src/mesh/x.hpp": "int x();\n"}),
        ("a public header has fewer", {"include/delmesh/mesh/a.hpp": once + "\n" * 200}),
        ("a source has at most", {"tests/mesh/a_test.cpp": "\n" * 601}),
        ("a name stands for one type", {"src/mesh/x.hpp": once + "struct A {\n};\nstruct B;\nclass B {\n};\n",
                                        "src/exact/y.hpp": once + "enum class A : int { a };\nstruct B;\n"}),
        ("left in the code", {"src/mesh/x.cpp": "// " + "TO" + "DO: later\n"}),
        ("no tests/mesh/c_test.cpp", {"include/delmesh/mesh/c.hpp": once}),
        ("still stands in UNTESTED", {"tests/exact/sign_test.cpp": ""}),
        ("links to gone.md", {"docs/a.md": "[here](a.md#part), [there](gone.md) and [far](https://example.org)\n"}),
        ("word for word", {"README.md": "```cpp\nint main() {}\n```\n", "examples/remesh_file.cpp": "int main();\n"}),
        ("which is not there", {"include/delmesh/exact/sign.hpp": None}),
    ]

    def violations(tree):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in tree.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
            return list(check(root, [pathlib.Path(name) for name in tree]))

    found = violations(good)
    assert not found, found
    for expected, change in bad:
        tree = {name: text for name, text in {**good, **change}.items() if text is not None}
        found = violations(tree)
        assert len(found) == 1 and expected in found[0], (expected, found)
    print(f"{len(bad)} rules fire")


def main(arguments):
    if arguments == ["--self-test"]:
        self_test()
        return 0
    root = pathlib.Path(arguments[0] if arguments else pathlib.Path(__file__).resolve().parent.parent)
    paths = tracked_files(root)
    if not paths:
        print("no sources found", file=sys.stderr)
        return 1
    found = list(check(root, paths))
    print("\n".join(found) if found else f"{len(paths)} files: layers, stems, sizes and links are as they should be")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
