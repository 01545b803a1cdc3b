"""Bad input: one clear line, exit code 2, nothing lost or half-written."""

import json
import os
import platform

import pytest
from conftest import SMALL, refused

BAD_RUNS = [
    (["--M", "0"], ["M must be between 2 and 10"]),
    (["--M", "1"], ["M must be between 2 and 10", "one cell"]),
    (["--M", "40"], ["M must be between 2 and 10"]),
    (["--M", "1431655766"], ["M must be between 2 and 10"]),
    (["--dim", "0", "--M", "3"], ["dimension", '"0"', "valid", "3"]),
    (["--dim", "0", "--M", "1"], ["dimension", '"0"', "valid", "3"]),
    (["--out", ""], ["--out"]),
    (["--M", "six"], ["--M", "six"]),
    (["--threads", "0"], ["threads must be at least 1"]),
    (["--threads", "-2"], ["threads must be at least 1"]),
    (["--dx", "-1"], ["dx must be a positive"]),
    (["--dx", "nan"], ["dx must be a positive"]),
    (["--dx", "inf"], ["dx must be a positive"]),
    (["--dx", "0,012"], ["--dx takes numbers like 0.02,0.03 (decimals after a point), not \"012\""]),
    (["--dx", "0.5"], ["dam_break needs dx"]),
    (["--dx", "1e-300"], ["dx = 1e-300", "more than 2^32 particles"]),
    (["--dx", "1e-300", "--case", "lattice"], ["dx = 1e-300", "more than 2^32 particles"]),
    (["--dx", ",".join(map(str, range(1, 20_001)))], ["--dx", "20000 words", "at most 1000"]),
    (["--M", "3", "--threads", "1..4096", "--backend", "all"], ["more than 20000 points"]),
    (["--backend", "naive", "--backend", "symmetric"], ["--backend is given 2 times", "--backend naive,symmetric"]),
    (["--steps", "2", "--steps", "3"], ["--steps is given 2 times, should be once (see"]),
    (["--H", "nan"], ["H must be a positive"]),
    (["--H", "-0.1"], ["H must be a positive"]),
    (["--dt", "0"], ["dt must be a positive"]),
    (["--backend", "nope"], ["nope", "naive_omp", "symmetric_tbb"]),
    (["--backend", ""], ["--backend"]),
    (["--case", "nope"], ["nope", "dam_break"]),
    (["--state", "nope"], ["nope", "perturbed"]),
    (["--interaction", "nope"], ["nope", "ferrari09"]),
    (["--smoothing", "nope"], ["nope", "wendland_c2"]),
    (["--precision", "nope"], ["nope", "double"]),
    (["--integrator", "nope"], ["nope", "euler"]),
    (["--dim", "4"], ["dimension", '"4"']),
    (["--steps", "0"], ["steps must be at least 1"]),
    (["--rounds", "0"], ["rounds must be at least 1"]),
    (["--rounds", "99999999999"], ["rounds must be at least 1 and at most 1000000, is 99999999999"]),
    (["--rounds", "many"], ["--rounds takes a number, not \"many\""]),
    (["--repetitions", "0"], ["repetitions must be at least 1"]),
    (["--half-width", "-1"], ["half-width must be at least 0"]),
    (["--half-width", "inf"], ["half-width must be at least 0 and finite"]),
    (["--budget", "-1"], ["budget must be at least 0"]),
    (["--budget", "1e400"], ["budget must be at least 0 and finite"]),
    (["--budget", "nan"], ["budget must be at least 0 and finite"]),
    (["--seed", "-1"], ["--seed", "whole number from 0", '"-1"']),
    (["--seed", "18446744073709551616"], ["--seed", "whole number from 0"]),
    (["--binding", "nope"], ["nope", "cores_first"]),
    (["--granularity", "nope"], ["nope"]),
    (["--grid", "nope"], ["nope", "hashed_grid"]),
    (["--grid", "hashed_grid,"], ["--grid"]),
    (["--isa", "nope"], ["nope"]),
    (["--isa", "best", "--backend", "atomic_add"], ["atomic_add does not run on vector units", "scalar"]),
    (["--isa", "sse4" if platform.machine() == "x86_64" else "neon", "--interaction", "count"], ["count", "whole numbers", "isa scalar"]),
    (["--block", "slab:0"], ["slab:0", "pencil:N"]),
    (["--block", "slab:4:morton"], ["slab:4:morton", "pencil:N"]),
    (["--block", "4"], ['"4"', "auto"]),
    (["--program", "nope"], ["--program"]),  # the options name no second build
    (["--study", "a/b"], ["study"]),
    (["--nope"], ["--nope"]),
    (["--steps", "many"], ["many"]),
]


