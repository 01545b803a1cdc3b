"""docs/strategies.md has a section on every backend, and the pictures it names exist."""

import os
import pathlib
import re

SOURCE = pathlib.Path(os.environ.get("PAIRSUM_SOURCE", pathlib.Path(__file__).parents[2]))
DOCUMENT = SOURCE / "docs/strategies.md"


def backends(registry):
    """The words of the backends."""
    return re.findall(r"^BACKEND\((\w+)\)$", registry, re.M)


def sections(text):
    """{heading: (names of backends below it, text)}; the names stand in backticks on the first line."""
    found = {}
    for part in re.split(r"^## ", text, flags=re.M)[1:]:
        heading, _, body = part.partition("\n")
        found[heading] = (re.findall(r"`(\w+)`", body.strip().partition("\n")[0]), body)
    return found


def anchor(heading):
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def complaints(text, names, folder):
    """What is wrong with a document on these backends whose pictures lie below `folder`."""
    found = []
    parts = sections(text)
    told = [name for of_section, _ in parts.values() for name in of_section]
    table = "".join(line for line in text.splitlines(keepends=True) if line.startswith("|"))
    for name in names:
        if told.count(name) != 1:
            found.append(f"{name} has {told.count(name)} sections")
        if f"`{name}`" not in table:
            found.append(f"{name} is not in the table")
    found += [f"{name} is no backend" for name in told if name not in names]
    for heading, (_, body) in parts.items():
        pictures = re.findall(r"!\[[^\]]+\]\(([^)]+)\)", body)
        if not pictures:
            found.append(f'"{heading}" has no picture')
        found += [f"{picture} does not exist" for picture in pictures if not (folder / picture).is_file()]
    anchors = {anchor(heading) for heading in parts}
    found += [f"no section is #{link}" for link in re.findall(r"\]\(#([^)]+)\)", text) if link not in anchors]
    return found


def test_every_backend_has_a_section_and_every_picture_exists():
    names = backends((SOURCE / "kernels/registry.def").read_text(encoding="utf-8"))
    assert len(names) >= 33
    assert complaints(DOCUMENT.read_text(encoding="utf-8"), names, DOCUMENT.parent) == []


def test_every_picture_is_shown():
    drawn = {path.name for path in (DOCUMENT.parent / "strategies").glob("*.svg")}
    shown = set(re.findall(r"\(strategies/([^)]+)\)", DOCUMENT.read_text(encoding="utf-8")))
    assert drawn == shown


def test_the_checker_rejects(tmp_path):
    (tmp_path / "a.svg").write_text("<svg/>")
    good = "| [`one`](#a-way) |\n\n## A way\n`one`\n\n![what it does](a.svg)\n"
    assert complaints(good, ["one"], tmp_path) == []
    assert complaints(good, ["one", "two"], tmp_path) == ["two has 0 sections", "two is not in the table"]
    assert complaints(good, [], tmp_path) == ["one is no backend"]
    assert complaints(good.replace("a.svg", "b.svg"), ["one"], tmp_path) == ["b.svg does not exist"]
    assert complaints(good.replace("![what it does](a.svg)", ""), ["one"], tmp_path) == ['"A way" has no picture']
    assert complaints(good.replace("## A way", "## Another"), ["one"], tmp_path) == ["no section is #a-way"]
    assert complaints(good + "\n## B\n`one`\n\n![again](a.svg)\n", ["one"], tmp_path) == ["one has 2 sections"]


def test_the_registry_is_read():
    assert backends("// BACKEND(none)\nBACKEND(naive)\nFORMULA(count, plain)\nBACKEND(mine)\n") == ["naive", "mine"]
