"""The form of the documents (docs/writing.md): size of the README, length of lines, links that lead somewhere."""

import os
import pathlib
import re

import pytest

SOURCE = pathlib.Path(os.environ.get("PAIRSUM_SOURCE", pathlib.Path(__file__).parents[2]))
README = SOURCE / "README.md"
DOCUMENTS = [README, SOURCE / "CHANGELOG.md", SOURCE / "results/README.md", *sorted((SOURCE / "docs").rglob("*.md"))]


def prose(text):
    """The lines outside of code; numbers of lines count from 1."""
    code = False
    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("```"):
            code = not code
        elif not code:
            yield number, line


def too_long(text):
    """Numbers of lines over 100 characters; tables, and a link that is longer by itself, may be."""
    return [number for number, line in prose(text)
            if len(line) > 100 and not line.lstrip().startswith("|") and " " in line[:100].strip()]


def too_much(text):
    """What a README has too much of."""
    have = {"lines": (len(text.splitlines()), 100), "words": (len(text.split()), 800),
            "characters in a line": (max(map(len, text.splitlines()), default=0), 100)}
    return [f"{number} {what}, not {most}" for what, (number, most) in have.items() if number > most]


def anchors(text):
    """The anchors of a document's headings, as GitHub makes them."""
    heads = [line.lstrip("#") for _, line in prose(text) if re.match("#+ ", line)]
    return {re.sub(r"[^\w\- ]", "", head.strip().lower()).replace(" ", "-") for head in heads}


def broken_links(document):
    """Links of a document whose file or heading does not exist."""
    text = "\n".join(line for _, line in prose(document.read_text()))
    for link in re.findall(r"\]\(([^)\s]+)\)", text):
        path, _, heading = link.partition("#")
        target = document.parent / path if path else document
        if re.match("[a-z]+:", link):
            continue
        if not target.exists() or (heading and heading not in anchors(target.read_text())):
            yield link


def test_the_readme_is_one_page():
    assert too_much(README.read_text()) == []


def test_a_longer_readme_is_found():
    assert too_much("a b\n" * 101) == ["101 lines, not 100"]
    assert too_much("word " * 801) == ["801 words, not 800", "4005 characters in a line, not 100"]


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_lines_are_short(document):
    assert too_long(document.read_text()) == []


def test_a_long_line_is_found():
    long = "a " * 51
    assert too_long(f"{long}\n\n```\n{long}\n```\n| {long}\n  * {long}\n{'a' * 101}\n") == [1, 7]


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_links_lead_somewhere(document):
    assert list(broken_links(document)) == []


def test_a_broken_link_is_found(tmp_path):
    (tmp_path / "a.md").write_text("# One's way, or two\n")
    text = "[1](a.md) [2](a.md#ones-way-or-two) [3](b.md) [4](a.md#one) [5](https://x.y/z) [6](#here)\n"
    (tmp_path / "c.md").write_text(text)
    assert list(broken_links(tmp_path / "c.md")) == ["b.md", "a.md#one", "#here"]