@pytest.mark.parametrize("words, says", BAD_RUNS, ids=[" ".join(w)[:50] for w, _ in BAD_RUNS])
def test_run_refuses(pairsum, tmp_path, words, says):
    out = tmp_path / "rows.jsonl"
    done = pairsum("run", *([] if "--out" in words else ["--out", out]), *([] if words[0] in SMALL else SMALL[:2]), *words)
    assert refused(done, *says)
    assert not out.exists()


MEMORY = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGESIZE")
TOO_FINE = 1 / round((1.2 * MEMORY / 500) ** (1 / 3))  # particles of 500 bytes


@pytest.mark.parametrize("words, says", [
    (["--dx", "1e-300"], "more than 2^32 particles"),
    (["--dx", "1e-5", "--case", "lattice"], "more than 2^32 particles"),
    (["--dx", "0.1,1e-4", "--outside", "drop"], "more than 2^32 particles"),
    (["--dx", str(TOO_FINE), "--case", "lattice"], "of memory"),
])
def test_a_dry_run_refuses_what_the_run_refuses_and_neither_leaves_a_trace(pairsum, tmp_path, words, says):
    for more in ([], ["--dry-run"], ["--results", "a/b/c"], ["--out", "d/e/rows.jsonl"]):
        done = pairsum("run", *SMALL[2:], *words, *more)
        assert refused(done, says) and done.stdout == ""
        assert not list(tmp_path.iterdir()), more


@pytest.mark.parametrize("words, says", [
    (["--M", "1"], ["M must be"]),
    (["--backend", "nope"], ["symmetric_omp"]),
    (["--dx", "nan"], ["dx must be"]),
    (["--threads", "0"], ["threads must be"]),
    (["--grid", "nope"], ["hashed_grid"]),
    (["--isa", "nope"], ["nope"]),
    (["--block", "nope"], ["slab:N"]),
    (["--interaction", "nope"], ["count"]),
    (["--seed", "-1"], ["--seed", "whole number from 0"]),
    (["--dx", "1e-300"], ["more than 2^32 particles"]),
    (["--case", "periodic_lattice", "--dim", "3", "--dx", "0.15", "--grid", "hashed_grid"], ["no hashed grid goes round", "compact_grid"]),
])
def test_verify_refuses(pairsum, words, says):
    assert refused(pairsum("verify", *words), *says)


def test_no_command_and_unknown_command(pairsum):
    assert refused(pairsum(), "--help")
    assert refused(pairsum("jump"), "jump")


def test_unwritable_folder(pairsum, tmp_path):
    (tmp_path / "file").write_text("no folder")
    assert refused(pairsum("run", *SMALL, "--out", tmp_path / "file" / "rows.jsonl"), "file")
    assert refused(pairsum("run", *SMALL, "--results", "/proc/nope"), "/proc/nope")
    assert (tmp_path / "file").read_text() == "no folder"


def test_what_is_no_regular_file_is_not_written_and_not_waited_for(pairsum, tmp_path):
    os.mkfifo(tmp_path / "pipe")
    assert refused(pairsum("run", *SMALL, "--out", "pipe"), "pipe: is no regular file")
    assert refused(pairsum("tune", *SMALL[:6], "--save", "pipe"), "cannot write pipe: it is no regular file")
    assert refused(pairsum("run", *SMALL, "--out", "/dev/null"), "/dev/null: is no regular file")
    assert [path.name for path in tmp_path.iterdir()] == ["pipe"]


