"""What the documents tell people to type: every option exists, every plan and key is described, the example runs."""

import json
import os
import pathlib
import re

import pytest

SOURCE = pathlib.Path(os.environ["PAIRSUM_SOURCE"])
DOCUMENTS = [SOURCE / "README.md", SOURCE / "results/README.md", *sorted((SOURCE / "docs").glob("*.md"))]
RUNNING = SOURCE / "docs/running.md"
PLANS = sorted(path.stem for path in (SOURCE / "harness/plan/plans").glob("*.json"))


def calls(text):
    """(command, options) of every call of pairsum in a block of commands; continued lines are joined."""
    blocks = re.findall(r"^```\w*\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    for line in "".join(blocks).replace("\\\n", " ").splitlines():
        for call in re.findall(r"(?:^|/|&& )pairsum ([a-z][^#|&]*)", line):
            words = call.split()
            yield words[0], [word for word in words if re.match(r"--\w", word)]


def whole_help(pairsum, command):
    """The help of a command, and what that of others which it sends its reader to says of particle files."""
    text = pairsum(command, "--help").stdout
    for other in re.findall(r"pairsum (\w+) --help", text):
        text += re.sub(r"^ *(-h,)?--(help|json)\b.*$", "", pairsum(other, "--help").stdout, flags=re.MULTILINE)
    return text


def unknown_options(pairsum, text):
    helps = {}
    for command, options in calls(text):
        known = helps.setdefault(command, whole_help(pairsum, command))
        yield from (f"{command} {option}" for option in options if not re.search(rf"{option}\b", known))


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_options_exist(pairsum, document):
    assert list(unknown_options(pairsum, document.read_text())) == []


def test_an_option_that_is_not_there_is_found(pairsum):
    assert list(unknown_options(pairsum, "```\nx/pairsum run talk --bugdet 3 \\\n  --no-such 1\n```\n")) == [
        "run --bugdet", "run --no-such"]
    assert list(unknown_options(pairsum, "```\npairsum run --rho0 1000 --json\n```\n")) == ["run --json"]


def test_every_plan_is_described():
    described = re.findall(r"^\| `(\w+)` \|", RUNNING.read_text(), re.MULTILINE)
    assert set(PLANS) <= set(described)


def test_every_key_of_a_plan_is_described(pairsum):
    plan = json.loads(pairsum("run", "talk", "--show-plan").stdout)
    keys = set(plan) | set(plan["parts"][0]) | {"defaults", "seed"}
    tables = "\n".join(re.findall(r"^\| (`[^|]*) \|", RUNNING.read_text(), re.MULTILINE))
    assert {key for key in keys if f"`{key}`" not in tables} == set()


def test_budgets_are_as_described():
    for name in PLANS:
        plan = json.loads((SOURCE / f"harness/plan/plans/{name}.json").read_text())
        assert re.search(rf"^\| `{name}` \|.*\| {plan['budget_s']} \|$", RUNNING.read_text(), re.MULTILINE), name


def test_the_example_plan_is_a_plan(pairsum, tmp_path):
    example = re.search(r"^```json\n(.*?)^```", RUNNING.read_text(), re.MULTILINE | re.DOTALL).group(1)
    (tmp_path / "my_plan.json").write_text(example)
    done = pairsum("run", "my_plan.json", "--dry-run")
    assert (done.returncode, done.stderr) == (0, "")
    assert all(part["name"] in done.stdout for part in json.loads(example)["parts"])