def test_run_leaves_foreign_files_alone(pairsum, rows):
    whole = rows.read_bytes()
    broken = whole.replace(b'"sum_s":', b'"sum_seconds":', 1)  # not at the end: no cut line
    for content in [b"a,b\n1,2\n", b'{"schema":"other"}\n', b"\x00\x01\x02", b"hello", whole[200:], broken]:
        rows.write_bytes(content)
        assert refused(pairsum("run", *SMALL, "--out", rows), rows.name)
        assert rows.read_bytes() == content


@pytest.mark.parametrize("bytes_less", [1, 30, 119])
def test_run_takes_a_cut_last_line_away_and_goes_on(pairsum, rows, bytes_less):
    whole = rows.read_bytes()
    rows.write_bytes(whole[:-bytes_less])
    done = pairsum("run", *SMALL, "--out", rows)
    assert done.returncode == 0, done.stderr
    assert "was cut" in done.stdout and rows.name in done.stdout
    kept = b"\n".join(whole.splitlines()[:-1]) + b"\n"
    assert rows.read_bytes().startswith(kept)
    added = [json.loads(line) for line in rows.read_bytes()[len(kept):].splitlines()]
    assert [row["kind"] for row in added] == ["end"]  # all else was there


def test_report_refuses_foreign_cut_missing_and_empty(pairsum, rows, tmp_path):
    whole = rows.read_bytes()
    summary = tmp_path / "out" / "summary.json"
    for content in [b"a,b\n1,2\n", b'{"schema":"other"}\n', whole[:-30], b""]:
        rows.write_bytes(content)
        assert refused(pairsum("report", "--tables", rows, "--out", summary.parent), rows.name)
        assert not summary.exists()
    assert refused(pairsum("report", "--tables", tmp_path / "missing.jsonl"), "missing.jsonl")
    empty = tmp_path / "empty"
    empty.mkdir()
    assert refused(pairsum("report", "--tables", empty), "empty")


def test_report_into_an_unwritable_folder(pairsum, rows):
    assert refused(pairsum("report", "--tables", rows, "--out", "/proc/nope"), "/proc/nope")


def test_report_names_line_and_key(pairsum, rows):
    lines = rows.read_text().splitlines()
    at = next(k for k, line in enumerate(lines) if '"sum_s":' in line)
    lines[at] = lines[at].replace('"sum_s":', '"sum_seconds":')
    rows.write_text("\n".join(lines) + "\n")
    assert refused(pairsum("report", "--tables", rows), f":{at + 1}:", "sum_s")


def test_bench_refuses(pairsum):
    assert refused(pairsum("--M", "1", program="pairsum_bench"), "M must be")
    assert refused(pairsum("--dx", "-1", program="pairsum_bench"), "dx must be")
    assert refused(pairsum("--grid", "nope", program="pairsum_bench"), "hashed_grid")
    assert refused(pairsum("--block", "nope", program="pairsum_bench"), "slab:N")


@pytest.mark.parametrize("words, says", [
    (["--M", "2", "--M", "3"], ["--M is given 2 times, should be once; a list has commas: --M 2,3 (see pairsum_bench --help)"]),
    (["--dx", "0.1", "--dx", "0.2"], ["--dx is given 2 times, should be once (see pairsum_bench --help)"]),
    (["--binding", "nope"], ["nope", "cores_first"]),
    (["--benchmark_min_time=1e400"], ["--benchmark_min_time must be positive and finite"]),
    (["--benchmark_min_time=0"], ["--benchmark_min_time must be positive and finite"]),
    (["--benchmark_min_time=soon"], ["--benchmark_min_time", "soon"]),
    (["--benchmark_repetitions=-1"], ["--benchmark_repetitions must be at least 1", "is -1"]),
    (["--benchmark_repetitions=99999999999"], ["--benchmark_repetitions must be", "at most 1000000, is 99999999999"]),
    (["--benchmark_format=xml"], ["--benchmark_format", "xml", "json"]),
    (["--benchmark_out_format=xml"], ["--benchmark_out_format", "xml", "json"]),
    (["--benchmark_out=/proc/nope"], ["cannot write /proc/nope"]),
], ids=lambda w: " ".join(w)[:40])
def test_bench_refuses_what_google_benchmark_takes_for_something_else(pairsum, words, says):
    done = pairsum(*words, program="pairsum_bench")
    assert refused(done, *says) and done.stdout == ""


@pytest.mark.parametrize("expression, says", [("no_such_backend", "Failed to match any benchmarks"), ("naive(", "Could not compile benchmark re")])
def test_bench_refuses_a_filter_that_matches_nothing_or_is_none(pairsum, expression, says):
    done = pairsum("--dx", "0.1", "--M", "3", "--threads", "1", f"--benchmark_filter={expression}", program="pairsum_bench")
    assert done.returncode == 2 and says in done.stderr


PLAN_TEXT = json.dumps({"schema": "pairsum.plan/1", "study": "s", "parts": [{"name": "a", "dx": 0.08}]}, indent=1)


@pytest.mark.parametrize("content", [b"\xef\xbb\xbf" + PLAN_TEXT.encode(), PLAN_TEXT.replace("\n", "\r\n").encode()], ids=["mark", "CR LF"])
def test_a_plan_from_another_editor_is_taken(pairsum, tmp_path, content):
    (tmp_path / "plan.json").write_bytes(content)
    done = pairsum("run", "plan.json", "--show-plan")
    assert done.returncode == 0 and '"study": "s"' in done.stdout


@pytest.mark.parametrize("content, says", [
    (PLAN_TEXT.encode("utf-16"), ["plan.json: is UTF-16"]),
    (PLAN_TEXT.encode("utf-16-be"), ["plan.json: is UTF-16"]),
    (PLAN_TEXT.replace('"study": "s"', '"study": "s",\n "study": "t"').encode(), ['plan.json:4:2: key "study" is there twice']),
    (PLAN_TEXT.replace("0.08", "1e400").encode(), ["plan.json:7:", "out of range"]),
    (PLAN_TEXT.replace('"s"', "s").encode(), ["plan.json:3:", "this is no JSON"]),
    (PLAN_TEXT.replace("0.08", "[" * 80_000 + "]" * 80_000).encode(), ["plan.json:7:", "more than 32 levels"]),
    (PLAN_TEXT.replace("0.08", json.dumps([0.08] * 2000)).encode(), ['"dx"', "2000 words"]),
    (b"\0" * 1000, ["plan.json: has NUL bytes"]),
    (b"", ["plan.json: is empty"]),
], ids=range(9))
def test_a_plan_that_cannot_be_read_is_refused_where_it_is_wrong(pairsum, tmp_path, content, says):
    (tmp_path / "plan.json").write_bytes(content)
    assert refused(pairsum("run", "plan.json", "--show-plan"), *says)


@pytest.mark.parametrize("change, says", [
    ({"study": 3}, 'the plan\'s "study" should be a text, is 3'),
    ({"parts": [{"name": "a", "colour": 3}]}, 'the plan\'s key "colour" is not known'),
    ({"parts": [{"name": "a", "dx": -1}]}, "dx must be a positive"),
    ({"parts": [{"name": "a", "backend": "nope"}]}, 'unknown backend "nope"'),
    ({"parts": [{"name": "a", "threads": "all", "M": 40}]}, "M must be between 2 and 10"),
])
def test_what_a_plan_means_is_refused_with_its_name(pairsum, tmp_path, change, says):
    (tmp_path / "plan.json").write_text(json.dumps({**json.loads(PLAN_TEXT), **change}))
    for more in ([], ["--dry-run"]):
        done = pairsum("run", "plan.json", *more)
        assert refused(done, "pairsum: plan.json: " + says)


def test_huge_files_are_not_read_to_their_end(pairsum, tmp_path):
    with open(tmp_path / "huge.json", "w") as file:
        file.truncate(2 << 30)
    assert refused(pairsum("run", "huge.json"), "huge.json: has more than 16 MB")
    (tmp_path / "huge.json").rename(tmp_path / "huge.jsonl")
    assert refused(pairsum("report", "huge.jsonl"), "huge.jsonl:1:")
    assert refused(pairsum("run", *SMALL, "--out", "huge.jsonl"), "huge.jsonl:1: this is no rows file")
